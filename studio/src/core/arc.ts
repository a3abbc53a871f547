/** Walls as polylines: straight ones, and arcs that are given by their bulge, as in DXF. */
import type { Point } from "./house.ts";

/** A curved wall turns by no more than this between two points. */
const STEP_RAD = (6 * Math.PI) / 180;

/** `bulge` is the tan of a quarter of the arc's angle; a positive one bows to the right. */
export function polylineOf(start: Point, end: Point, bulge: number): Point[] {
  const angle = 4 * Math.atan(bulge);
  const steps = Math.max(1, Math.ceil(Math.abs(angle) / STEP_RAD));
  if (steps === 1 || Math.abs(bulge) < 1e-9) return [start, end];
  const [dx, dy] = [end[0] - start[0], end[1] - start[1]];
  // The centre lies on the left of the chord where the arc bows to the right.
  const away = (1 - bulge * bulge) / (4 * bulge);
  const centre: Point = [(start[0] + end[0]) / 2 - away * dy, (start[1] + end[1]) / 2 + away * dx];
  const [rx, ry] = [start[0] - centre[0], start[1] - centre[1]];
  const inner = Array.from({ length: steps - 1 }, (_, i): Point => {
    const turn = (angle * (i + 1)) / steps;
    const [c, s] = [Math.cos(turn), Math.sin(turn)];
    return [centre[0] + c * rx - s * ry, centre[1] + s * rx + c * ry];
  });
  return [start, ...inner, end];
}

/** The point at a distance along a polyline; its ends for what lies beyond. */
export function pointAlong(line: readonly Point[], distance: number): Point {
  let left = Math.max(0, distance);
  for (const [i, from] of line.entries()) {
    const to = line[i + 1];
    if (to === undefined) return from;
    const length = Math.hypot(to[0] - from[0], to[1] - from[1]);
    if (left <= length && length > 0) {
      const share = left / length;
      return [from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])];
    }
    left -= length;
  }
  return [0, 0];
}
