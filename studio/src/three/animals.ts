/**
 * The animals of a place, alive. A clip moves a skeleton straight along +x; here each of its joints is
 * carried over to the curve that the animal goes along: arc length for the way ahead, the curve's normal
 * for what is beside it. So the whole body bends where the path does.
 */
import { type AnimationAction, AnimationMixer, type Bone, LoopOnce, LoopRepeat, Matrix4, Mesh, Quaternion, SkinnedMesh, Vector3 } from "three";
import type { Animal, AnimalState } from "../core/animal.ts";
import { Course, type Ground } from "../core/course.ts";
import { type Free, type Spot, wayRound } from "../core/detour.ts";
import { readFootings } from "../core/footing.ts";
import { type Goer, waits } from "../core/giving-way.ts";
import { drawnFromWorld, worldFromDrawn } from "../core/frames.ts";
import type { Vec3 } from "../core/vector.ts";
import type { Obstacles } from "../core/walking.ts";
import { Footwork } from "./footwork.ts";
import type { LoadedPart } from "./load.ts";
import type { PartSlot } from "./part-slot.ts";

/** Nobody waits longer for a frame than so (s). */
const MOST_SECONDS = 0.1;
/** What has legs moves them wholly from this pace on; below, it stands more and more as at rest. */
const WHOLE_PACE = 0.35;

/** Half of how wide a way is to be, in lengths, the best first: what has no legs swings out in corners. */
const LEGGED: readonly number[] = [0.16, 0.08];
const SLENDER: readonly number[] = [0.35, 0.08, 0.04];
/** How closely it looks for a way. */
const CELL_LENGTHS = 0.25;

/** A joint against its parent. */
interface Rest {
  readonly place: Vector3;
  readonly turn: Quaternion;
}

class LivingAnimal {
  readonly animal: Animal;
  readonly course: Course;
  readonly #ground: Ground;
  readonly #mixer: AnimationMixer;
  readonly #bones: readonly Bone[];
  readonly #root: Bone | null;
  readonly #inModel = new Map<Bone, Matrix4>();
  readonly #rest: ReadonlyMap<Bone, Rest>;
  readonly #footwork: Footwork | null;
  readonly #actions: readonly (AnimationAction | null)[];
  #clip = -1;
  #time_s = 0;

