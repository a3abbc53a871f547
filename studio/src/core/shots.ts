/** Photos in space: their corners, and the view that shows one whole. */
import { worldPoint } from "./frames.ts";
import { type Box, cornersOf } from "./framing.ts";
import { axesOf } from "./pinhole.ts";
import type { Cloud, Shot } from "./place.ts";
import { length, subtract, type Vec3 } from "./vector.ts";

/** Least length of the mean of the photos' level directions that says where they look to. */
const AGREED = 0.2;
/** Share of the screen that stays free around a photo. */
const MARGIN = 0.06;
/** How deep a pyramid is, in shares of the place's size, and of the way to the nearest other one. */
const PLACE_SHARE = 0.045;
const NEAREST_SHARE = 0.6;
const LEAST_SHARE = 0.008;

/** Upper left, upper right, lower left, lower right, in the camera's frame at this depth. */
export function cornersOfShot(shot: Shot, depth: number): Vec3[] {
  const { width_px, height_px, focal_px, centre_px } = shot;
  const at = (x: number, y: number): Vec3 => [
    (depth * (x - centre_px[0])) / focal_px[0],
    (depth * (y - centre_px[1])) / focal_px[1],
    depth,
  ];
  return [at(0, 0), at(width_px, 0), at(0, height_px), at(width_px, height_px)];
}

/** How deep the pyramids are drawn in a place of this size: as large as goes without a tangle. */
export function depthOfFrusta(shots: readonly Shot[], size: number): number {
  const eyes = shots.map(({ worldFromCamera }) => worldPoint(worldFromCamera, [0, 0, 0]));
  const gaps: number[] = [];
  for (let i = 1; i < eyes.length; i++) {
    const [eye, before] = [eyes[i], eyes[i - 1]];
    if (eye !== undefined && before !== undefined) gaps.push(length(subtract(eye, before)));
  }
  gaps.sort((a, b) => a - b);
  const typical = gaps[Math.floor(gaps.length / 2)] ?? Infinity;
  return Math.max(LEAST_SHARE * size, Math.min(PLACE_SHARE * size, NEAREST_SHARE * typical));
}

/**
 * The vertical angle of view of a screen that shows the whole photo, and where the view's centre
 * lies on it: the photo's middle is in the middle of the screen, its principal point need not be.
 */
export function fovOfShot(shot: Shot, aspect: number): { fov_deg: number; shift: readonly [number, number] } {
  const height = shot.height_px / shot.focal_px[1];
  const width = shot.width_px / shot.focal_px[0];
  const shown = Math.max(height, width / aspect) * (1 + 2 * MARGIN);
  const x = (shot.centre_px[0] - shot.width_px / 2) / shot.focal_px[0] / (shown * aspect);
  const y = (shot.centre_px[1] - shot.height_px / 2) / shot.focal_px[1] / shown;
  return { fov_deg: (2 * Math.atan(shown / 2) * 180) / Math.PI, shift: [x, y] };
}

/** Where the photos look to in the mean (unit, level); null where they look all about. */
export function outlookOf(shots: readonly Shot[]): Vec3 | null {
  const [x, y] = shots
    .map((shot) => axesOf(shot).ahead)
    .reduce<readonly [number, number]>((sum, ahead) => [sum[0] + ahead[0], sum[1] + ahead[1]], [0, 0]);
  const size = Math.hypot(x, y);
  return size > 0 && size >= AGREED * shots.length ? [x / size, y / size, 0] : null;
}

/** The box around the clouds (nearly all of their points) and the places of the photos. */
export function boundsOfShots(clouds: readonly Cloud[], shots: readonly Shot[]): Box {
  const min: [number, number, number] = [Infinity, Infinity, Infinity];
  const max: [number, number, number] = [-Infinity, -Infinity, -Infinity];
  const seen = clouds.flatMap(({ bounds, worldFromPoints }) =>
    cornersOf(bounds).map((corner) => worldPoint(worldFromPoints, corner)),
  );
  const eyes = shots.map(({ worldFromCamera }) => worldPoint(worldFromCamera, [0, 0, 0]));
  for (const point of [...seen, ...eyes]) {
    for (const axis of [0, 1, 2] as const) {
      min[axis] = Math.min(min[axis], point[axis]);
      max[axis] = Math.max(max[axis], point[axis]);
    }
  }
  return { min, max };
}
