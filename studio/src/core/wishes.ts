/** Files that are wished for while one looks about: what does not come is named, and asked for again until it is there. */
import { Asking, AT_ONCE, type Missing, PAGE, type Surroundings } from "./asking.ts";
import { Absent, type Fault, faultOf } from "./fault.ts";

export interface Wish {
  /** Comes when the file was asked for once, whether it is there or not. */
  readonly tried: Promise<void>;
  /** Nobody wants it any more: it is not named, nor asked for again. What is underway is taken all the same. */
  drop(): void;
  /** Whether it is asked for now, or as soon as others have come. */
  readonly isUnderway: boolean;
}

interface Open {
  readonly file: string;
  readonly attempt: () => Promise<void>;
  fault: Fault | null;
}

export class Wishes {
  readonly #open = new Set<Open>();
  readonly #asking: Asking;
  readonly #onChange: () => void;
  /** Those that are asked for as soon as others have come. */
  readonly #queue: (() => void)[] = [];
  #loading = 0;
  /** Those that are asked for, or in the queue; of them some may be dropped. */
  readonly #underway = new Set<Open>();

  /** `onChange` is called when a file has come, or has not. */
  constructor(onChange: () => void, around: Surroundings = PAGE) {
    this.#onChange = onChange;
    this.#asking = new Asking(() => this.#askAgain(), around);
  }

  /** Files on their way. */
  get waiting(): number {
    return this.#underway.size;
  }

  /** Each once, however often it is wished for. */
  get missing(): Missing[] {
    const faults = new Map<string, Fault>();
    for (const { file, fault } of this.#open) if (fault !== null) faults.set(file, fault);
    return [...faults].map(([file, fault]) => ({ file, fault }));
  }

  /** Does not wait for the end of a pause. */
  askNow(): void {
    this.#asking.now();
  }

  /** `take` gets what `load` brings, at once or later, and once. What is broken, or cannot be taken, is named but not loaded again. */
  bring<T>(file: string, load: () => Promise<T>, take: (brought: T) => void): Wish {
    const wish: Open = {
      file,
      fault: null,
      attempt: async () => {
        const brought = await load();
        wish.fault = null;
        take(brought);
        this.#open.delete(wish);
      },
    };
    this.#open.add(wish);
    const underway = this.#underway;
    return {
      tried: this.#try(wish),
      drop: () => {
        if (this.#open.delete(wish) && wish.fault !== null) this.#onChange();
      },
      get isUnderway() {
        return underway.has(wish);
      },
    };
  }

  dispose(): void {
    this.#open.clear();
    this.#asking.dispose();
  }

  async #try(wish: Open): Promise<void> {
    this.#underway.add(wish);
    if (this.#loading >= AT_ONCE) await new Promise<void>((go) => this.#queue.push(go));
    this.#loading += 1;
    try {
      // One may be dropped before its turn comes.
      if (this.#open.has(wish)) {
        await wish.attempt();
        this.#asking.succeeded();
      }
    } catch (error) {
      wish.fault = faultOf(error);
      // What is broken is as broken the next time.
      if (wish.fault instanceof Absent && this.#open.has(wish)) this.#asking.failed();
    }
    this.#underway.delete(wish);
    this.#loading -= 1;
    this.#queue.shift()?.();
    this.#onChange();
  }

  #askAgain(): void {
    for (const wish of [...this.#open]) if (wish.fault instanceof Absent && !this.#underway.has(wish)) void this.#try(wish);
  }
}
