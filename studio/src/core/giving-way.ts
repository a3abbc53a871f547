/** Animals that meet give way to each other: the one that would run into another waits until it is gone. */
import { subtract, type Vec3 } from "./vector.ts";

export interface Goer {
  readonly place: Vec3;
  /** Unit vector along its path. */
  readonly ahead: Vec3;
  readonly length_m: number;
}

/** Bodies keep so much of both lengths' mean between their middles, looked at from the front. */
const APART = 0.75;
/** What is farther to the side than this share of both lengths' mean is not in the way. */
const BESIDE = 0.45;

/**
 * Whether an animal waits for another: that one is close before it, and of two that are before each
 * other the later one waits.
 */
export function waits(which: number, all: readonly (Goer | null)[]): boolean {
  const own = all[which];
  if (own === null || own === undefined) return false;
  return all.some((other, index) => {
    if (other === null || index === which || !isBefore(own, other)) return false;
    return !isBefore(other, own) || index < which;
  });
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
