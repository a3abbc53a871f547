/** Where to stand to see a box whole. */
import { add, dot, length, scale, subtract, type Vec3 } from "./vector.ts";

export interface Box {
  readonly min: Vec3;
  readonly max: Vec3;
}

/** What lies over the edges of the picture; shares of its width and height. */
export interface Insets {
  readonly left: number;
  readonly right: number;
  readonly top: number;
  readonly bottom: number;
}

export interface View {
  readonly eye: Vec3;
  readonly target: Vec3;
}

/** Share of the free part of the picture that stays empty around the box. */
const MARGIN = 0.07;

export const NO_INSETS: Insets = { left: 0, right: 0, top: 0, bottom: 0 };

/** How far the middle of the free part lies from the picture's own; shares, y down. */
export function shiftOf(insets: Insets): readonly [number, number] {
  return [(insets.left - insets.right) / 2, (insets.top - insets.bottom) / 2];
}

/**
 * The nearest eye that looks along `direction` (unit; not vertical) and has all points inside the
 * free part of the picture, provided that the picture's centre is moved to that part's middle. What
 * room is left is on both sides alike. `fovY_rad` is the vertical angle of view of the whole picture,
 * `aspect` its width over height.
 *
 * With x and depth d of a point along the picture and into it, and t the tangent of half the angle,
 * it is inside where |x - x0| <= t (d - d0): the eye lies between the most of x - t d and the least
 * of x + t d, each moved by t d0, and the nearer the eye, the closer they are.
 */
export function framePoints(
  points: readonly Vec3[],
  direction: Vec3,
  fovY_rad: number,
  aspect: number,
  insets: Insets = NO_INSETS,
): View {
  const right = rightOf(direction);
  const up = cross(right, direction);
  const half = Math.tan(fovY_rad / 2) * (1 - MARGIN);
  const across = extentOf(points, right, direction, half * aspect * (1 - insets.left - insets.right));
  const above = extentOf(points, up, direction, half * (1 - insets.top - insets.bottom));
  const depth = Math.min(across.nearest, above.nearest);
  const eye = add(add(scale(right, across.middle), scale(up, above.middle)), scale(direction, depth));
  const { centre, lowest } = middleOf(points);
  // On the axis of the picture, as deep as the middle of the points, but not below the lowest.
  const ahead = dot(subtract(centre, eye), direction);
  const toLowest = direction[2] < 0 ? (lowest - eye[2]) / direction[2] : ahead;
  return { eye, target: add(eye, scale(direction, Math.min(ahead, toLowest))) };
}

/** Where the eye lies along one axis of the picture, and how deep it may be. */
function extentOf(
  points: readonly Vec3[],
  axis: Vec3,
  direction: Vec3,
  tan: number,
): { middle: number; nearest: number } {
  let low = Infinity;
  let high = -Infinity;
  for (const point of points) {
    const x = dot(point, axis);
    const d = tan * dot(point, direction);
    low = Math.min(low, x + d);
    high = Math.max(high, x - d);
  }
  return { middle: (low + high) / 2, nearest: (low - high) / (2 * tan) };
}

function middleOf(points: readonly Vec3[]): { centre: Vec3; lowest: number } {
  const { min, max } = boxOfPoints(points);
  return { centre: scale(add(min, max), 0.5), lowest: min[2] };
}

/** The box around points. */
export function boxOfPoints(points: readonly Vec3[]): Box {
  const ends = (pick: (...values: number[]) => number, start: number): Vec3 =>
    points.reduce<Vec3>((a, b) => [pick(a[0], b[0]), pick(a[1], b[1]), pick(a[2], b[2])], [start, start, start]);
  return { min: ends(Math.min, Infinity), max: ends(Math.max, -Infinity) };
}

/**
 * Where the camera looks to at first: to where the photos or the fronts do (`outlook`: level, or from
 * above by its z), else into the
 * facade, a little from the left; a little from above, and from higher where the place goes far back
 * for its height, as towns do, so that no row hides the next.
 */
export function homeDirection(box: Box, outlook: Vec3 | null = null): Vec3 {
  const [x, y, height] = subtract(box.max, box.min);
  const depths = Math.min(x, y) / Math.max(height, 1e-6);
  const asked = outlook === null ? 0 : -outlook[2];
  const down = Math.max(asked, Math.min(0.75, 0.12 + 0.06 * Math.max(0, depths - 2)));
  const [east, north] = outlook ?? [0.5, 0.86];
  const direction: Vec3 = [east, north, -down];
  return scale(direction, 1 / length(direction));
}

export function cornersOf(box: Box): Vec3[] {
  const ends = [box.min, box.max] as const;
  return ends.flatMap((a) =>
    ends.flatMap((b) => ends.map((c): Vec3 => [a[0], b[1], c[2]])),
  );
}

function rightOf(direction: Vec3): Vec3 {
  const size = Math.hypot(direction[0], direction[1]);
  return [direction[1] / size, -direction[0] / size, 0];
}

function cross(a: Vec3, b: Vec3): Vec3 {
  return [
    a[1] * b[2] - a[2] * b[1],
    a[2] * b[0] - a[0] * b[2],
    a[0] * b[1] - a[1] * b[0],
  ];
}
