/** The camera keeps to the animal that it follows, as far from it as the person wants. */
import { Vector3 } from "three";
import { drawnFromWorld } from "../core/frames.ts";
import type { StudioState } from "../core/state.ts";
import type { Animals } from "./animals.ts";
import type { OrbitRig } from "./orbit-rig.ts";

/** From how many body lengths an animal is followed. */
const FOLLOW_LENGTHS = 4;

/** Who looks at it from within so many already stays as far away. */
const NEAR_LENGTHS = 25;

export class Follower {
  readonly #orbit: OrbitRig;
  readonly #animals: Animals;
  /** Where the animal was; null where none is followed. */
  #before: Vector3 | null = null;

  constructor(orbit: OrbitRig, animals: Animals) {
    this.#orbit = orbit;
    this.#animals = animals;
  }

  follow({ animal, mode }: StudioState): void {
    const at = animal.following && mode === "orbit" ? this.#animals.placeOf(animal.which) : null;
    const before = this.#before;
    this.#before = at === null ? null : new Vector3(...drawnFromWorld(at));
    if (this.#before === null) return;
    const length_m = this.#animals.lengthOf(animal.which);
    const isBeside = this.#orbit.target.distanceTo(this.#before) < length_m && this.#orbit.arm_m < NEAR_LENGTHS * length_m;
    if (before === null && isBeside) return;
    this.#orbit.shift(this.#before.clone().sub(before ?? this.#orbit.target));
    if (before === null) this.#orbit.approach(FOLLOW_LENGTHS * length_m);
  }
}
