/** Feet that stand stay where they are: legs reach for their spots while the body goes on or turns. */
import { type Bone, Matrix4, Quaternion, Vector3 } from "three";
import type { Ground } from "../core/course.ts";
import { type Footing, phaseOf } from "../core/footing.ts";
import { worldFromDrawn } from "../core/frames.ts";
import { reach } from "./leg-reach.ts";

/** From steps forward to steps on the spot, and back, in so long (s). */
const CHANGES_S = 0.25;
/** A foot whose spot is farther from where it would be than this share of its leg has lost it. */
const LOST = 0.8;

/** What the body does: the drawn frame under its middle, its spin (rad/s), whether it turns on the spot, its pace. */
export interface BodyMotion {
  readonly frame: Matrix4;
  readonly spin: number;
  readonly turning: boolean;
  readonly pace: number;
}

class Foot {
  readonly #footing: Footing;
  readonly #chain: readonly Bone[];
  readonly #end: Vector3;
  readonly #home: Vector3;
  readonly #long: number;
  #spot: Vector3 | null = null;
  /** From where it would be to where it stood last. */
  #left = new Vector3();

  /** rest: where the joints are in the model at rest. */
  constructor(footing: Footing, chain: readonly Bone[], rest: ReadonlyMap<Bone, Matrix4>) {
    this.#footing = footing;
    this.#chain = chain;
    this.#end = new Vector3(...footing.end);
    const places = chain.map((bone) => new Vector3().setFromMatrixPosition(rest.get(bone) ?? bone.matrix));
    const last = chain.at(-1);
    this.#home = last === undefined ? new Vector3() : this.#end.clone().applyMatrix4(rest.get(last) ?? last.matrix);
    this.#long = [...places.slice(1), this.#home].reduce((sum, place, i) => sum + place.distanceTo(places[i] ?? place), 0);
  }

  forget(): void {
    this.#spot = null;
    this.#left.set(0, 0, 0);
  }

  /** inModel_m: how high its end is in the clip itself, over level ground. */
  plant(time_s: number, clip_s: number, motion: BodyMotion, spinning: number, ground: Ground, inModel: (bone: Bone) => Matrix4): void {
    const last = this.#chain.at(-1);
    if (last === undefined) return;
    const phase = phaseOf(this.#footing, time_s, clip_s);
    const free = this.#end.clone().applyMatrix4(last.matrixWorld);
    const lift = Math.max(0, this.#end.clone().applyMatrix4(inModel(last)).y - this.#home.y);
    if (spinning > 0) free.lerp(this.#aroundMiddle(motion, phase.stand_s, lift), spinning);
    const level = this.#levelAt(free, ground);
    const wanted = phase.stands ? this.#standing(free, level) : this.#swinging(free, level, phase.done);
    this.#turn(wanted, last);
  }

  /** Where it stands while the body turns: under the body in the midst of its stand. */
  #aroundMiddle({ frame, spin, pace }: BodyMotion, stand_s: number, lift: number): Vector3 {
    const lead = (0.5 * spin * stand_s) / Math.max(pace, 0.1);
    return this.#home.clone().setY(this.#home.y + lift).applyAxisAngle(new Vector3(0, 1, 0), lead).applyMatrix4(frame);
  }

  /** The height of its end where it stands; null beside the ground. */
  #levelAt(place: Vector3, ground: Ground): number | null {
    const [x, y] = worldFromDrawn(place.toArray());
    const height = ground(x, y);
    return height === null ? null : height + this.#home.y;
  }

  #standing(free: Vector3, level: number | null): Vector3 {
    if (this.#spot !== null && this.#spot.distanceTo(free) > LOST * this.#long) this.#spot = null;
    this.#spot ??= level === null ? free : free.clone().setY(level);
    this.#left = this.#spot.clone().sub(free);
    return this.#spot;
  }

  #swinging(free: Vector3, level: number | null, done: number): Vector3 {
    this.#spot = null;
    const ease = done * done * (3 - 2 * done);
    const wanted = free.clone().addScaledVector(this.#left, 1 - ease);
    if (level !== null) wanted.y = Math.max(wanted.y, level);
    return wanted;
  }

  #turn(wanted: Vector3, last: Bone): void {
    const places = this.#chain.map((bone) => new Vector3().setFromMatrixPosition(bone.matrixWorld));
    places.push(this.#end.clone().applyMatrix4(last.matrixWorld));
    const turns = reach(places, wanted);
    let base = places[0] ?? wanted;
    for (const [i, bone] of this.#chain.entries()) {
      const turn = turns[i] ?? new Quaternion();
      const along = (places[i + 1] ?? wanted).clone().sub(places[i] ?? wanted).applyQuaternion(turn);
      bone.matrixWorld.setPosition(0, 0, 0).premultiply(new Matrix4().makeRotationFromQuaternion(turn)).setPosition(base);
      base = base.clone().add(along);
    }
  }
}

export class Footwork {
  readonly #feet: readonly (readonly Foot[])[];
  readonly #ground: Ground;
  #clip = -1;
  #spinning = 0;

  /** footings: of each clip. rest: the joints in the model at rest. */
  constructor(footings: readonly (readonly Footing[])[], bones: readonly Bone[], rest: ReadonlyMap<Bone, Matrix4>, ground: Ground) {
    const named = new Map(bones.map((bone) => [bone.name, bone]));
    this.#feet = footings.map((feet) =>
      feet.flatMap((footing) => {
        const chain = footing.leg.map((name) => named.get(name)).filter((bone) => bone !== undefined);
        return chain.length === footing.leg.length ? [new Foot(footing, chain, rest)] : [];
      }),
    );
    this.#ground = ground;
  }

  /** Turns the legs at a time of a clip, when the joints are where the body is. */
  plant(clip: number, time_s: number, clip_s: number, motion: BodyMotion, seconds: number, inModel: (bone: Bone) => Matrix4): void {
    const feet = this.#feet[clip] ?? [];
    if (clip !== this.#clip) for (const foot of feet) foot.forget();
    this.#clip = clip;
    const change = seconds / CHANGES_S;
    this.#spinning = Math.min(1, Math.max(0, this.#spinning + (motion.turning ? change : -change)));
    for (const foot of feet) foot.plant(time_s, clip_s, motion, this.#spinning, this.#ground, inModel);
  }

  /** Whether a clip has feet that stand. */
  has(clip: number): boolean {
    return (this.#feet[clip] ?? []).length > 0;
  }
}
