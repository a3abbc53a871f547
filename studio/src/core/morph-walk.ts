/** A walk along key positions: what it is, where one is on it, and what has to be loaded there. */
import type { Walk as WalkRecord, WalkKey, WalkTransition } from "../generated/place.ts";
import type { Fault } from "./fault.ts";
import type { Matrix4 } from "./frames.ts";

/** A position on the way. Camera frame: x right, y down, z forward. */
export interface Station {
  readonly id: string;
  readonly picture: string;
  readonly width_px: number;
  readonly height_px: number;
  readonly focal_px: readonly [number, number];
  readonly centre_px: readonly [number, number];
  readonly worldFromCamera: Matrix4;
  /** What the picture lies on: a plane, or a cylinder about the camera's y. */
  readonly projection: "plane" | "cylinder";
}

/** How the view of one station becomes that of another, by their numbers. */
export interface Transition {
  readonly start: number;
  readonly end: number;
  readonly kind: "morph" | "fade" | "cut";
  readonly forth: string | null;
  readonly back: string | null;
  readonly score_db: number | null;
}

export interface MorphWalk {
  readonly id: string;
  readonly name: string;
  readonly speed_m_s: number;
  /** False: nobody knows the scale, and what counts as a metre is a step from frame to frame. */
  readonly inMetres: boolean;
  readonly stations: readonly Station[];
  readonly transitions: readonly Transition[];
  /** For each transition, how far its ends are from each other (m). */
  readonly lengths_m: readonly number[];
}

/** What is drawn: the morph, its triangles, or where it has counterparts. */
export type MorphLook = "picture" | "geometry" | "psi";

/** Where the person is on which of the walks; `at` counts transitions: 1.5 is in the middle of the second. */
export interface MorphState {
  readonly which: number;
  readonly at: number;
  readonly playing: boolean;
  readonly look: MorphLook;
  /** From station to station without anything between. */
  readonly instant: boolean;
}

export const NEXT_LOOK: Readonly<Record<MorphLook, MorphLook>> = { picture: "geometry", geometry: "psi", psi: "picture" };

const MOST_STATIONS = 20_000;
const MOST_TRANSITIONS = 100_000;
/** Half of what a flat screen shows of a cylinder at most (rad). */
const WIDEST = 0.9;
/** Shorter than this nobody walks: a cut, or a turn on the spot (m). */
const SHORTEST_M = 0.5;

type Fields<T> = { readonly [Key in keyof T]?: unknown };

export function readMorphWalk(
  value: unknown,
  which: string,
  broken: (fault: string) => Fault,
  isInside: (path: unknown) => path is string,
  inMetres: boolean,
): MorphWalk {
  const bad = (field: string): Fault => broken(`${which} has no proper "${field}"`);
  if (typeof value !== "object" || value === null) throw broken(`${which} is not a record`);
  const walk = value as Fields<WalkRecord>;
  const { id, name } = walk;
  if (typeof id !== "string") throw bad("id");
  if (typeof name !== "string") throw bad("name");
  const keys = listOf(walk.keys, MOST_STATIONS, () => bad("keys"));
  const ways = listOf(walk.transitions, MOST_TRANSITIONS, () => bad("transitions"));
  const stations = keys.map((key) => readStation(key, isInside, () => bad("keys")));
  if (stations.length === 0) throw bad("keys");
  const transitions = ways.map((way) => readTransition(way, stations.length, isInside, () => bad("transitions")));
  const { speed_m_s = 1.4 } = walk;
  if (typeof speed_m_s !== "number" || !(speed_m_s > 0)) throw bad("speed_m_s");
  return { id, name, speed_m_s, inMetres, stations, transitions, lengths_m: transitions.map((way) => apartOf(stations, way)) };
}

function apartOf(stations: readonly Station[], { start, end }: Transition): number {
  const [from, to] = [stations[start]?.worldFromCamera, stations[end]?.worldFromCamera];
  if (from === undefined || to === undefined) return SHORTEST_M;
  return Math.max(SHORTEST_M, Math.hypot(...[12, 13, 14].map((row) => (to[row] ?? 0) - (from[row] ?? 0))));
}

