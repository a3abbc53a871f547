/** A photo as a camera: its axes, and where a point of the drawn frame lies on its picture. */
import { drawnFromWorld, worldPoint } from "./frames.ts";
import type { Shot } from "./place.ts";
import { dot, length, scale, subtract, type Vec3 } from "./vector.ts";

/** World frame; the axes are unit vectors, as a registered place may be larger than its photos say. */
export interface Axes {
  readonly eye: Vec3;
  readonly right: Vec3;
  readonly down: Vec3;
  readonly ahead: Vec3;
}

export function axesOf(shot: Shot): Axes {
  const eye = worldPoint(shot.worldFromCamera, [0, 0, 0]);
  const axis = (tip: Vec3): Vec3 => {
    const arrow = subtract(worldPoint(shot.worldFromCamera, tip), eye);
    return scale(arrow, 1 / length(arrow));
  };
  return { eye, right: axis([1, 0, 0]), down: axis([0, 1, 0]), ahead: axis([0, 0, 1]) };
}

/** How deep a point lies before the camera, and where on the picture (px); null behind it. */
export function onPicture(shot: Shot, axes: Axes, point: Vec3): { depth: number; x: number; y: number } | null {
  const way = subtract(point, axes.eye);
  const depth = dot(way, axes.ahead);
  if (depth <= 0) return null;
  return {
    depth,
    x: (shot.focal_px[0] * dot(way, axes.right)) / depth + shot.centre_px[0],
    y: (shot.focal_px[1] * dot(way, axes.down)) / depth + shot.centre_px[1],
  };
}

/**
 * The projection of OpenGL (column-major; clip coordinates, y up, depth -1..1 between near and far)
 * whose picture is the photo's: its left edge at -1, its upper edge at 1.
 */
export function clipFromCamera(shot: Shot, near: number, far: number): number[] {
  const { width_px, height_px, focal_px, centre_px } = shot;
  const deep = (far + near) / (near - far);
  const fall = (2 * far * near) / (near - far);
  // The camera of OpenGL looks along -z with y up.
  return [
    (2 * focal_px[0]) / width_px, 0, 0, 0,
    0, (2 * focal_px[1]) / height_px, 0, 0,
    1 - (2 * centre_px[0]) / width_px, (2 * centre_px[1]) / height_px - 1, deep, -1,
    0, 0, fall, 0,
  ];
}

/** The camera of OpenGL in the drawn frame (column-major): x right, y up, looking along -z. */
export function drawnFromCamera(axes: Axes): number[] {
  const column = (v: Vec3): Vec3 => drawnFromWorld(v);
  return [
    ...column(axes.right), 0,
    ...column(scale(axes.down, -1)), 0,
    ...column(scale(axes.ahead, -1)), 0,
    ...drawnFromWorld(axes.eye), 1,
  ];
}
