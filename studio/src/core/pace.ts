/**
 * How sharp to draw while the picture moves, so that it moves smoothly on a slow machine.
 * At rest the picture is always drawn at full sharpness.
 */

/** Shares of the full resolution, from the best down. */
export const SHARPNESS = [1, 0.75, 0.55, 0.4] as const;
/** Frames slower than this for a while are drawn with fewer pixels (20 per second) ... */
const SLOW_S = 1 / 20;
/** ... and faster than this with more again. */
const FAST_S = 1 / 50;
/** This slow is no graphics card at all: straight to the fewest pixels. */
const VERY_SLOW_S = 1 / 8;
/** Weight of the newest frame in the running mean. */
const NEWEST = 0.3;
/** Frames between two changes, so that the mean knows the new cost; it is soon seen as too slow. */
const PATIENCE_DOWN = 3;
const PATIENCE_UP = 12;
const COARSEST = SHARPNESS.length - 1;

export interface Pace {
  readonly level: number;
  readonly mean_s: number;
  readonly sinceChange: number;
}

export const FULL_PACE: Pace = { level: 0, mean_s: 1 / 60, sinceChange: 0 };

/** The pace after a frame that took `seconds`. */
export function paced(pace: Pace, seconds: number): Pace {
  const mean_s = pace.mean_s + NEWEST * (Math.min(seconds, 0.5) - pace.mean_s);
  const sinceChange = pace.sinceChange + 1;
  if (mean_s > SLOW_S && pace.level < COARSEST && sinceChange >= PATIENCE_DOWN) {
    return { level: mean_s > VERY_SLOW_S ? COARSEST : pace.level + 1, mean_s, sinceChange: 0 };
  }
  if (mean_s < FAST_S && pace.level > 0 && sinceChange >= PATIENCE_UP) {
    return { level: pace.level - 1, mean_s, sinceChange: 0 };
  }
  return { level: pace.level, mean_s, sinceChange };
}

export function sharpnessOf(pace: Pace): number {
  return SHARPNESS[pace.level] ?? 1;
}
