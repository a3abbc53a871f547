/** How an animal goes: along its path, on to where it is led, slower before it stops or turns on the spot. */
import type { Animal } from "./animal.ts";
import { Curve, type OnCurve } from "./curve.ts";
import { Pivot, wrapped, yawOf } from "./pivot.ts";
import { add, scale, subtract, type Vec3 } from "./vector.ts";

/** It needs so long to come to its pace, and to stand (s). */
const EASE_S = 0.5;
/** It turns on a circle of so many body lengths. */
const TURN_LENGTHS = 0.55;
/** What has legs turns on the spot where it would have to turn by more than this (rad). */
const SPOT_RAD = Math.PI / 3;
/** A nearer target (body lengths) is come to in a curve: there is no straight way to it. */
const NEAR_LENGTHS = 0.3;
/** Steps of a course that is made, in body lengths, and the most of them. */
const STEP_LENGTHS = 0.08;
const MOST_STEPS = 4000;
/** A turn begins only where the target lies so far outside of its circle: one made of steps is not quite round. */
const ROOM = 1.1;

/** Height of the ground; null where there is none. */
export type Ground = (x: number, y: number) => number | null;

/** A curve that is gone from one arc of it to another one. */
interface Piece {
  readonly curve: Curve;
  readonly begin: number;
  readonly end: number;
}

export class Course {
  readonly #length_m: number;
  readonly #legs: boolean;
  readonly #ground: Ground;
  /** What is gone now, and after it; between two of them it turns on the spot. */
  #pieces: readonly Piece[];
  #pivot: Pivot | null = null;
  #turned_m = 0;
  #arc = 0;
  #pace = 0;
  #speed = 0;

