/** How an animal goes: along its path, on to where it is led, slower before it stops. */
import type { Animal } from "./animal.ts";
import { Curve, type OnCurve } from "./curve.ts";
import { add, scale, subtract, type Vec3 } from "./vector.ts";

/** It needs so long to come to its pace, and to stand (s). */
const EASE_S = 0.5;
/** It turns on a circle of so many body lengths. */
const TURN_LENGTHS = 0.55;
/** Steps of a course that is made, in body lengths, and the most of them. */
const STEP_LENGTHS = 0.08;
const MOST_STEPS = 4000;
/** A turn begins only where the target lies so far outside of its circle: one made of steps is not quite round. */
const ROOM = 1.1;

/** Height of the ground; null where there is none. */
export type Ground = (x: number, y: number) => number | null;

export class Course {
  readonly #length_m: number;
  readonly #ground: Ground;
  #curve: Curve;
  #arc = 0;
  #pace = 0;

  constructor(animal: Animal, ground: Ground) {
    this.#length_m = animal.length_m;
    this.#ground = ground;
    this.#curve = new Curve(animal.path, animal.closed);
    // The whole body stands on the path.
    if (!animal.closed) this.#arc = Math.min(0.5 * animal.length_m, 0.5 * this.#curve.length_m);
  }

  get length_m(): number {
    return this.#curve.length_m;
  }

  get pace(): number {
    return this.#pace;
  }

  /** At the end of an open path: it goes on only when it is led. */
  get standing(): boolean {
    return this.#pace === 0 && this.#left === 0;
  }

  /** Metres to the end of an open path; less than a hair is none. */
  get #left(): number {
    const left = this.#curve.closed ? Infinity : this.#curve.length_m - 0.5 * this.#length_m - this.#arc;
    return left < 1e-6 ? 0 : left;
  }

  /** Beside the body's middle, so many metres ahead of it. */
  at(ahead_m: number): OnCurve {
    return this.#curve.at(this.#arc + ahead_m);
  }

  /**
   * Goes on at a speed (m/s); the result is the share of the time in which it moved: its clip goes on by
   * that. At the end of an open path it stands.
   */
  advance(speed: number, wants: boolean, seconds: number): number {
    const left = this.#left;
    const stops = speed * EASE_S * 0.5;
    const wish = !wants || left <= 0 ? 0 : Math.min(1, 0.08 + left / Math.max(stops, 1e-9));
    const change = seconds / EASE_S;
    this.#pace += Math.min(change, Math.max(-change, wish - this.#pace));
    if (left <= 0) this.#pace = 0;
    this.#arc += Math.min(this.#pace * speed * seconds, Math.max(0, left));
    return this.#pace;
  }

  /** Goes on from where it is to a point of the ground, in as wide a turn as its body needs. */
  leadTo(target: Vec3): void {
    const behind: Vec3[] = [];
    const step = STEP_LENGTHS * this.#length_m;
    for (let back = 1.2 * this.#length_m; back > 0; back -= step) behind.push(this.at(-back).point);
    const here = this.at(0);
    const front = this.at(0.5 * this.#length_m);
    for (let on = 0; on < 0.5 * this.#length_m; on += step) behind.push(this.at(on).point);
    const made = courseTo(front, target, step, TURN_LENGTHS * this.#length_m);
    const last = made.at(-1) ?? front.point;
    const on = headingOf(made.at(-2) ?? here.point, last);
    // The middle comes to where one clicked, the head goes on by half the body.
    made.push(add(last, scale(on, 0.25 * this.#length_m)), add(last, scale(on, 0.5 * this.#length_m)));
    const grounded = made.map((point): Vec3 => [point[0], point[1], this.#ground(point[0], point[1]) ?? point[2]]);
    this.#curve = new Curve([...behind, ...grounded], false);
    this.#arc = nearestArc(this.#curve, here.point, 2.5 * this.#length_m);
  }
}

/** Steps from a pose to a target on circles no narrower than `radius`, and straight; z goes along evenly. */
export function courseTo(from: OnCurve, target: Vec3, step: number, radius: number): Vec3[] {
  let yaw = Math.atan2(from.ahead[1], from.ahead[0]);
  let [x, y] = [from.point[0], from.point[1]];
  const flat: [number, number][] = [[x, y]];
  let turning = false;
  for (let count = 0; count < MOST_STEPS; count += 1) {
    const [dx, dy] = [target[0] - x, target[1] - y];
    const away = Math.hypot(dx, dy);
    if (away <= step) break;
    const turn = wrapped(Math.atan2(dy, dx) - yaw);
    const side = turn >= 0 ? 1 : -1;
    const [cx, cy] = [x - side * radius * Math.sin(yaw), y + side * radius * Math.cos(yaw)];
    // Inside its turning circle a target is never come to: it goes straight on until it is outside.
    const room = Math.hypot(target[0] - cx, target[1] - cy) / radius;
    turning = room >= (turning ? 1 : ROOM);
    if (turning || Math.abs(turn) < step / radius) yaw += side * Math.min(Math.abs(turn), step / radius);
    x += step * Math.cos(yaw);
    y += step * Math.sin(yaw);
    flat.push([x, y]);
  }
  flat.push([target[0], target[1]]);
  const rise = target[2] - from.point[2];
  return flat.map(([px, py], i) => [px, py, from.point[2] + (rise * i) / (flat.length - 1)]);
}

function nearestArc(curve: Curve, point: Vec3, most: number): number {
  let [best, least] = [0, Infinity];
  for (let i = 0; i <= 400; i += 1) {
    const arc = (most * i) / 400;
    const [dx, dy] = subtract(curve.at(arc).point, point);
    if (Math.hypot(dx, dy) < least) [best, least] = [arc, Math.hypot(dx, dy)];
  }
  return best;
}

function headingOf(from: Vec3, to: Vec3): Vec3 {
  const [dx, dy] = subtract(to, from);
  const size = Math.hypot(dx, dy);
  return size < 1e-12 ? [1, 0, 0] : [dx / size, dy / size, 0];
}

function wrapped(angle: number): number {
  return angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI));
}
