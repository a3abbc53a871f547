/** When a door opens by itself: for whoever comes to it; and when it closes behind him. World frame. */
import { directionOf, type Heading } from "./heading.ts";
import type { Vec3 } from "./vector.ts";

/** The closed leaves of a door, seen from above. */
export interface Doorway {
  /** Under the middle of the leaves. */
  readonly foot: Vec3;
  /** Unit vector along the leaves. */
  readonly along: readonly [number, number];
  readonly halfWidth_m: number;
}

export interface Visitor {
  readonly feet: Vec3;
  /** Null for whoever goes on wherever he looks, as on a tour. */
  readonly heading: Heading | null;
}

/** Two metres are walked in a second, and a leaf takes no longer: nobody has to stop. */
export const OPENING_S = 0.8;
/** A leaf that is less open stops people; one that is more open gives way to them. */
export const PASSABLE = 0.4;
/** Whoever is as near as this opens it whichever way he looks. */
const TOUCH_M = 0.75;
/** From here it opens for those who look to it. */
const APPROACH_M = 2.0;
const LOOKS_TO = Math.cos((45 * Math.PI) / 180);
/** It closes behind whoever has gone further; more than APPROACH_M, so that it does not flutter. */
const LEAVE_M = 2.5;
const BESIDE_M = 0.45;
/** Of the storey above or below, no doors open. */
const LEVEL_M = 1.2;

/** Whether a door should stand open for the visitor. */
export function isWanted(doorway: Doorway, { feet, heading }: Visitor, isOpen: boolean): boolean {
  const [x, y] = [doorway.foot[0] - feet[0], doorway.foot[1] - feet[1]];
  if (Math.abs(doorway.foot[2] - feet[2]) > LEVEL_M) return false;
  const beside = Math.abs(x * doorway.along[0] + y * doorway.along[1]) - doorway.halfWidth_m;
  const before = Math.abs(x * doorway.along[1] - y * doorway.along[0]);
  if (isOpen) return before < LEAVE_M && beside < 2 * BESIDE_M;
  if (beside < BESIDE_M / 2 && before < TOUCH_M) return true;
  if (beside > BESIDE_M || before > APPROACH_M) return false;
  if (heading === null) return true;
  const ahead = directionOf({ yaw: heading.yaw, pitch: 0 });
  return x * ahead[0] + y * ahead[1] > LOOKS_TO * Math.hypot(x, y);
}

/** How open it is after `seconds`, on its way to open (1) or closed (0). */
export function swung(share: number, isOpening: boolean, seconds: number): number {
  const step = seconds / OPENING_S;
  return isOpening ? Math.min(1, share + step) : Math.max(0, share - step);
}

/** A leaf starts and stops gently. */
export function eased(share: number): number {
  return share * share * (3 - 2 * share);
}

/** The doorway of leaves whose corners are given. */
export function doorwayOf(corners: readonly Vec3[]): Doorway {
  const [x0, x1] = ends(corners, ([x]) => x);
  const [y0, y1] = ends(corners, ([, y]) => y);
  // Halfway between the ends, for corners crowd where handles are.
  const [cx, cy] = [(x0 + x1) / 2, (y0 + y1) / 2];
  let [xx, xy, yy] = [0, 0, 0];
  for (const [x, y] of corners) {
    xx += (x - cx) ** 2;
    xy += (x - cx) * (y - cy);
    yy += (y - cy) ** 2;
  }
  // The main direction of the corners: leaves are much wider than thick.
  const angle = 0.5 * Math.atan2(2 * xy, xx - yy);
  const along = [Math.cos(angle), Math.sin(angle)] as const;
  const [near, far] = ends(corners, ([x, y]) => (x - cx) * along[0] + (y - cy) * along[1]);
  const centre = (near + far) / 2;
  const [bottom] = ends(corners, ([, , z]) => z);
  return {
    foot: [cx + centre * along[0], cy + centre * along[1], bottom],
    along,
    halfWidth_m: (far - near) / 2,
  };
}

function ends(corners: readonly Vec3[], of: (corner: Vec3) => number): [number, number] {
  return corners.map(of).reduce<[number, number]>(
    ([low, high], value) => [Math.min(low, value), Math.max(high, value)],
    [Infinity, -Infinity],
  );
}
