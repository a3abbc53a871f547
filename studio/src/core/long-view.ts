/** The first picture of a street, which seen whole would be a thin strip: its nearest stretch, three-quarter. */
import type { FirstLook } from "./animal-view.ts";
import { type Box, cornersOf } from "./framing.ts";
import type { Place } from "./place.ts";
import { length, scale, subtract, type Vec3 } from "./vector.ts";

/** A place is long that is so many times longer than wide, and than twice as high. */
const LONG = 8;
/** So many widths of it are shown. */
const SHOWN = 4;
/** So far beside the straight look at its side, and so much from above (rise over run). */
const ASIDE_RAD = (52 * Math.PI) / 180;
const RISE = 0.2;

/**
 * The stretch around what the visitor sees first, from the side where the visitor stands, and on along the rest of
 * the street; null of places that are not long, or lie across the axes. World frame.
 */
export function lookAlong(box: Box, start: Place["start"]): FirstLook | null {
  const size = subtract(box.max, box.min);
  const [along, across] = size[0] >= size[1] ? ([0, 1] as const) : ([1, 0] as const);
  const wide = Math.max(size[across], 2 * size[2]);
  const long = size[along];
  if (wide <= 0 || long < LONG * wide) return null;
  const [low, high] = [box.min[along], box.max[along]];
  const half = (SHOWN * wide) / 2;
  const middle = Math.min(Math.max(start.target[along], low + half), high - half);
  const ends = (at: number, end: Vec3): Vec3 => (along === 0 ? [at, end[1], end[2]] : [end[0], at, end[2]]);
  const stretch = { min: ends(middle - half, box.min), max: ends(middle + half, box.max) };
  const into = Math.sign(start.target[across] - start.eye[across]) || 1;
  const on = high - middle >= middle - low ? 1 : -1;
  const [forth, aside] = [on * Math.sin(ASIDE_RAD), into * Math.cos(ASIDE_RAD)];
  const direction: Vec3 = along === 0 ? [forth, aside, -RISE] : [aside, forth, -RISE];
  return { corners: cornersOf(stretch), direction: scale(direction, 1 / length(direction)) };
}