  constructor(animal: Animal, ground: Ground) {
    this.#length_m = animal.length_m;
    this.#legs = animal.turns !== null;
    this.#ground = ground;
    const cuts = [0, ...(animal.turns ?? []), animal.path.length - 1];
    const curves = cuts.slice(1).map((end, i) => new Curve(animal.path.slice(cuts[i], end + 1), animal.closed));
    // The whole body stands on the path at both ends of it; in a corner its middle does.
    const half = (curve: Curve): number => (curve.closed ? 0 : Math.min(0.5 * animal.length_m, 0.5 * curve.length_m));
    this.#pieces = curves.map((curve, i) => ({
      curve,
      begin: i === 0 ? half(curve) : 0,
      end: curve.closed ? Infinity : curve.length_m - (i === curves.length - 1 ? half(curve) : 0),
    }));
    this.#arc = this.#piece.begin;
  }

  get pace(): number {
    return this.#pace;
  }

  /** At the end of an open path: it goes on only when it is led. */
  get standing(): boolean {
    return this.#pace === 0 && this.#left === 0 && this.#pieces.length === 1;
  }

  /** Radians a second by which it turns on the spot, to the left positive. */
  get spin(): number {
    return this.#pivot === null ? 0 : (Math.sign(this.#pivot.turn) * this.#pace * this.#speed) / this.#arm;
  }

  get isTurning(): boolean {
    return this.#pivot !== null;
  }

  get #piece(): Piece {
    const [first] = this.#pieces;
    if (first === undefined) throw new RangeError("a course without a piece");
    return first;
  }

  /** The ends of a body that turns go about its middle as fast as it walks. */
  get #arm(): number {
    return 0.5 * this.#length_m;
  }

  /** Metres to the end of the piece, or of the turn; less than a hair is none. */
  get #left(): number {
    const left = this.#pivot === null ? this.#piece.end - this.#arc : Math.abs(this.#pivot.turn) * this.#arm - this.#turned_m;
    return left < 1e-6 ? 0 : left;
  }

  /** Beside the body's middle, so many metres ahead of it. */
  at(ahead_m: number): OnCurve {
    if (this.#pivot === null) return this.#piece.curve.at(this.#arc + ahead_m);
    const whole = Math.max(Math.abs(this.#pivot.turn) * this.#arm, 1e-9);
    return this.#pivot.at(ahead_m, Math.min(1, this.#turned_m / whole), this.#pace);
  }

  /**
   * Goes on at a speed (m/s); the result is the share of the time in which it moved: its clip goes on by
   * that. At the end of an open path it stands.
   */
  advance(speed: number, wants: boolean, seconds: number): number {
    this.#speed = speed;
    if (this.#left <= 0) this.#goOn();
    const left = this.#left;
    const stops = speed * EASE_S * 0.5;
    const wish = !wants || left <= 0 ? 0 : Math.min(1, 0.08 + left / Math.max(stops, 1e-9));
    const change = seconds / EASE_S;
    this.#pace += Math.min(change, Math.max(-change, wish - this.#pace));
    if (left <= 0) this.#pace = 0;
    const moved = Math.min(this.#pace * speed * seconds, Math.max(0, left));
    if (this.#pivot === null) this.#arc += moved;
    else this.#turned_m += moved;
    return this.#pace;
  }

  /** At the end of a piece it turns to the next one; at the end of that it goes along it. */
  #goOn(): void {
    const [here, next] = this.#pieces;
    if (here === undefined || next === undefined) return;
    this.#pace = 0;
    if (this.#pivot === null) {
      this.#pivot = new Pivot(here.curve, next.curve, this.#length_m);
      this.#turned_m = 0;
    } else {
      this.#pivot = null;
      this.#pieces = this.#pieces.slice(1);
      this.#arc = next.begin;
    }
  }

  /**
   * Goes on from where it is to a point of the ground, in as wide a turn as its body needs; what has legs
   * stops and turns on the spot where the point is beside or behind it. `corners` are passed before it.
   */
  leadTo(target: Vec3, corners: readonly Vec3[] = []): void {
    const here = this.at(0);
    const way = [...corners, target];
    const [dx, dy] = subtract(way[0] ?? target, here.point);
    const turn = wrapped(Math.atan2(dy, dx) - yawOf(here.ahead));
    const spot = this.#legs && Math.abs(turn) > SPOT_RAD && Math.hypot(dx, dy) > NEAR_LENGTHS * this.#length_m;
    // What has legs keeps to the straight pieces of a way round something: it turns in their corners.
    const pieces = spot || (this.#legs && corners.length > 0) ? this.#byTurning(way) : [this.#byCurve(way)];
    this.#pivot = null;
    this.#pieces = pieces;
    this.#arc = nearestArc(this.#piece.curve, here.point, 2.5 * this.#length_m);
  }

  /** The body's line, from behind its rump to so far ahead of its middle. */
  #line(ahead_m: number): Vec3[] {
    const found: Vec3[] = [];
    const step = STEP_LENGTHS * this.#length_m;
    for (let back = 1.2 * this.#length_m; back > 0; back -= step) found.push(this.at(-back).point);
    for (let on = 0; on < ahead_m; on += step) found.push(this.at(on).point);
    return found;
  }

  #byCurve(way: readonly Vec3[]): Piece {
    const made: Vec3[] = [];
    let front = this.at(0.5 * this.#length_m);
    for (const target of way) {
      made.push(...courseTo(front, target, STEP_LENGTHS * this.#length_m, TURN_LENGTHS * this.#length_m));
      front = { point: target, ahead: headingOf(made.at(-2) ?? front.point, target) };
    }
    const curve = new Curve([...this.#line(0.5 * this.#length_m), ...this.#grounded(this.#withHead(made))], false);
    return { curve, begin: 0, end: curve.length_m - 0.5 * this.#length_m };
  }

  /** On until it can stand, and from there straight from corner to corner. */
  #byTurning(way: readonly Vec3[]): Piece[] {
    const on = this.#pivot === null ? 0.5 * this.#speed * EASE_S * this.#pace ** 2 : 0;
    const start = this.at(on).point;
    const before = new Curve([...this.#line(on), start], false);
    const pieces: Piece[] = [{ curve: before, begin: 0, end: before.length_m }];
    let corner = start;
    for (const [i, target] of way.entries()) {
      const isLast = i === way.length - 1;
      const straight = this.#straight(corner, target);
      const curve = new Curve([corner, ...this.#grounded(isLast ? this.#withHead(straight) : straight).slice(1)], false);
      pieces.push({ curve, begin: 0, end: curve.length_m - (isLast ? 0.5 * this.#length_m : 0) });
      corner = curve.at(curve.length_m).point;
    }
    return pieces;
  }

  #straight(from: Vec3, to: Vec3): Vec3[] {
    const steps = Math.max(2, Math.ceil(length2(subtract(to, from)) / (STEP_LENGTHS * this.#length_m)));
    return Array.from({ length: steps + 1 }, (_, i) => add(from, scale(subtract(to, from), i / steps)));
  }

  /** The middle comes to where one clicked, the head goes on by half the body. */
  #withHead(made: readonly Vec3[]): Vec3[] {
    const last = made.at(-1) ?? this.at(0).point;
    const on = headingOf(made.at(-2) ?? this.at(0).point, last);
    return [...made, add(last, scale(on, 0.25 * this.#length_m)), add(last, scale(on, 0.5 * this.#length_m))];
  }

  #grounded(points: readonly Vec3[]): Vec3[] {
    return points.map((point): Vec3 => [point[0], point[1], this.#ground(point[0], point[1]) ?? point[2]]);
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

function length2([x, y]: Vec3): number {
  return Math.hypot(x, y);
}