  constructor(animal: Animal, { group, animations }: LoadedPart, ground: Ground) {
    this.animal = animal;
    this.course = new Course(animal, ground);
    this.#ground = ground;
    // The joints say where the body is in the place; its own place would move it twice.
    group.matrix.identity();
    group.updateMatrixWorld(true);
    const bones = new Set<Bone>();
    group.traverse((node) => {
      if (!(node instanceof Mesh)) return;
      node.frustumCulled = false;
      if (node instanceof SkinnedMesh) for (const bone of (node as SkinnedMesh).skeleton.bones) bones.add(bone);
    });
    // Parents first, as a skeleton lists them.
    this.#bones = [...bones];
    for (const bone of this.#bones) bone.matrixWorldAutoUpdate = false;
    this.#root = this.#bones.find(({ name }) => name === animal.root) ?? null;
    this.#rest = new Map(this.#bones.map((bone) => [bone, { place: bone.position.clone(), turn: bone.quaternion.clone() }]));
    this.#compose(0);
    const told = animal.clips.map(({ name }) => readFootings(animations.find((one) => one.name === name)?.userData));
    const atRest = new Map([...this.#inModel].map(([bone, matrix]) => [bone, matrix.clone()]));
    this.#footwork = animal.turns === null ? null : new Footwork(told, this.#bones, atRest, ground);
    this.#mixer = new AnimationMixer(group);
    this.#actions = animal.clips.map(({ name }) => {
      const clip = animations.find((one) => one.name === name);
      return clip === undefined ? null : this.#mixer.clipAction(clip);
    });
    this.#play(0);
    this.#pose(0);
  }

  /** World frame. */
  get place(): Vec3 {
    return this.course.at(0).point;
  }

  /** Where it is, and where it goes. */
  get goer(): Goer {
    const { point, ahead } = this.course.at(0);
    return { place: point, ahead, length_m: this.animal.length_m, standing: this.course.standing };
  }

  /** True while it moves. */
  advance(wants: boolean, clip: number, seconds: number): boolean {
    if (clip !== this.#clip) this.#play(clip);
    const { seconds: duration = 1, stride_m = 0 } = this.animal.clips[this.#clip] ?? {};
    const share = this.course.advance(stride_m / duration, wants, seconds);
    if (share <= 0) return false;
    this.#time_s = (this.#time_s + share * seconds) % duration;
    this.#pose(seconds);
    return true;
  }

  #play(clip: number): void {
    this.#mixer.stopAllAction();
    this.#clip = clip;
    this.#time_s = 0;
    const action = this.#actions[clip];
    action?.reset().setLoop(this.animal.clips[clip]?.loops === true ? LoopRepeat : LoopOnce, Infinity).play();
  }

  /** Where each joint is in the model: in the clip by a share, else at rest. Returns how far the root is. */
  #compose(share: number): number {
    const [place, turn, scale] = [new Vector3(), new Quaternion(), new Vector3(1, 1, 1)];
    for (const bone of this.#bones) {
      const rest = this.#rest.get(bone);
      place.copy(bone.position);
      turn.copy(bone.quaternion);
      if (rest !== undefined && share < 1) {
        place.lerpVectors(rest.place, bone.position, share);
        turn.slerpQuaternions(rest.turn, bone.quaternion, share);
      }
      const own = (this.#inModel.get(bone) ?? new Matrix4()).compose(place, turn, scale);
      const above = this.#inModel.get(bone.parent as Bone);
      if (above !== undefined) own.premultiply(above);
      this.#inModel.set(bone, own);
    }
    const root = this.#root === null ? undefined : this.#inModel.get(this.#root);
    return root?.elements[12] ?? 0;
  }

  /** Where the clip has each joint, straight ahead; then bent along the course, its feet on the ground. */
  #pose(seconds: number): void {
    this.#mixer.setTime(this.#time_s);
    const at = new Vector3();
    const { pace } = this.course;
    const start = this.#compose(this.#footwork === null ? 1 : smooth(Math.min(1, pace / WHOLE_PACE)));
    for (const bone of this.#bones) {
      const own = this.#inModel.get(bone);
      if (own === undefined) continue;
      const ahead = at.setFromMatrixPosition(own).x - start;
      const straight = own.clone().setPosition(0, at.y, at.z);
      bone.matrixWorld.multiplyMatrices(this.#frameAt(ahead), straight);
    }
    if (!this.animal.swims) this.#lay();
    const { seconds: duration = 1 } = this.animal.clips[this.#clip] ?? {};
    const motion = { frame: this.#frameAt(0), spin: this.course.spin, turning: this.course.isTurning, pace };
    const inModel = (bone: Bone): Matrix4 => this.#inModel.get(bone) ?? bone.matrix;
    this.#footwork?.plant(this.#clip, this.#time_s, duration, motion, seconds, inModel);
  }

  /** A body lies on the ground beside its path, too: each joint is as high over it as over the path. */
  #lay(): void {
    const at = new Vector3();
    const lifts = this.#bones.map((bone) => {
      const [x, y, z] = worldFromDrawn(at.setFromMatrixPosition(bone.matrixWorld).toArray());
      const own = this.#inModel.get(bone);
      const ground = this.#ground(x, y);
      return ground === null || own === undefined ? 0 : ground + at.setFromMatrixPosition(own).y - z;
    });
    for (const [i, bone] of this.#bones.entries()) {
      // A joint lies as its neighbours do: bones are stiff, and the ground's grain is not felt.
      const around = [lifts[i - 1] ?? lifts[i] ?? 0, lifts[i] ?? 0, lifts[i + 1] ?? lifts[i] ?? 0];
      const lift = (around.reduce((sum, one) => sum + one, 0)) / around.length;
      if (Math.abs(lift) < 2 * this.animal.length_m) bone.matrixWorld.elements[13] += lift;
    }
  }

  /** The drawn frame of the course, so many metres ahead of the middle: x along it, y up from the ground. */
  #frameAt(ahead_m: number): Matrix4 {
    const { point, ahead } = this.course.at(ahead_m);
    const x = new Vector3(...drawnFromWorld(ahead)).normalize();
    const z = new Vector3().crossVectors(x, new Vector3(0, 1, 0)).normalize();
    const y = new Vector3().crossVectors(z, x);
    return new Matrix4().makeBasis(x, y, z).setPosition(...drawnFromWorld(point));
  }
}

