/** Keys, joystick and the guide: where they take the person on foot and from outside. */
import type { PerspectiveCamera } from "three";
import { type Hold, turnOf, wishOf } from "../core/input.ts";
import type { StudioState } from "../core/state.ts";
import type { Store } from "../core/store.ts";
import type { WalkWish } from "../core/walking.ts";
import { setPose } from "./flight.ts";
import type { OrbitRig } from "./orbit-rig.ts";
import type { TourGuide } from "./tour-guide.ts";
import type { WalkRig } from "./walk-rig.ts";

/** What moves the camera. */
export interface Rigs {
  readonly camera: PerspectiveCamera;
  readonly walk: WalkRig;
  readonly orbit: OrbitRig;
  readonly guide: TourGuide | null;
}

export class Steering {
  readonly #rigs: Rigs;
  readonly #store: Store<StudioState>;
  readonly #held = new Set<Hold>();
  #stick: readonly [number, number] = [0, 0];

  constructor(rigs: Rigs, store: Store<StudioState>) {
    this.#rigs = rigs;
    this.#store = store;
  }

  /** Whether the key is held otherwise than before. */
  hold(key: Hold, down: boolean): boolean {
    const before = this.#held.has(key);
    if (down) this.#held.add(key);
    else this.#held.delete(key);
    return before !== down;
  }

  release(): void {
    this.#held.clear();
  }

  /** x right, y forward, -1..1. */
  setStick(x: number, y: number): void {
    this.#stick = [x, y];
  }

  get wish(): WalkWish {
    return wishOf(this.#held, this.#stick);
  }

  get turn(): { left: number; up: number } {
    return turnOf(this.#held);
  }

  /** True while the camera moves. */
  advance(seconds: number): boolean {
    const { turn, wish } = this;
    const { shot, mode } = this.#store.value;
    if (shot !== null) return false;
    const steers = turn.left !== 0 || turn.up !== 0 || wish.forward !== 0 || wish.right !== 0;
    if (mode === "walk") return this.#walk(seconds, steers);
    const { orbit } = this.#rigs;
    if (steers) orbit.steer(turn.left - wish.right, turn.up, wish.forward, Math.min(seconds, 0.1));
    return orbit.advance() || steers;
  }

  /** With the guide, until one goes one's own way. */
  #walk(seconds: number, steers: boolean): boolean {
    const { camera, walk, guide } = this.#rigs;
    let moves = true;
    if (guide?.isPlaying === true && !steers) {
      const { eye, direction } = guide.advance(seconds);
      walk.place(eye, direction);
    } else {
      guide?.stop();
      moves = walk.advance(this.wish, this.turn, seconds);
    }
    setPose(camera, walk.pose(camera));
    return moves;
  }
}
