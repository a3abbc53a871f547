/** A turn on the spot in the corner between two curves: how the body lies while it turns. */
import type { Curve, OnCurve } from "./curve.ts";
import { length, scale, type Vec3 } from "./vector.ts";

/** At full pace nose and rump lead and trail so far (rad) on a body's length: it looks where it turns. */
const LEAD_RAD = 0.5;

export class Pivot {
  /** How far it turns (rad), to the left positive, on the shorter way. */
  readonly turn: number;
  readonly #before: Curve;
  readonly #after: Curve;
  readonly #length_m: number;
  readonly #yaw: number;

  constructor(before: Curve, after: Curve, length_m: number) {
    this.#before = before;
    this.#after = after;
    this.#length_m = length_m;
    this.#yaw = yawOf(before.at(before.length_m).ahead);
    this.turn = wrapped(yawOf(after.at(0).ahead) - this.#yaw);
  }

  /** The body's line, so many metres ahead of its middle, when so much of the turn is done at such a pace (0..1). */
  at(ahead_m: number, done: number, pace: number): OnCurve {
    const sides = [
      { share: 1 - done, ...placed(this.#before, this.#before.length_m, ahead_m) },
      { share: done, ...placed(this.#after, 0, ahead_m) },
    ];
    const yaw = this.#yaw + this.turn * done;
    const [cos, sin] = [Math.cos(yaw), Math.sin(yaw)];
    const sum = (of: (side: (typeof sides)[number]) => number): number => sides.reduce((total, side) => total + side.share * of(side), 0);
    const [along, aside] = [sum((side) => side.along), sum((side) => side.aside)];
    const [x, y] = this.#before.at(this.#before.length_m).point;
    const lead = ((Math.sign(this.turn) * LEAD_RAD) / this.#length_m) * pace * ahead_m;
    const looks = yaw + sum((side) => side.turned) + lead;
    const slope = sum((side) => side.slope);
    const ahead: Vec3 = [Math.cos(looks), Math.sin(looks), slope];
    return { point: [x + along * cos - aside * sin, y + along * sin + aside * cos, sum((side) => side.z)], ahead: scale(ahead, 1 / length(ahead)) };
  }
}

interface Placed {
  readonly along: number;
  readonly aside: number;
  readonly turned: number;
  readonly slope: number;
  readonly z: number;
}

/** What a curve has so far ahead of a corner at an arc, in the frame of the corner. */
function placed(curve: Curve, corner_m: number, ahead_m: number): Placed {
  const [here, there] = [curve.at(corner_m), curve.at(corner_m + ahead_m)];
  const yaw = yawOf(here.ahead);
  const [dx, dy] = [there.point[0] - here.point[0], there.point[1] - here.point[1]];
  const [cos, sin] = [Math.cos(yaw), Math.sin(yaw)];
  const flat = Math.hypot(there.ahead[0], there.ahead[1]);
  return {
    along: dx * cos + dy * sin,
    aside: dy * cos - dx * sin,
    turned: wrapped(yawOf(there.ahead) - yaw),
    slope: there.ahead[2] / Math.max(flat, 1e-9),
    z: there.point[2],
  };
}

export function yawOf([x, y]: Vec3): number {
  return Math.atan2(y, x);
}

export function wrapped(angle: number): number {
  return angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI));
}