function readStation(value: unknown, isInside: (path: unknown) => path is string, bad: () => Fault): Station {
  if (typeof value !== "object" || value === null) throw bad();
  const { id, picture, width_px, height_px, focal_px, centre_px, transform, projection = "plane" } = value as Fields<WalkKey>;
  if (typeof id !== "string" || !isInside(picture)) throw bad();
  if (!isLength(width_px) || !isLength(height_px) || !isPair(focal_px) || !isPair(centre_px)) throw bad();
  if (Math.min(...focal_px) <= 0) throw bad();
  if (!Array.isArray(transform) || transform.length !== 16 || !transform.every((v) => Number.isFinite(v))) throw bad();
  if (projection !== "plane" && projection !== "cylinder") throw bad();
  return { id, picture, width_px, height_px, focal_px, centre_px, worldFromCamera: transform as number[], projection };
}

function readTransition(
  value: unknown,
  stations: number,
  isInside: (path: unknown) => path is string,
  bad: () => Fault,
): Transition {
  if (typeof value !== "object" || value === null) throw bad();
  const { start, end, kind, forth = null, back = null, score_db = null } = value as Fields<WalkTransition>;
  const isStation = (n: unknown): n is number => Number.isInteger(n) && (n as number) >= 0 && (n as number) < stations;
  if (!isStation(start) || !isStation(end)) throw bad();
  if (kind !== "morph" && kind !== "fade" && kind !== "cut") throw bad();
  const file = (path: unknown): string | null => {
    if (path !== null && !isInside(path)) throw bad();
    return path;
  };
  const models = { forth: file(forth), back: file(back) };
  if (kind === "morph" && (models.forth === null || models.back === null)) throw bad();
  return { start, end, kind, ...models, score_db: typeof score_db === "number" ? score_db : null };
}

function isLength(value: unknown): value is number {
  return Number.isInteger(value) && (value as number) > 0;
}

function isPair(value: unknown): value is [number, number] {
  return Array.isArray(value) && value.length === 2 && value.every((v) => Number.isFinite(v));
}

function listOf(value: unknown, most: number, bad: () => Fault): unknown[] {
  if (!Array.isArray(value) || value.length > most) throw bad();
  return value as unknown[];
}

/** How far one may look aside (rad) without seeing only what is beside the picture. */
export function reachOf({ width_px, focal_px, projection }: Station): number {
  const half = width_px / 2 / focal_px[0];
  return projection === "cylinder" ? half : Math.atan(half);
}

/** How high and wide a picture is seen that covers a canvas (rad): the height, of a shape `aspect`. */
export function heightToCover({ width_px, height_px, focal_px, projection }: Station, aspect: number): number {
  const high = 2 * Math.atan(height_px / 2 / focal_px[1]);
  const half = width_px / 2 / focal_px[0];
  const wide = projection === "cylinder" ? Math.tan(Math.min(half, WIDEST)) : half;
  return Math.min(high, 2 * Math.atan(wide / aspect));
}

/** The transition in which one is, and how far: 0 at its start, 1 at its end. */
export function placeOn(walk: MorphWalk, at: number): { transition: number; m: number } {
  const count = walk.transitions.length;
  if (count === 0) return { transition: 0, m: 0 };
  const inside = Math.min(Math.max(at, 0), count);
  const transition = Math.min(Math.floor(inside), count - 1);
  return { transition, m: inside - transition };
}

/** Just before the end of a transition, where the next one of the list begins elsewhere. */
const EDGE = 1e-6;
/** A way that goes on in the list is taken rather than another in nearly the same direction (rad). */
const ONWARD = 0.15;
/** A way that is cut is taken where there is no other. */
const CUT = 10;

/** The place of m (0..1) in a transition, as `placeOn` reads it. */
function atOf({ transitions }: MorphWalk, transition: number, m: number): number {
  const next = transitions[transition + 1];
  const joins = next === undefined || next.start === transitions[transition]?.end;
  return m < 1 || joins ? transition + m : transition + 1 - EDGE;
}

