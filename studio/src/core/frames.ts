/** Between the world frame (z up) and the frame of glTF and three.js (y up). */
import type { Vec3 } from "./vector.ts";

/** Column-major 4x4, as in `place.json` and in three.js. */
export type Matrix4 = readonly number[];

export function drawnFromWorld(p: Vec3): Vec3 {
  return [p[0], p[2], -p[1]];
}

export function worldFromDrawn(p: Vec3): Vec3 {
  return [p[0], -p[2], p[1]];
}

/**
 * `world_from_part` acts on z-up coordinates; a GLB holds y-up ones. With S the turn from z up
 * to y up the same motion there is S M S^-1: rows and columns change places with their sign.
 */
export function drawnFromModel(worldFromPart: Matrix4): number[] {
  const column = (c: number): Vec3 => [
    worldFromPart[4 * c] ?? 0,
    worldFromPart[4 * c + 1] ?? 0,
    worldFromPart[4 * c + 2] ?? 0,
  ];
  const x = drawnFromWorld(column(0));
  const y = drawnFromWorld(column(2));
  const [nx, ny, nz] = drawnFromWorld(column(1));
  const t = drawnFromWorld(column(3));
  return [...x, 0, ...y, 0, -nx, -ny, -nz, 0, ...t, 1];
}

export function worldPoint(worldFromPart: Matrix4, p: Vec3): Vec3 {
  const at = (row: number): number =>
    (worldFromPart[row] ?? 0) * p[0] +
    (worldFromPart[row + 4] ?? 0) * p[1] +
    (worldFromPart[row + 8] ?? 0) * p[2] +
    (worldFromPart[row + 12] ?? 0);
  return [at(0), at(1), at(2)];
}

/** Nine coordinates per face, from the world frame to the drawn one. */
export function drawnFaces(positions: Float32Array): Float32Array {
  const drawn = new Float32Array(positions.length);
  for (let i = 0; i + 2 < positions.length; i += 3) {
    drawn.set(drawnFromWorld([positions[i] ?? 0, positions[i + 1] ?? 0, positions[i + 2] ?? 0]), i);
  }
  return drawn;
}
