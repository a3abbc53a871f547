/**
 * Walking: a body that stands on the ground, is stopped by walls and slides along them.
 *
 * The horizontal velocity follows the wish with a time constant and both it and the fall are
 * integrated in closed form, so that the way walked does not depend on the frame rate.
 * Frame: world, z up, metres, seconds. The ground is the plane z = 0, or the place's own where it
 * lies higher, plus whatever the obstacles offer to stand on. Nobody falls through it, however fast
 * they are and however late it arrives.
 */
import { directionOf, type Heading } from "./heading.ts";
import { add, dot, length, scale, type Vec3 } from "./vector.ts";

/** An upright capsule. */
export interface Body {
  readonly radius_m: number;
  readonly height_m: number;
  readonly eye_m: number;
}

export interface WalkOptions {
  readonly body: Body;
  readonly walk_m_s: number;
  readonly run_m_s: number;
  /** Time constant with which the velocity follows the keys. */
  readonly response_s: number;
  readonly gravity_m_s2: number;
  /** How far from the origin of the reach the ground goes on. */
  readonly reach_m: number;
  readonly reachCentre: readonly [number, number];
}

/** Within a house: doors are narrow, and nobody goes through them chest first. */
export const INDOOR_BODY: Body = { radius_m: 0.2, height_m: 1.8, eye_m: 1.7 };

export const DEFAULT_WALK: WalkOptions = {
  body: { radius_m: 0.3, height_m: 1.8, eye_m: 1.7 },
  walk_m_s: 2.0,
  run_m_s: 5.5,
  response_s: 0.08,
  gravity_m_s2: 9.81,
  reach_m: 400,
  reachCentre: [0, 0],
};

/** What the keys, the mouse or the joystick ask for; `forward` and `right` in -1..1. */
export interface WalkWish {
  readonly forward: number;
  readonly right: number;
  readonly run: boolean;
}

export interface Walker {
  /** Lowest point of the body. */
  readonly feet: Vec3;
  readonly velocity: Vec3;
  readonly heading: Heading;
  readonly grounded: boolean;
  /** Something stood in the way during the last step. */
  readonly blocked: boolean;
}

export interface Obstacles {
  /** The translation that frees the body standing at `feet`; null where it is free. */
  pushOut(feet: Vec3, body: Body): Vec3 | null;
  /** How high the place's own ground lies there (m); null where there is none. */
  groundAt?(x: number, y: number): number | null;
}

/** Longest step that is integrated at once; a page that slept does not make the walker leap. */
const LONGEST_STEP_S = 0.1;
/** Free directions of a corner are found one wall at a time. */
const PUSHES = 4;
/** cos 45 deg: steeper ground is a wall. */
const STANDABLE = Math.SQRT1_2;
const TOUCH_M = 1e-4;
/** A body that stands is pressed down no more than this, so that no floor's edge throws it aside. */
const PRESS_M = 0.01;
/** What stands in the way of a body that stands is a step if this lifts it over; the least that does. */
const LIFTS_M = [0.1, 0.25];
const LOWERINGS = 8;
/** What is lower the round foot of the body rolls over: so low a step is a wall that pushes unevenly. */
const LEAST_STEP_M = 0.02;
/** A step has room for this much of a foot. */
const FOOTING_M = 0.1;
/** How far two pushes off the same wall may differ, as a share. */
const NOISE = 0.05;

export function standing(eye: Vec3, heading: Heading, options: WalkOptions): Walker {
  return {
    feet: [eye[0], eye[1], Math.max(0, eye[2] - options.body.eye_m)],
    velocity: [0, 0, 0],
    heading,
    grounded: false,
    blocked: false,
  };
}

export function eyeOf(walker: Walker, body: Body): Vec3 {
  return add(walker.feet, [0, 0, body.eye_m]);
}

export function isMoving(walker: Walker): boolean {
  return !walker.grounded || length(walker.velocity) > 1e-3;
}

/** The walker after `seconds`. */
export function step(
  walker: Walker,
  wish: WalkWish,
  seconds: number,
  obstacles: Obstacles,
  options: WalkOptions,
): Walker {
  const dt = Math.min(seconds, LONGEST_STEP_S);
  if (dt <= 0) return walker;
  const moved = advance(walker, wishedVelocity(wish, walker.heading, options), dt, options);
  const landed = collide(walker, moved.way, moved.velocity, obstacles, options);
  return { ...landed, heading: walker.heading };
}

/** Horizontal velocity that the wish asks for; a diagonal is not faster. */
export function wishedVelocity(wish: WalkWish, heading: Heading, options: WalkOptions): Vec3 {
  const size = Math.hypot(wish.forward, wish.right);
  if (size === 0) return [0, 0, 0];
  const speed = (wish.run ? options.run_m_s : options.walk_m_s) * Math.min(1, size);
  const ahead = directionOf({ yaw: heading.yaw, pitch: 0 });
  const right: Vec3 = [ahead[1], -ahead[0], 0];
  return scale(add(scale(ahead, wish.forward), scale(right, wish.right)), speed / size);
}