/** How far to the left of where a station looks another one is (rad). */
function leftOf(from: Station | undefined, to: Station | undefined): number {
  if (from === undefined || to === undefined) return 0;
  const [here, there] = [from.worldFromCamera, to.worldFromCamera];
  const along = (column: number): number =>
    [0, 1, 2].reduce((sum, row) => sum + (here[4 * column + row] ?? 0) * ((there[12 + row] ?? 0) - (here[12 + row] ?? 0)), 0);
  return Math.atan2(-along(0), along(2));
}

/** The transition that goes on from the end (or, backwards, the start) of another, where one looks; null: none. */
function onward({ stations, transitions }: MorphWalk, from: number, ahead: boolean, left: number): number | null {
  const way = transitions[from];
  const here = ahead ? way?.end : way?.start;
  let [best, least] = [null as number | null, Infinity];
  for (const [n, { start, end, kind }] of transitions.entries()) {
    if (n === from || (ahead ? start : end) !== here) continue;
    const aside = ahead ? Math.abs(leftOf(stations[start], stations[end]) - left) : 0;
    const cost = aside + (n === (ahead ? from + 1 : from - 1) ? 0 : ONWARD) + (kind === "cut" ? CUT : 0);
    if (cost < least) [best, least] = [n, cost];
  }
  return best;
}

/**
 * Where one is after walking so many metres on, backwards where they are negative. Where the path
 * branches one goes where one looks: so far to the left (rad). Where it ends one stops.
 */
export function walkedOn(walk: MorphWalk, at: number, metres: number, left = 0): number {
  let { transition, m } = placeOn(walk, at);
  const ahead = metres > 0;
  let rest = Math.abs(metres);
  while (rest > 1e-9) {
    const length = walk.lengths_m[transition];
    if (length === undefined) break;
    const step = Math.min(rest / length, ahead ? 1 - m : m);
    m += ahead ? step : -step;
    rest -= step * length;
    if (rest <= 1e-9) break;
    const next = onward(walk, transition, ahead, left);
    if (next === null) break;
    transition = next;
    m = ahead ? 0 : 1;
  }
  return atOf(walk, transition, m);
}

/** How far the way goes up to a place on it (m). */
export function metresTo(walk: MorphWalk, at: number): number {
  return walk.lengths_m.reduce((sum, length, n) => sum + length * Math.min(1, Math.max(0, at - n)), 0);
}

/** How far one has gone, and how long the way is, in words; in metres where anybody knows them. */
export function goneOf(walk: MorphWalk, at: number): string {
  const [gone, whole] = [at, walk.transitions.length].map((place) => metresTo(walk, place).toFixed(1));
  return walk.inMetres ? `${gone} m of ${whole} m` : `${gone} of ${whole} steps`;
}

/** How long the way is, in words. */
export function lengthOf(walk: MorphWalk): string {
  const whole = metresTo(walk, walk.transitions.length).toFixed(1);
  return walk.inMetres ? `${whole} m` : `${whole} steps (scale unknown)`;
}

/** Why it is not said in metres; nothing where it is. */
export const NO_SCALE = "The cameras' scale is not known: a step is that from frame to frame, by and large";

/** No more transitions are held, however many ways part here. */
const MOST_HELD = 5;

/** The transitions that have to be there: the one in which one is, those ahead and those behind. */
export function nearTransitions(walk: MorphWalk, at: number): number[] {
  const { transition } = placeOn(walk, at);
  const way = walk.transitions[transition];
  if (way === undefined) return [];
  const others = [...walk.transitions.keys()].filter((n) => n !== transition);
  const ahead = others.filter((n) => walk.transitions[n]?.start === way.end);
  const behind = others.filter((n) => walk.transitions[n]?.end === way.start);
  return [transition, ...ahead, ...behind].slice(0, MOST_HELD);
}

/** Without what lies between: the station that is nearer. */
export function nearestStation(walk: MorphWalk, at: number): number {
  const { transition, m } = placeOn(walk, at);
  return atOf(walk, transition, Math.round(m));
}
