/** What is seen from where one is, by and large: what comes first is what one sees. */
import { dot, length, subtract, type Vec3 } from "./vector.ts";

export interface Sight {
  readonly eye: Vec3;
  /** Unit vector; null where nothing is known of it: then all is seen. */
  readonly direction: Vec3 | null;
  /** The angle from the middle of the picture to its corner. */
  readonly half_rad: number;
}

export interface Ball {
  readonly middle: Vec3;
  readonly radius: number;
}

/** `fovY_rad` is the vertical angle of view, `aspect` the picture's width over its height. */
export function sightOf(eye: Vec3, direction: Vec3, fovY_rad: number, aspect: number): Sight {
  return { eye, direction, half_rad: Math.atan(Math.tan(fovY_rad / 2) * Math.hypot(1, aspect)) };
}

/** Whether some of a ball is in the cone around the picture. */
export function sees({ eye, direction, half_rad }: Sight, { middle, radius }: Ball): boolean {
  const way = subtract(middle, eye);
  const away = length(way);
  if (direction === null || away <= radius) return true;
  const aside = Math.acos(Math.min(1, Math.max(-1, dot(way, direction) / away)));
  return aside - Math.asin(radius / away) <= half_rad;
}

/** How far its surface is from the eye; 0 within. */
export function awayFrom({ eye }: Sight, { middle, radius }: Ball): number {
  return Math.max(0, length(subtract(middle, eye)) - radius);
}
