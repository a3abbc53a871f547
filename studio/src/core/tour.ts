/** A guided tour: the eye goes from key to key on straight lines, and turns at an even pace. */
import type { Tour as TourRecord, TourStretch } from "../generated/place.ts";
import type { Fault } from "./fault.ts";
import { add, dot, length, scale, subtract, type Vec3 } from "./vector.ts";

export interface Stretch {
  /** Id of the room in the part's document; null outside. */
  readonly room: string | null;
  readonly name: string;
  readonly start_s: number;
  readonly end_s: number;
}

export interface Tour {
  readonly id: string;
  readonly name: string;
  /** Ascending from 0. */
  readonly times_s: readonly number[];
  /** World frame, one for each time. */
  readonly eyes: readonly Vec3[];
  /** Unit vectors, one for each time. */
  readonly directions: readonly Vec3[];
  readonly stretches: readonly Stretch[];
  /** Ids of the doors that stay closed while it plays: open, their leaves would bar its way. */
  readonly shut: ReadonlySet<string>;
}

/** Where the person is in which of the tours. */
export interface TourState {
  /** Its number in the place. */
  readonly which: number;
  readonly time_s: number;
  readonly playing: boolean;
}

/** Before a tour was begun. */
export const NOT_BEGUN: TourState = { which: 0, time_s: 0, playing: false };

export interface TourView {
  readonly eye: Vec3;
  readonly direction: Vec3;
}

/** More keys than anybody would sit through; a larger number is a broken or hostile file. */
const MOST_KEYS = 100_000;
const MOST_STRETCHES = 10_000;
const MOST_SHUT = 10_000;
/** How far a direction's length may be from 1. */
const TOLERANCE = 1e-2;
/** Nearer to each other than this two directions are mixed straight. */
const ALIKE = 1e-6;

type Fields<T> = { readonly [Key in keyof T]?: unknown };

export function readTour(value: unknown, which: string, broken: (fault: string) => Fault): Tour {
  const bad = (field: string): Fault => broken(`${which} has no proper "${field}"`);
  if (typeof value !== "object" || value === null) throw broken(`${which} is not a record`);
  const tour = value as Fields<TourRecord>;
  const { id, name } = tour;
  if (typeof id !== "string") throw bad("id");
  if (typeof name !== "string") throw bad("name");
  const times = column(tour.times_s, isNumber, () => bad("times_s"));
  const eyes = column(tour.eyes, isPoint, () => bad("eyes"));
  const directions = column(tour.directions, isPoint, () => bad("directions"));
  const ascends = times[0] === 0 && times.every((time, i) => i === 0 || time > (times[i - 1] ?? time));
  if (times.length < 2 || !ascends) throw bad("times_s");
  if (eyes.length !== times.length) throw bad("eyes");
  const isUnit = (direction: Vec3): boolean => Math.abs(length(direction) - 1) < TOLERANCE;
  if (directions.length !== times.length || !directions.every(isUnit)) throw bad("directions");
  const stretches = tour.stretches ?? [];
  if (!Array.isArray(stretches) || stretches.length > MOST_STRETCHES) throw bad("stretches");
  const shut: unknown = tour.shut ?? [];
  if (!Array.isArray(shut) || shut.length > MOST_SHUT || !shut.every((door) => typeof door === "string")) throw bad("shut");
  return {
    id,
    name,
    times_s: times,
    eyes,
    directions,
    stretches: stretches.map((stretch) => readStretch(stretch, () => bad("stretches"))),
    shut: new Set(shut),
  };
}

export function durationOf(tour: Tour): number {
  return tour.times_s[tour.times_s.length - 1] ?? 0;
}

/** What one sees at a time of the tour; before and after it, its first and last view. */
export function viewAt(tour: Tour, time_s: number): TourView {
  const { times_s: times, eyes, directions } = tour;
  const after = firstAfter(times, time_s);
  const before = Math.max(0, after - 1);
  const last = Math.min(after, times.length - 1);
  const [from, to] = [times[before] ?? 0, times[last] ?? 0];
  const share = to > from ? Math.min(1, Math.max(0, (time_s - from) / (to - from))) : 0;
  const [eye, nextEye] = [eyes[before], eyes[last]];
  const [direction, nextDirection] = [directions[before], directions[last]];
  if (eye === undefined || nextEye === undefined || direction === undefined || nextDirection === undefined) {
    throw new RangeError("a tour without keys");
  }
  return {
    eye: add(eye, scale(subtract(nextEye, eye), share)),
    direction: turnedTo(direction, nextDirection, share),
  };
}

/** The room that is passed at a time; null where the tour does not say it. */
export function stretchAt(tour: Tour, time_s: number): Stretch | null {
  return tour.stretches.find(({ start_s, end_s }) => time_s >= start_s && time_s < end_s) ?? tour.stretches.at(-1) ?? null;
}

/** The number of the first time later than this one. */
function firstAfter(times: readonly number[], time_s: number): number {
  let [low, high] = [0, times.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((times[middle] ?? 0) > time_s) high = middle;
    else low = middle + 1;
  }
  return low;
}

/** On the great circle between two unit vectors. */
function turnedTo(from: Vec3, to: Vec3, share: number): Vec3 {
  const angle = Math.acos(Math.min(1, Math.max(-1, dot(from, to))));
  const size = Math.sin(angle);
  if (size < ALIKE) return share < 0.5 ? from : to;
  return add(scale(from, Math.sin((1 - share) * angle) / size), scale(to, Math.sin(share * angle) / size));
}

function readStretch(value: unknown, bad: () => Fault): Stretch {
  if (typeof value !== "object" || value === null) throw bad();
  const { room = null, name, start_s, end_s } = value as Fields<TourStretch>;
  if (room !== null && typeof room !== "string") throw bad();
  if (typeof name !== "string" || !isNumber(start_s) || !isNumber(end_s)) throw bad();
  return { room, name, start_s, end_s };
}

function column<T>(value: unknown, isItem: (item: unknown) => item is T, bad: () => Fault): T[] {
  if (!Array.isArray(value) || value.length > MOST_KEYS || !value.every(isItem)) throw bad();
  return value;
}

function isNumber(value: unknown): value is number {
  return Number.isFinite(value);
}

function isPoint(value: unknown): value is Vec3 {
  return Array.isArray(value) && value.length === 3 && value.every(isNumber);
}