export class Animals {
  readonly #animals: readonly Animal[];
  readonly #parts: readonly PartSlot[];
  readonly #ground: Ground;
  readonly #obstacles: Obstacles;
  /** By their numbers in the place; null while the model is on its way. */
  readonly #all: (LivingAnimal | null)[];

  constructor(animals: readonly Animal[], parts: readonly PartSlot[], ground: Ground, obstacles: Obstacles) {
    this.#animals = animals;
    this.#parts = parts;
    this.#ground = ground;
    this.#obstacles = obstacles;
    this.#all = animals.map(() => null);
    for (const [index, { isThere }] of parts.entries()) if (isThere) this.take(index);
  }

  /** The model of a part has come: those that are of it live. */
  take(part: number): void {
    const slot = this.#parts[part];
    for (const [index, animal] of this.#animals.entries()) {
      if (animal.part === part && slot !== undefined) this.#all[index] = new LivingAnimal(animal, slot, this.#ground);
    }
  }

  get count(): number {
    return this.#living.length;
  }

  get #living(): LivingAnimal[] {
    return this.#all.filter((one) => one !== null);
  }

  /** Where each is (world frame), and how far it is on its pace (0..1). */
  get states(): { readonly id: string; readonly place: Vec3; readonly pace: number }[] {
    return this.#living.map(({ animal, place, course }) => ({ id: animal.id, place, pace: course.pace }));
  }

  /** Where one is and goes; null while its model is on its way. */
  goerOf(which: number): Goer | null {
    return this.#all[which]?.goer ?? null;
  }

  placeOf(which: number): Vec3 | null {
    return this.#all[which]?.place ?? null;
  }

  lengthOf(which: number): number {
    return this.#all[which]?.animal.length_m ?? 1;
  }

  /** Sends one to a point of the ground, round what stands in its way; false where nothing leads there. */
  lead(which: number, target: Vec3): boolean {
    const one = this.#all[which];
    if (one === null || one === undefined) return false;
    const { animal, course, place } = one;
    const height = (x: number, y: number): number => this.#ground(x, y) ?? place[2];
    const cell = CELL_LENGTHS * animal.length_m;
    let way: Spot[] | null = null;
    for (const wide of animal.turns === null ? SLENDER : LEGGED) {
      const isFree = freeFor(animal, wide, height, this.#obstacles);
      way ??= wayRound([place[0], place[1]], [target[0], target[1]], isFree, cell);
    }
    if (way === null) return false;
    const corners = way.slice(0, -1).map(([x, y]): Vec3 => [x, y, height(x, y)]);
    course.leadTo(target, corners);
    return true;
  }

  /** True while one moves. */
  advance(state: AnimalState, seconds: number): boolean {
    const passed = Math.min(seconds, MOST_SECONDS);
    const goers = this.#all.map((one) => one?.goer ?? null);
    const moves = this.#all.map((one, index) => {
      const wants = state.playing && !waits(index, goers);
      return one?.advance(wants, index === state.which ? state.clip : 0, passed) ?? false;
    });
    return moves.includes(true) || (state.playing && this.#living.some(({ course }) => course.pace > 0));
  }
}

/** Where an animal's body has room, from its knee up; the ground itself is not in its way. */
function freeFor(animal: Animal, wide: number, height: (x: number, y: number) => number, obstacles: Obstacles): Free {
  const radius_m = wide * animal.length_m;
  const knee_m = (animal.turns === null ? 0.05 : 0.2) * animal.length_m;
  const body = { radius_m, height_m: 2.5 * radius_m, eye_m: 0 };
  return (x, y) => obstacles.pushOut([x, y, height(x, y) + knee_m], body) === null;
}

function smooth(share: number): number {
  return share * share * (3 - 2 * share);
}
