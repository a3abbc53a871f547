/** The animals of a place: parts that go along paths. Nothing that the manifest says is taken on trust. */
import type { PlaceAnimal } from "../generated/place.ts";
import type { Fault } from "./fault.ts";
import type { Vec3 } from "./vector.ts";

export interface AnimalClip {
  readonly name: string;
  readonly seconds: number;
  /** How far it goes in the clip (m). */
  readonly stride_m: number;
  readonly loops: boolean;
}

export interface Animal {
  readonly id: string;
  readonly name: string;
  /** The number of its part in the place. */
  readonly part: number;
  readonly root: string;
  readonly length_m: number;
  readonly swims: boolean;
  readonly clips: readonly AnimalClip[];
  readonly path: readonly Vec3[];
  readonly closed: boolean;
  /** Points of the path at which it turns on the spot, in order; null: it goes in curves alone. */
  readonly turns: readonly number[] | null;
}

/** What the person does with the animals. */
export interface AnimalState {
  readonly which: number;
  readonly clip: number;
  readonly playing: boolean;
  /** Whether the camera goes with it. */
  readonly following: boolean;
  /** Whether a click says where it goes. */
  readonly leading: boolean;
}

export const STANDING: AnimalState = { which: 0, clip: 0, playing: true, following: false, leading: false };

const MOST_POINTS = 100_000;
const MOST_CLIPS = 100;

type Fields<T> = { readonly [Key in keyof T]?: unknown };

export function readAnimal(
  value: unknown,
  which: string,
  parts: readonly { readonly id: string }[],
  broken: (fault: string) => Fault,
): Animal {
  const bad = (field: string): Fault => broken(`${which} has no proper "${field}"`);
  if (typeof value !== "object" || value === null) throw broken(`${which} is not a record`);
  const animal = value as Fields<PlaceAnimal>;
  const { id, name, root = "root", length, clips, path, turns = null } = animal;
  if (typeof id !== "string") throw bad("id");
  if (typeof name !== "string") throw bad("name");
  if (typeof root !== "string") throw bad("root");
  if (!isPositive(length)) throw bad("length");
  const part = parts.findIndex((one) => one.id === animal.part);
  if (part < 0) throw bad("part");
  if (!Array.isArray(clips) || clips.length === 0 || clips.length > MOST_CLIPS) throw bad("clips");
  const isPath = Array.isArray(path) && path.length >= 2 && path.length <= MOST_POINTS && path.every(isPoint);
  if (!isPath) throw bad("path");
  if (turns !== null && !isInOrder(turns, path.length)) throw bad("turns");
  return {
    id,
    name,
    part,
    root,
    length_m: length,
    swims: animal.swims === true,
    clips: clips.map((clip) => readClip(clip, () => bad("clips"))),
    path,
    closed: animal.closed === true,
    turns: animal.closed === true && turns !== null ? [] : turns,
  };
}

function readClip(value: unknown, bad: () => Fault): AnimalClip {
  if (typeof value !== "object" || value === null) throw bad();
  const { name, seconds, stride, loops } = value as Fields<PlaceAnimal["clips"][number]>;
  if (typeof name !== "string" || !isPositive(seconds) || typeof stride !== "number" || !Number.isFinite(stride)) throw bad();
  return { name, seconds, stride_m: stride, loops: loops === true };
}

function isPositive(value: unknown): value is number {
  return typeof value === "number" && Number.isFinite(value) && value > 0;
}

function isPoint(value: unknown): value is Vec3 {
  return Array.isArray(value) && value.length === 3 && value.every((v) => Number.isFinite(v));
}

/** Whether these are numbers of inner points of a path, each once, in their order. */
function isInOrder(value: unknown, count: number): value is number[] {
  return Array.isArray(value) && value.every((one, i: number) => Number.isInteger(one) && one > (i > 0 ? value[i - 1] : 0) && one < count - 1);
}
