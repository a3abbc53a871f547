/** The parts of a place on their way: several at once, what is seen and near first; what fails is asked for again. */
import { Asking, AT_ONCE, type Missing, PAGE, type Surroundings } from "../core/asking.ts";
import { Absent, type Fault, faultOf } from "../core/fault.ts";
import { worldPoint } from "../core/frames.ts";
import { boxOfPoints, cornersOf } from "../core/framing.ts";
import type { Part } from "../core/place.ts";
import { awayFrom, type Ball, sees, type Sight } from "../core/sight.ts";
import { length, scale, subtract, add, type Vec3 } from "../core/vector.ts";

/** What is not seen comes after all that is. */
const UNSEEN_M = 1e9;

export class Arrivals {
  readonly #parts: readonly Part[];
  readonly #fetch: (index: number) => Promise<void>;
  readonly #onChange: () => void;
  readonly #asking: Asking;
  readonly #sight: () => Sight;
  readonly #balls: readonly Ball[];
  readonly #queue: Set<number>;
  readonly #underway = new Set<number>();
  #untried: number;
  #arrived = 0;
  readonly #missing = new Map<number, Fault>();
  readonly #waiters: { readonly isDone: () => boolean; readonly tell: () => void }[] = [];

  /** `sight` is that of now: whoever turns gets what he sees then. `fetch` brings a part; `onChange` is called when one has come, or has not. */
  constructor(parts: readonly Part[], sight: () => Sight, fetch: (index: number) => Promise<void>, onChange: () => void, around: Surroundings = PAGE) {
    this.#parts = parts;
    this.#fetch = fetch;
    this.#onChange = onChange;
    this.#sight = sight;
    this.#balls = parts.map(ballOf);
    this.#queue = new Set(parts.keys());
    this.#untried = parts.length;
    this.#asking = new Asking(() => this.#askAgain(), around);
  }

  start(): void {
    while (this.#underway.size < AT_ONCE) {
      const index = this.#next();
      if (index === undefined) return;
      this.#underway.add(index);
      void this.#bring(index);
    }
  }

  /** Parts that are asked for and have not come yet. */
  get waiting(): number {
    return this.#underway.size + this.#queue.size;
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
    this.#queue.clear();
    this.#asking.dispose();
  }

  async #until(isDone: () => boolean): Promise<void> {
    if (isDone()) return;
    await new Promise<void>((resolve) => this.#waiters.push({ isDone, tell: resolve }));
  }

  /** What is to come first of those that wait, as one sees now. */
  #next(): number | undefined {
    const sight = this.#sight();
    let [first] = this.#queue;
    let best = Infinity;
    for (const index of this.#queue) {
      const [part, ball] = [this.#parts[index], this.#balls[index]];
      const rank = part === undefined || ball === undefined ? Infinity : rankOf(part, ball, sight);
      if (rank < best) [first, best] = [index, rank];
    }
    if (first !== undefined) this.#queue.delete(first);
    return first;
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
    this.#underway.delete(index);
    if (isFirstTry) this.#untried -= 1;
    for (const { isDone, tell } of this.#waiters) if (isDone()) tell();
    this.#onChange();
    this.start();
  }

  #askAgain(): void {
    for (const [index, fault] of this.#missing) if (fault instanceof Absent && !this.#underway.has(index)) this.#queue.add(index);
    this.start();
  }
}

/** Around a part, world frame; one that does not say how large it is stands where its frame begins. */
function ballOf({ bounds, worldFromPart }: Part): Ball {
  const corners = bounds === null ? [[0, 0, 0] as Vec3] : cornersOf(bounds);
  const { min, max } = boxOfPoints(corners.map((corner) => worldPoint(worldFromPart, corner)));
  return { middle: scale(add(min, max), 0.5), radius: length(subtract(max, min)) / 2 };
}

/** Smaller comes sooner: the ground, then what is seen, the nearest first, then the rest, and a picture around it last. */
function rankOf({ isGround, isBackdrop }: Part, ball: Ball, sight: Sight): number {
  if (isGround) return -1;
  if (isBackdrop) return Infinity;
  return awayFrom(sight, ball) + (sees(sight, ball) ? 0 : UNSEEN_M);
}