/** Free motion during `dt`: dv/dt = (target - v) / response horizontally, a fall vertically. */
function advance(
  walker: Walker,
  target: Vec3,
  dt: number,
  options: WalkOptions,
): { way: Vec3; velocity: Vec3 } {
  const rest = Math.exp(-dt / options.response_s);
  const lag = options.response_s * (1 - rest);
  const [vx, vy, vz] = walker.velocity;
  const g = options.gravity_m_s2;
  const fall = vz * dt - 0.5 * g * dt * dt;
  return {
    way: [
      target[0] * dt + (vx - target[0]) * lag,
      target[1] * dt + (vy - target[1]) * lag,
      walker.grounded ? Math.max(fall, -PRESS_M) : fall,
    ],
    velocity: [
      target[0] + (vx - target[0]) * rest,
      target[1] + (vy - target[1]) * rest,
      vz - g * dt,
    ],
  };
}

/** Goes the way in steps shorter than half the body's radius, so that no wall is jumped over. */
function collide(
  { feet: from, grounded: stood }: Walker,
  way: Vec3,
  velocity: Vec3,
  obstacles: Obstacles,
  options: WalkOptions,
): Moving {
  const steps = Math.max(1, Math.ceil(length(way) / (options.body.radius_m / 2)));
  let state: Moving = { feet: from, velocity, grounded: false, blocked: false };
  let leg = scale(way, 1 / steps);
  for (let i = 0; i < steps; i += 1) {
    const canStep = state.grounded || (i === 0 && stood);
    state = settle({ ...state, feet: add(state.feet, leg) }, canStep, obstacles, options);
    if (state.grounded && leg[2] < 0) leg = [leg[0], leg[1], 0];
  }
  return state;
}

type Moving = Omit<Walker, "heading">;

/** Frees the body from what it touches and takes the velocity into it away. */
function settle(state: Moving, canStep: boolean, obstacles: Obstacles, options: WalkOptions): Moving {
  let { feet, velocity, grounded, blocked } = onGround(state, obstacles);
  for (let i = 0; i < PUSHES; i += 1) {
    const push = obstacles.pushOut(feet, options.body);
    const size = push === null ? 0 : length(push);
    if (push === null || size < TOUCH_M) break;
    const normal = scale(push, 1 / size);
    if (normal[2] >= STANDABLE) {
      // Straight up: whoever is pushed away from a slope slides down it for ever.
      feet = add(feet, [0, 0, size / normal[2]]);
      velocity = withoutInto(velocity, [0, 0, 1]);
      grounded = true;
      continue;
    }
    const step = canStep ? stepped(feet, push, obstacles, options.body) : null;
    if (step !== null) {
      feet = step;
      velocity = withoutInto(velocity, [0, 0, 1]);
      grounded = true;
    } else {
      // Sideways alone, for the push may be that of a wall and of the floor before it: the next has
      // the floor's.
      const aside: Vec3 = push[2] > 0 ? [push[0], push[1], 0] : push;
      feet = add(feet, aside);
      velocity = withoutInto(velocity, scale(aside, 1 / length(aside)));
      blocked = true;
    }
  }
  return withinReach(onGround({ feet, velocity, grounded, blocked }, obstacles), options);
}

/** Where a body that `push` would move back stands instead, if what is in its way is a step. */
function stepped(feet: Vec3, push: Vec3, obstacles: Obstacles, body: Body): Vec3 | null {
  for (const lift of LIFTS_M) {
    const above = add(feet, [0, 0, lift]);
    const aside = obstacles.pushOut(above, body) ?? [0, 0, 0];
    // A wall beside the step pushes there, too: only what it does not push is the step's.
    const back: Vec3 = [push[0] - aside[0], push[1] - aside[1], 0];
    if (length(back) < Math.max(TOUCH_M, NOISE * length(push))) continue;
    const from: Vec3 = [feet[0] + aside[0], feet[1] + aside[1], feet[2]];
    const isFree = (height: number, ahead: Vec3 = [0, 0, 0]): boolean =>
      length(obstacles.pushOut(add(add(from, ahead), [0, 0, height]), body) ?? [0, 0, 0]) < TOUCH_M;
    // Free further on, too: else it is only the rounding of the body that slips over an edge.
    if (!isFree(lift) || !isFree(lift, scale(back, -FOOTING_M / length(back)))) continue;
    let [low, high] = [0, lift];
    for (let i = 0; i < LOWERINGS; i += 1) {
      const middle = (low + high) / 2;
      if (isFree(middle)) high = middle;
      else low = middle;
    }
    if (high < LEAST_STEP_M) continue;
    return add(from, [0, 0, high]);
  }
  return null;
}

/** The ground carries whoever would be below it. */
function onGround(state: Moving, obstacles: Obstacles): Moving {
  const { feet, velocity } = state;
  const height = Math.max(0, obstacles.groundAt?.(feet[0], feet[1]) ?? 0);
  if (feet[2] > height) return state;
  return {
    ...state,
    feet: [feet[0], feet[1], height],
    velocity: withoutInto(velocity, [0, 0, 1]),
    grounded: true,
  };
}

function withoutInto(velocity: Vec3, normal: Vec3): Vec3 {
  const into = dot(velocity, normal);
  return into < 0 ? add(velocity, scale(normal, -into)) : velocity;
}

function withinReach(state: Moving, options: WalkOptions): Moving {
  const [cx, cy] = options.reachCentre;
  const dx = state.feet[0] - cx;
  const dy = state.feet[1] - cy;
  const distance = Math.hypot(dx, dy);
  if (distance <= options.reach_m) return state;
  const back = options.reach_m / distance;
  return { ...state, feet: [cx + dx * back, cy + dy * back, state.feet[2]], blocked: true };
}
