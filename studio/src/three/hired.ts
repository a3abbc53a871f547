/** A worker of the page: started when it is first asked, and done without where there can be none. */

/** What this uses of a `Worker`. */
export type Help = Pick<Worker, "postMessage" | "terminate" | "onmessage" | "onerror" | "onmessageerror">;

interface Numbered {
  readonly id: number;
}

export class Helper<Asked extends Numbered, Answer extends Numbered> {
  readonly #hire: () => Help | null;
  readonly #waiting = new Map<number, (answer: Answer | null) => void>();
  #help: Help | null | undefined;
  #asked = 0;

  /** `hire` starts a worker; null where there can be none. */
  constructor(hire: () => Help | null) {
    this.#hire = hire;
  }

  /** Null where no worker does it: then whoever asks does it himself, with what he still has. */
  async ask(work: Omit<Asked, "id">): Promise<Answer | null> {
    const help = this.#helping();
    if (help === null) return null;
    this.#asked += 1;
    const id = this.#asked;
    return await new Promise((resolve) => {
      this.#waiting.set(id, resolve);
      try {
        help.postMessage({ ...work, id });
      } catch {
        // Memory is too short for a copy: the page does the work with what it has.
        this.#waiting.delete(id);
        resolve(null);
      }
    });
  }

  /** Whether a worker takes work; the first who asks starts it. */
  get isThere(): boolean {
    return this.#helping() !== null;
  }

  dispose(): void {
    this.#lose();
  }

  #helping(): Help | null {
    if (this.#help === undefined) this.#help = this.#start();
    return this.#help;
  }

  #start(): Help | null {
    const help = this.#hire();
    if (help === null) return null;
    help.onmessage = ({ data }: MessageEvent<Answer>) => {
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
    this.#help?.terminate();
    this.#help = null;
    for (const tell of this.#waiting.values()) tell(null);
    this.#waiting.clear();
  }
}

/** Null where the site forbids workers, or there are none. */
export function hired(start: () => Worker): Help | null {
  if (typeof Worker === "undefined") return null;
  try {
    return start();
  } catch (error) {
    // A policy of the site forbids workers.
    if (error instanceof DOMException) return null;
    throw error;
  }
}
