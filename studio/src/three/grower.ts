/** Makes solids of parts: small ones at once, large ones in a worker while the page goes on. */
import { Solid } from "./solid.ts";
import { boxesOf, ownersOf, piecesOf, type Soupable, soupOf } from "./soup.ts";
import type { Asked, Grown } from "./soup-worker.ts";

/** A tree over so many faces takes about two frames of a slow machine. */
const SMALL_FACES = 20_000;

/** What this uses of a `Worker`. */
export type Help = Pick<Worker, "postMessage" | "terminate" | "onmessage" | "onerror" | "onmessageerror">;

export class Grower {
  readonly #hire: () => Help | null;
  readonly #waiting = new Map<number, (grown: Grown | null) => void>();
  #help: Help | null | undefined;
  #asked = 0;

  /** `hire` starts a worker; null where there can be none. */
  constructor(hire: () => Help | null = startWorker) {
    this.#hire = hire;
  }

  /** The solid of a part with this number; null where it has no faces. */
  async solidOf(part: Soupable, index: number): Promise<Solid | null> {
    const owners = ownersOf([part], index);
    if (owners.rowOfFace.length === 0) return null;
    const grown = owners.firstBoxFace < SMALL_FACES ? null : await this.#ask(part);
    if (grown === null) return new Solid(soupOf([part], index));
    return new Solid({ ...owners, positions: grown.positions }, null, grown.tree);
  }

  dispose(): void {
    this.#help?.terminate();
    this.#lose();
  }

  /** Null where no worker does it. */
  async #ask(part: Soupable): Promise<Grown | null> {
    this.#help ??= this.#help === null ? null : this.#start();
    const help = this.#help;
    if (help === null) return null;
    this.#asked += 1;
    const asked: Asked = { id: this.#asked, pieces: piecesOf([part]), more: boxesOf([part]) };
    return await new Promise((resolve) => {
      this.#waiting.set(asked.id, resolve);
      help.postMessage(asked);
    });
  }

  #start(): Help | null {
    const help = this.#hire();
    if (help === null) return null;
    help.onmessage = ({ data }: MessageEvent<Grown>) => {
      this.#waiting.get(data.id)?.(data);
      this.#waiting.delete(data.id);
    };
    // Its file did not come, or memory is short: the page does the work.
    help.onerror = (event) => {
      event.preventDefault();
      this.#lose();
    };
    help.onmessageerror = () => this.#lose();
    return help;
  }

  #lose(): void {
    this.#help = null;
    for (const tell of this.#waiting.values()) tell(null);
    this.#waiting.clear();
  }
}

function startWorker(): Help | null {
  if (typeof Worker === "undefined") return null;
  try {
    return new Worker(new URL("./soup-worker.ts", import.meta.url), { type: "module" });
  } catch (error) {
    // A policy of the site forbids workers.
    if (error instanceof DOMException) return null;
    throw error;
  }
}
