/** The parts of a place on their way: several at once, the nearest first; what fails is asked for again. */
import { Asking, PAGE, type Surroundings } from "../core/asking.ts";
import { Absent, type Fault, faultOf } from "../core/fault.ts";
import { worldPoint } from "../core/frames.ts";
import type { Part } from "../core/place.ts";
import { length, scale, subtract, add, type Vec3 } from "../core/vector.ts";

/** A browser holds six connections to a server of HTTP/1.1. */
const AT_ONCE = 6;

export interface Missing {
  readonly file: string;
  readonly fault: Fault;
}

export class Arrivals {
  readonly #parts: readonly Part[];
  readonly #fetch: (index: number) => Promise<void>;
  readonly #onChange: () => void;
  readonly #asking: Asking;
  #queue: number[];
  #underway = 0;
  #untried: number;
  #arrived = 0;
  readonly #missing = new Map<number, Fault>();
  readonly #waiters: { readonly isDone: () => boolean; readonly tell: () => void }[] = [];

  /** `fetch` brings a part; `onChange` is called when one has come, or has not. */
  constructor(parts: readonly Part[], eye: Vec3, fetch: (index: number) => Promise<void>, onChange: () => void, around: Surroundings = PAGE) {
    this.#parts = parts;
    this.#fetch = fetch;
    this.#onChange = onChange;
    this.#queue = inOrder(parts, eye);
    this.#untried = parts.length;
    this.#asking = new Asking(() => this.#askAgain(), around);
  }

  start(): void {
    while (this.#underway < AT_ONCE) {
      const index = this.#queue.shift();
      if (index === undefined) return;
      this.#underway += 1;
      void this.#bring(index);
    }
  }

  /** Parts that are asked for and have not come yet. */
  get waiting(): number {
    return this.#underway + this.#queue.length;
  }

  get missing(): Missing[] {
    return [...this.#missing].map(([index, fault]) => ({ file: this.#parts[index]?.model ?? "", fault }));
  }

  /** Waits for the first that comes, or until each was asked for once. */
  async first(): Promise<void> {
    await this.#until(() => this.#arrived > 0 || this.#untried === 0);
  }

  /** Waits until each was asked for once. */
  async tried(): Promise<void> {
    await this.#until(() => this.#untried === 0);
  }

  /** Does not wait for the end of a pause. */
  askNow(): void {
    this.#asking.now();
  }

  dispose(): void {
    this.#queue = [];
    this.#asking.dispose();
  }

  async #until(isDone: () => boolean): Promise<void> {
    if (isDone()) return;
    await new Promise<void>((resolve) => this.#waiters.push({ isDone, tell: resolve }));
  }

  async #bring(index: number): Promise<void> {
    const isFirstTry = !this.#missing.has(index);
    try {
      await this.#fetch(index);
      this.#missing.delete(index);
      this.#arrived += 1;
      this.#asking.succeeded();
    } catch (error) {
      const fault = faultOf(error);
      this.#missing.set(index, fault);
      // What is broken is as broken the next time.
      if (fault instanceof Absent) this.#asking.failed();
    }
    this.#underway -= 1;
    if (isFirstTry) this.#untried -= 1;
    for (const { isDone, tell } of this.#waiters) if (isDone()) tell();
    this.#onChange();
    this.start();
  }

  #askAgain(): void {
    for (const [index, fault] of this.#missing) if (fault instanceof Absent) this.#queue.push(index);
    this.start();
  }
}

/** The ground first, then what stands nearest to where one begins. */
function inOrder(parts: readonly Part[], eye: Vec3): number[] {
  const away = ({ bounds, isGround, isBackdrop, worldFromPart }: Part): number => {
    if (isGround) return -1;
    if (isBackdrop) return Infinity;
    const middle: Vec3 = bounds === null ? [0, 0, 0] : scale(add(bounds.min, bounds.max), 0.5);
    return length(subtract(worldPoint(worldFromPart, middle), eye));
  };
  const ranked = parts.map((part, index) => ({ index, away_m: away(part) }));
  return ranked.toSorted((a, b) => (a.away_m < b.away_m ? -1 : a.away_m > b.away_m ? 1 : 0)).map(({ index }) => index);
}
