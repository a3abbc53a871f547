/** The camera in the walker's head. */
import { MathUtils, type PerspectiveCamera, Vector3 } from "three";
import { drawnFromWorld } from "../core/frames.ts";
import { directionOf, headingOf, turned } from "../core/heading.ts";
import { withElbowRoom } from "../core/elbow-room.ts";
import type { Box } from "../core/framing.ts";
import { add, subtract, type Vec3 } from "../core/vector.ts";
import {
  type Body,
  DEFAULT_WALK,
  eyeOf,
  INDOOR_BODY,
  isMoving,
  type Obstacles,
  standing,
  step,
  type Walker,
  type WalkOptions,
  type WalkWish,
} from "../core/walking.ts";
import type { Pose } from "./flight.ts";

const KEY_TURN_RAD_S = 1.6;
/** A slow machine walks as fast as a quick one; only a page that slept does not leap. */
const LONGEST_FRAME_S = 0.5;
const STEP_S = 0.1;
/** On a stair the eye rises evenly: the time constant with which it follows the body. */
const EYE_S = 0.09;
const EYE_REST_M = 0.002;
/** Whoever is put somewhere comes down onto the floor, which may lie a little higher than is said. */
const OFF_FLOOR_M = 0.08;
/** Further than from step to step the eye moves at once: a fall, a new start. */
const EYE_LAG_M = 0.4;
/** Vertical angle of view of a wide and of an upright picture. */
const FOV_WIDE_DEG = 60;
const FOV_UPRIGHT_DEG = 78;

export class WalkRig {
  options: WalkOptions;
  readonly #start: { readonly eye: Vec3; readonly target: Vec3 };
  readonly #obstacles: Obstacles;
  #walker: Walker;
  /** Nobody has gone anywhere yet. */
  #isFresh = true;
  /** How far the eye is behind the body, upwards. */
  #lag_m = 0;

  constructor(start: { readonly eye: Vec3; readonly target: Vec3 }, obstacles: Obstacles, bounds: Box, body: Body) {
    const across = subtract(bounds.max, bounds.min);
    this.options = {
      ...DEFAULT_WALK,
      body,
      reachCentre: [(bounds.min[0] + bounds.max[0]) / 2, (bounds.min[1] + bounds.max[1]) / 2],
      reach_m: Math.max(DEFAULT_WALK.reach_m, 0.5 * Math.hypot(across[0], across[1]) + 100),
    };
    this.#start = start;
    this.#obstacles = obstacles;
    this.#walker = this.#standingAtStart();
  }

  /** Who walks: narrower where there are doors. */
  set body(body: Body) {
    this.options = { ...this.options, body };
  }

  get walker(): Walker {
    return this.#walker;
  }

  /** Stands at the first of these places where nothing is in the way; false where none is free. */
  goTo(places: readonly Vec3[]): boolean {
    const free = places.find((feet) => this.#obstacles.pushOut(add(feet, [0, 0, OFF_FLOOR_M]), this.options.body) === null);
    if (free === undefined) return false;
    this.#isFresh = false;
    this.#walker = { ...this.#walker, feet: add(free, [0, 0, OFF_FLOOR_M]), velocity: [0, 0, 0], grounded: false };
    this.#lag_m = 0;
    return true;
  }

  restart(): void {
    this.#walker = this.#standingAtStart();
    const { feet } = this.#walker;
    // Within doors it is narrow anyway.
    const room = this.options.body === INDOOR_BODY ? feet : withElbowRoom(feet, this.#obstacles, this.options.body);
    this.#walker = { ...this.#walker, feet: room };
    this.#lag_m = 0;
  }

  /** Whoever walks for the first time: what stands at the start was not there when this was made. */
  begin(): void {
    if (this.#isFresh) this.restart();
    this.#isFresh = false;
  }

  #standingAtStart(): Walker {
    const heading = headingOf(subtract(this.#start.target, this.#start.eye));
    return standing(this.#start.eye, heading, this.options);
  }

  /** Stands where somebody with this eye looks. */
  place(eye: Vec3, direction: Vec3): void {
    this.#isFresh = false;
    this.#walker = standing(eye, headingOf(direction), this.options);
    this.#lag_m = 0;
  }

  turn(left_rad: number, up_rad: number): void {
    this.#walker = { ...this.#walker, heading: turned(this.#walker.heading, left_rad, up_rad) };
  }

  /** True while there is something to draw anew. */
  advance(wish: WalkWish, keys: { left: number; up: number }, frame_s: number): boolean {
    const seconds = Math.min(frame_s, LONGEST_FRAME_S);
    const turning = keys.left !== 0 || keys.up !== 0;
    if (turning) {
      this.turn(keys.left * KEY_TURN_RAD_S * seconds, 0.6 * keys.up * KEY_TURN_RAD_S * seconds);
    }
    const wishes = wish.forward !== 0 || wish.right !== 0;
    if (!wishes && !isMoving(this.#walker) && this.#lag_m === 0) return turning;
    const steps = Math.ceil(seconds / STEP_S);
    for (let i = 0; i < steps; i += 1) {
      const { feet, grounded } = this.#walker;
      this.#walker = step(this.#walker, wish, seconds / steps, this.#obstacles, this.options);
      const rise = grounded && this.#walker.grounded ? this.#walker.feet[2] - feet[2] : 0;
      const lag = (this.#lag_m - rise) * Math.exp(-seconds / steps / EYE_S);
      this.#lag_m = Math.abs(lag) < EYE_REST_M || Math.abs(lag) > EYE_LAG_M ? 0 : lag;
    }
    return true;
  }

  pose(camera: PerspectiveCamera): Pose {
    const eye = add(eyeOf(this.#walker, this.options.body), [0, 0, this.#lag_m]);
    const ahead = add(eye, directionOf(this.#walker.heading));
    const probe = camera.clone();
    probe.position.set(...drawnFromWorld(eye));
    probe.lookAt(new Vector3(...drawnFromWorld(ahead)));
    const fov = MathUtils.lerp(FOV_UPRIGHT_DEG, FOV_WIDE_DEG, MathUtils.clamp(camera.aspect - 0.5, 0, 1));
    return { position: probe.position, quaternion: probe.quaternion, fov, shift: [0, 0] };
  }
}
