/**
 * What a photo shows, as a plane: where a place has no surfaces, the photo is hung up there.
 *
 * The inverse depth of a plane is affine over the picture, 1/z = a x + b y + c with x and y on the
 * picture in units of the focal length: a linear fit, which iterated weights (Huber) keep from being
 * drawn away by what lies before and behind.
 */
import { type Axes, axesOf, onPicture } from "./pinhole.ts";
import type { Shot } from "./place.ts";
import { add, scale, type Vec3 } from "./vector.ts";

export interface Proxy {
  /** In the inverse of lengths. */
  readonly slopes: readonly [number, number];
  readonly inverse: number;
}

const FEWEST_POINTS = 12;
const MOST_POINTS = 800;
const ROUNDS = 12;
/** Huber's constant, in robust standard deviations. */
const HUBER = 1.345;
const DEVIATION_OF_MEDIAN = 1.4826;
/** A plane whose corners lie nearer or farther than the middle by more is none that one saw. */
const MOST_TILT = 3;

/** A point of the picture (in units of the focal length, from the principal point) and 1 / depth. */
type Sample = readonly [x: number, y: number, inverse: number];

/**
 * The plane of the points (world frame, three numbers each) that the photo shows; parallel to the
 * picture at their median depth where they tell no tilt, and at `otherwise` where they are too few.
 */
export function proxyOf(shot: Shot, points: Float32Array, otherwise: (axes: Axes) => number): Proxy {
  const axes = axesOf(shot);
  const samples = samplesOf(shot, axes, points);
  if (samples.length < FEWEST_POINTS) return { slopes: [0, 0], inverse: 1 / otherwise(axes) };
  const middle = median(samples.map(([, , inverse]) => inverse));
  const tilted = fit(samples, middle);
  const ends = pictureCorners(shot).map(([x, y]) => tilted[0] * x + tilted[1] * y + tilted[2]);
  const holds = ends.every((inverse) => inverse > middle / MOST_TILT && inverse < middle * MOST_TILT);
  return holds
    ? { slopes: [tilted[0], tilted[1]], inverse: tilted[2] }
    : { slopes: [0, 0], inverse: middle };
}

/** The corners of the photo on its plane, world frame: upper left, upper right, lower left, lower right. */
export function cornersOfProxy(shot: Shot, proxy: Proxy): Vec3[] {
  const axes = axesOf(shot);
  return pictureCorners(shot).map(([x, y]) => onProxy(axes, proxy, x, y));
}

/** What is in the middle of the photo, world frame. */
export function focusOf(shot: Shot, proxy: Proxy): Vec3 {
  const x = (shot.width_px / 2 - shot.centre_px[0]) / shot.focal_px[0];
  const y = (shot.height_px / 2 - shot.centre_px[1]) / shot.focal_px[1];
  return onProxy(axesOf(shot), proxy, x, y);
}

function onProxy(axes: Axes, proxy: Proxy, x: number, y: number): Vec3 {
  const depth = 1 / (proxy.slopes[0] * x + proxy.slopes[1] * y + proxy.inverse);
  const ray = add(axes.ahead, add(scale(axes.right, x), scale(axes.down, y)));
  return add(axes.eye, scale(ray, depth));
}

function pictureCorners(shot: Shot): [number, number][] {
  const { width_px, height_px, focal_px, centre_px } = shot;
  return [0, height_px].flatMap((y) =>
    [0, width_px].map((x): [number, number] => [(x - centre_px[0]) / focal_px[0], (y - centre_px[1]) / focal_px[1]]),
  );
}

function samplesOf(shot: Shot, axes: Axes, points: Float32Array): Sample[] {
  const seen: Sample[] = [];
  for (let i = 0; i + 2 < points.length; i += 3) {
    const at = onPicture(shot, axes, [points[i] ?? 0, points[i + 1] ?? 0, points[i + 2] ?? 0]);
    if (at === null || at.x < 0 || at.y < 0 || at.x > shot.width_px || at.y > shot.height_px) continue;
    const { centre_px, focal_px } = shot;
    seen.push([(at.x - centre_px[0]) / focal_px[0], (at.y - centre_px[1]) / focal_px[1], 1 / at.depth]);
  }
  const stride = Math.ceil(seen.length / MOST_POINTS);
  return stride <= 1 ? seen : seen.filter((_, index) => index % stride === 0);
}

function fit(samples: readonly Sample[], middle: number): Vec3 {
  let plane: Vec3 = [0, 0, middle];
  for (let round = 0; round < ROUNDS; round += 1) {
    const [a, b, c] = plane;
    const off = samples.map(([x, y, inverse]) => Math.abs(inverse - a * x - b * y - c));
    const most = HUBER * Math.max(DEVIATION_OF_MEDIAN * median(off), 1e-9 * middle);
    const next = solved(samples, off.map((value) => (value <= most ? 1 : most / value)));
    if (next === null) return plane;
    plane = next;
  }
  return plane;
}

/** Weighted least squares by the normal equations; null where the points lie on a line. */
function solved(samples: readonly Sample[], weights: readonly number[]): Vec3 | null {
  let [xx, xy, x1, yy, y1, n, xi, yi, i1] = [0, 0, 0, 0, 0, 0, 0, 0, 0];
  for (const [k, [x, y, inverse]] of samples.entries()) {
    const w = weights[k] ?? 0;
    xx += w * x * x;
    xy += w * x * y;
    x1 += w * x;
    yy += w * y * y;
    y1 += w * y;
    n += w;
    xi += w * x * inverse;
    yi += w * y * inverse;
    i1 += w * inverse;
  }
  const first: Vec3 = [xx, xy, x1];
  const second: Vec3 = [xy, yy, y1];
  const third: Vec3 = [x1, y1, n];
  const side: Vec3 = [xi, yi, i1];
  const whole = volume(first, second, third);
  if (whole <= 1e-12 * xx * yy * n) return null;
  return [
    volume(side, second, third) / whole,
    volume(first, side, third) / whole,
    volume(first, second, side) / whole,
  ];
}

function volume(a: Vec3, b: Vec3, c: Vec3): number {
  return (
    a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])
  );
}

function median(values: readonly number[]): number {
  const sorted = values.toSorted((a, b) => a - b);
  return sorted[Math.floor(sorted.length / 2)] ?? 0;
}
