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
 * The nearest eye on the ray from the box's centre against `direction` (unit, where the camera
 * looks to; not vertical) from which all corners are inside the free part of the
 * picture, provided that the picture's centre is moved to that part's middle.
 * `fovY_rad` is the vertical angle of view of the whole picture, `aspect` its width over height.
 */
export function frameBox(
  box: Box,
  direction: Vec3,
  fovY_rad: number,
  aspect: number,
  insets: Insets = NO_INSETS,
): View {
  const target = scale(add(box.min, box.max), 0.5);
  const right = rightOf(direction);
  const up = cross(right, direction);
  const half = Math.tan(fovY_rad / 2) * (1 - MARGIN);
  const tanY = half * (1 - insets.top - insets.bottom);
  const tanX = half * aspect * (1 - insets.left - insets.right);
  let distance = 0;
  for (const corner of cornersOf(box)) {
    const arm = subtract(corner, target);
    const nearer = -dot(arm, direction);
    const x = Math.abs(dot(arm, right)) / tanX;
    const y = Math.abs(dot(arm, up)) / tanY;
    distance = Math.max(distance, nearer + Math.max(x, y));
  }
  return { eye: subtract(target, scale(direction, distance)), target };
}

/**
 * Where the camera looks to at first: into the facade, a little from the left and above; from higher
 * above where the place goes far back for its height, as towns do, so that no row hides the next.
 */
export function homeDirection(box: Box): Vec3 {
  const [x, y, height] = subtract(box.max, box.min);
  const depths = Math.min(x, y) / Math.max(height, 1e-6);
  const down = Math.min(0.75, 0.12 + 0.06 * Math.max(0, depths - 2));
  const direction: Vec3 = [0.5, 0.86, -down];
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
