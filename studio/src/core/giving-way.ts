/** Animals that meet give way to each other: the one that would run into another waits until it is gone. */
import { subtract, type Vec3 } from "./vector.ts";

export interface Goer {
  readonly place: Vec3;
  /** Unit vector along its path. */
  readonly ahead: Vec3;
  readonly length_m: number;
  /** It has come to the end of its way, and goes nowhere by itself: waiting for it would never end. */
  readonly standing: boolean;
}

/** Bodies keep so much of both lengths' mean between their middles, looked at from the front. */
const APART = 0.75;
/** What is farther to the side than this share of both lengths' mean is not in the way. */
const BESIDE = 0.45;

/**
 * Whether an animal waits for another: that one is close before it and on its way. Of several that wait
 * for each other in a ring, two or more, the first goes.
 */
export function waits(which: number, all: readonly (Goer | null)[]): boolean {
  return inTheWay(which, all).some((other) => !comesBack(other, which, all));
}

/** Those that are close before one, and on their way. */
function inTheWay(which: number, all: readonly (Goer | null)[]): number[] {
  const own = all[which];
  if (own === null || own === undefined) return [];
  return [...all.keys()].filter((index) => {
    const other = all[index];
    return index !== which && other !== null && other !== undefined && !other.standing && isBefore(own, other);
  });
}

/** Whether what one waits for leads to the first of a ring, over later ones only. */
function comesBack(one: number, first: number, all: readonly (Goer | null)[]): boolean {
  const seen = new Set<number>();
  const open = [one];
  for (let at = open.pop(); at !== undefined; at = open.pop()) {
    if (at === first) return true;
    if (at < first || seen.has(at)) continue;
    seen.add(at);
    open.push(...inTheWay(at, all));
  }
  return false;
}

function isBefore(own: Goer, other: Goer): boolean {
  const [dx, dy] = subtract(other.place, own.place);
  const [ax, ay] = own.ahead;
  const size = Math.hypot(ax, ay) || 1;
  const along = (dx * ax + dy * ay) / size;
  const aside = Math.abs(dy * ax - dx * ay) / size;
  const mean = 0.5 * (own.length_m + other.length_m);
  return along > 0 && along < 2 * APART * mean && aside < BESIDE * mean;
}
