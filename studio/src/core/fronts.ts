/** Where the fronts of a place are: the first picture shows them, and never the backs. */
import type { Place } from "./place.ts";
import type { Vec3 } from "./vector.ts";

/** Three-quarter: so far beside the straight look at a front. */
const BESIDE_RAD = Math.PI / 6;
/** Along a street one looks a little at its left side. */
const ALONG_RAD = Math.PI / 18;
/** Fronts that look the same way on the whole: the length of their mean. */
const ALIKE = 0.5;
/** What has no front is seen from a quarter above (rise over run). */
const FROM_ABOVE = 0.42;

/**
 * Where one looks to: at the fronts from the side that shows all, or along a street whose sides face each other.
 * Level, but for places without a front, which are seen from above. A part's front faces its own -y.
 */
export function outlookOfFronts({ parts, tileset }: Pick<Place, "parts" | "tileset">): Vec3 | null {
  if (tileset !== null) return null; // the size of a town says from how high
  const into = parts.filter(({ photo, isGround }) => photo !== null && !isGround).map(({ worldFromPart }) => {
    const [x, y] = [worldFromPart[4] ?? 0, worldFromPart[5] ?? 1];
    const size = Math.hypot(x, y);
    return size > 0 ? Math.atan2(y / size, x / size) : Math.PI / 2;
  });
  if (into.length === 0) return [0.5, 0.86, -FROM_ABOVE];
  const mean = meanOf(into, 1);
  if (mean.length >= ALIKE) {
    const [left, right] = [mean.angle - BESIDE_RAD, mean.angle + BESIDE_RAD];
    return level(worst(into, left) >= worst(into, right) - 1e-9 ? left : right);
  }
  // Angles and their opposites are one axis: the mean of the doubled ones, halved.
  const across = meanOf(into, 2).angle / 2;
  return level(across - Math.PI / 2 + ALONG_RAD);
}

/** How well the front is seen that is seen worst. */
function worst(into: readonly number[], way: number): number {
  return Math.min(...into.map((angle) => Math.cos(angle - way)));
}

function meanOf(angles: readonly number[], times: number): { angle: number; length: number } {
  const x = angles.reduce((sum, angle) => sum + Math.cos(times * angle), 0) / angles.length;
  const y = angles.reduce((sum, angle) => sum + Math.sin(times * angle), 0) / angles.length;
  return { angle: Math.atan2(y, x), length: Math.hypot(x, y) };
}

function level(angle_rad: number): Vec3 {
  return [Math.cos(angle_rad), Math.sin(angle_rad), 0];
}
