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
 * Level, but for places whose parts have no photo: those are seen from above, the way that a visitor begins to look,
 * who stands before fronts. Of a town its size says from how high. A part's front faces its own -y.
 */
export function outlookOfFronts({ parts, tileset, start }: Pick<Place, "parts" | "tileset" | "start">): Vec3 {
  const houses = parts.filter(({ isGround, isBackdrop }) => !isGround && !isBackdrop);
  const fronts = tileset === null ? houses.filter(({ photo }) => photo !== null) : [];
  if (fronts.length === 0) {
    // A house of a plan begins straight before its door.
    const isHouse = houses.length === 1 && houses[0]?.document !== null;
    return begun(start, isHouse ? BESIDE_RAD : 0, tileset === null ? FROM_ABOVE : 0);
  }
  const into = fronts.map(({ worldFromPart }) => {
    const [x, y] = [worldFromPart[4] ?? 0, worldFromPart[5] ?? 1];
    const size = Math.hypot(x, y);
    return size > 0 ? Math.atan2(y / size, x / size) : Math.PI / 2;
  });
  const mean = meanOf(into, 1);
  if (mean.length >= ALIKE) {
    const [left, right] = [mean.angle - BESIDE_RAD, mean.angle + BESIDE_RAD];
    return level(worst(into, left) >= worst(into, right) - 1e-9 ? left : right);
  }
  // Angles and their opposites are one axis: the mean of the doubled ones, halved.
  const across = meanOf(into, 2).angle / 2;
  return level(across - Math.PI / 2 + ALONG_RAD);
}

/** The way that a visitor looks at first, so far beside it, and so much from above. */
function begun({ eye, target }: Place["start"], beside_rad: number, rise: number): Vec3 {
  const [east, north] = [target[0] - eye[0], target[1] - eye[1]];
  if (Math.hypot(east, north) === 0) return [0.5, 0.86, -rise];
  const [x, y] = level(Math.atan2(north, east) - beside_rad);
  return [x, y, -rise];
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
