/** The models of a place, asked for while the program that draws them is still on its way. */
import type { Part } from "../core/place.ts";

/** Brings the model of a part; its number in the place. */
export type Fetch = (part: Part, index: number) => Promise<ArrayBuffer>;

export class HeadStart {
  readonly #fetch: Fetch;
  readonly #underway = new Map<number, Promise<ArrayBuffer>>();

  /** Asks for all of `parts` at once: for places of few, where nothing is shown before all have come. */
  constructor(parts: readonly Part[], fetch: Fetch) {
    this.#fetch = fetch;
    for (const [index, part] of parts.entries()) {
      const bytes = fetch(part, index);
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
}
