/** The models of a place, asked for while the program that draws them is still on its way. */
import { fileAddress, type Part } from "../core/place.ts";
import { fetchBytes } from "../three/fetch.ts";

/** A place of so few parts is shown when all have come: they belong together, as a house and its garden do. */
export const FEW_PARTS = 4;

export class HeadStart {
  readonly #manifest: URL;
  readonly #onProgress: (share: number, file: string) => void;
  readonly #shares: number[];
  readonly #underway = new Map<number, Promise<ArrayBuffer>>();

  /** Asks for all of the parts at once where they are few; of more the viewer says which are wanted first. */
  constructor(parts: readonly Part[], manifest: URL, onProgress: (share: number, file: string) => void) {
    this.#manifest = manifest;
    this.#onProgress = onProgress;
    this.#shares = parts.map(() => 0);
    if (parts.length > FEW_PARTS) return;
    for (const [index, part] of parts.entries()) {
      const bytes = this.#fetch(part, index);
      bytes.catch(() => undefined); // whoever takes it is told
      this.#underway.set(index, bytes);
    }
  }

  /** What has a head start is handed out once: who asks again gets the file as it is then. */
  async bytesOf(part: Part, index: number): Promise<ArrayBuffer> {
    const bytes = this.#underway.get(index) ?? this.#fetch(part, index);
    this.#underway.delete(index);
    return await bytes;
  }

  async #fetch({ model }: Part, index: number): Promise<ArrayBuffer> {
    return await fetchBytes(fileAddress(model, this.#manifest), model, (got, total) => {
      this.#shares[index] = total === null ? 0.5 : got / total;
      const mean = this.#shares.reduce((sum, share) => sum + share, 0) / this.#shares.length;
      this.#onProgress(Math.max(0.02, mean), model);
    });
  }
}
