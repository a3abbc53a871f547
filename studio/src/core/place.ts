/** Reads `place.json`. It may come from anywhere, so nothing in it is taken on trust. */
import type { Place as Manifest, PlaceCamera, PlacePart, PlacePoints, PlaceSun } from "../generated/place.ts";
import { type Animal, readAnimal } from "./animal.ts";
import { Fault } from "./fault.ts";
import { worldPoint } from "./frames.ts";
import { type Box, cornersOf } from "./framing.ts";
import type { Layer } from "./state.ts";
import { type MorphWalk, readMorphWalk } from "./morph-walk.ts";
import { readTour, type Tour } from "./tour.ts";
import type { Vec3 } from "./vector.ts";

export interface Part {
  readonly id: string;
  readonly name: string;
  /** Addresses relative to `place.json`. */
  readonly model: string;
  readonly photo: string | null;
  /** A model of the same as it was recorded. */
  readonly raw: string | null;
  /** What it was built from. */
  readonly document: string | null;
  readonly worldFromPart: readonly number[];
  readonly arrangement: PlacePart["arrangement"];
  /** The part's own frame; null where the manifest does not say it. */
  readonly bounds: Box | null;
  /** Around nearly all of it, where a little of it lies far off: what one looks at. */
  readonly core: Box | null;
  /** The ground between the others: one walks on it, and it is not what one comes to see. */
  readonly isGround: boolean;
  /** With what it is shown and hidden; null for the ground, which is with its class alone. */
  readonly layer: Layer | null;
  /** A picture around the others: nobody bumps into it, and it is not what one comes to see. */
  readonly isBackdrop: boolean;
}

/** The part that stands by itself, as a house does in its garden; null where several stand together. */
export function standsAlone(parts: readonly Pick<Part, "name" | "arrangement">[]): { readonly name: string } | null {
  const single = parts.filter(({ arrangement }) => arrangement === "single");
  return single.length === 1 ? (single[0] ?? null) : null;
}

/** Where a place is on the earth, and the day on which it is looked at. */
export interface SunDay {
  readonly latitude_deg: number;
  readonly longitude_deg: number;
  /** When the day begins by the clock of `zone`, in milliseconds as `Date` counts them. */
  readonly midnight_ms: number;
  /** When it is looked at; 0 to 24. */
  readonly hour: number;
  /** As 2026-06-21 and UTC+01:00. */
  readonly date: string;
  readonly zone: string;
  readonly timeKnown: boolean;
}

/** A cloud of points. */
export interface Cloud {
  /** PLY, relative to `place.json`. */
  readonly file: string;
  /** Distances are other points again, in colours that show how far they lie from a model. */
  readonly layer: "points" | "distances";
  readonly worldFromPoints: readonly number[];
  /** How many points the file has; null where the place does not say. */
  readonly count: number | null;
  /** Around nearly all of the points, in their own frame. */
  readonly bounds: Box;
}

/** A photo in the place where it was taken; an ideal camera, for `picture` has no distortion. */
export interface Shot {
  readonly id: string;
  readonly name: string;
  readonly picture: string;
  readonly width_px: number;
  readonly height_px: number;
  readonly focal_px: readonly [number, number];
  readonly centre_px: readonly [number, number];
  /** Camera frame: x right, y down, z forward. */
  readonly worldFromCamera: readonly number[];
}

/** What its maker says of a place, in words; empty where nothing is said. */
export interface About {
  readonly title: string;
  readonly description: string;
  readonly author: string;
  readonly licence: string;
}

const HIDEABLE = ["points", "cameras", "photos"] as const;
export type Hideable = (typeof HIDEABLE)[number];

export interface Place {
  readonly about: About;
  readonly parts: readonly Part[];
  readonly clouds: readonly Cloud[];
  readonly shots: readonly Shot[];
  readonly tours: readonly Tour[];
  readonly animals: readonly Animal[];
  readonly walks: readonly MorphWalk[];
  /** Whether lengths are metres. */
  readonly scaleKnown: boolean;
  /** 3D Tiles of the whole place, relative to `place.json`: they are shown instead of the parts. */
  readonly tileset: string | null;
  /** What is not shown until a visitor asks for it; `photos`: that they fade in. */
  readonly hidden: ReadonlySet<Hideable>;
  /** What is known of its sun; `day` is null where nobody knows where it is. */
  readonly sun: { readonly northKnown: boolean; readonly day: SunDay | null } | null;
  readonly start: { readonly eye: Vec3; readonly target: Vec3 };
}

/** More parts than a browser could show; a larger number is a broken or hostile file. */
const MOST_PARTS = 10_000;
const MOST_CLOUDS = 1000;
const MOST_SHOTS = 100_000;
const MOST_TOURS = 100;
const MOST_ANIMALS = 1000;
const MOST_WALKS = 100;
const MOST_WORDS = 10_000;
/** The part that holds the walls which `veduta photos` found in the points. */
const WALLS = "walls";
const IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
const REMEDY = "Write the place again, for example with `veduta facade`.";

export function readPlace(text: string, file: string): Place {
  const broken = (fault: string): Fault => new Fault(file, fault, REMEDY);
  const manifest = record(parse(text, broken), () => broken("it does not hold a place"));
  if (manifest.schema !== "veduta/place") throw broken("it is not a Veduta place");
  if (manifest.version !== 1) {
    throw new Fault(
      file,
      `its version is ${String(manifest.version)}, and this studio reads version 1`,
      "Use the studio of the Veduta that wrote the place.",
    );
  }
  const parts = list(manifest.parts, MOST_PARTS, "parts", broken);
  const clouds = list(manifest.points ?? [], MOST_CLOUDS, "clouds of points", broken);
  const shots = list(manifest.cameras ?? [], MOST_SHOTS, "cameras", broken);
  const tours = list(manifest.tours ?? [], MOST_TOURS, "tours", broken);
  const animals = list(manifest.animals ?? [], MOST_ANIMALS, "animals", broken);
  const walks = list(manifest.walks ?? [], MOST_WALKS, "walks", broken);
  if (parts.length + clouds.length === 0) throw broken("the place has no parts");
  const start = record(manifest.start, () => broken("it does not say where to start"));
  const known = parts.map((part, index) => readPart(part, `part ${index + 1}`, broken));
  const words = (field: keyof About): string => {
    const said: unknown = manifest[field];
    return typeof said === "string" ? said.slice(0, MOST_WORDS) : "";
  };
  return {
    about: { title: words("title"), description: words("description"), author: words("author"), licence: words("licence") },
    tileset: readTileset(manifest.tileset, broken),
    parts: known,
    clouds: clouds.map((cloud, index) => readCloud(cloud, `cloud ${index + 1}`, broken)),
    shots: shots.map((shot, index) => readShot(shot, `camera ${index + 1}`, broken)),
    tours: tours.map((tour, index) => readTour(tour, `tour ${index + 1}`, broken)),
    animals: animals.map((animal, index) => readAnimal(animal, `animal ${index + 1}`, known, broken)),
    walks: walks.map((walk, index) => readMorphWalk(walk, `walk ${index + 1}`, broken, isInside, manifest.scale !== "unknown")),
    scaleKnown: manifest.scale !== "unknown",
    hidden: readHidden(manifest.hidden),
    sun: readSun(manifest.sun, broken),
    start: {
      eye: readVec3(start.eye, () => broken('"start.eye" is not a point')),
      target: readVec3(start.target, () => broken('"start.target" is not a point')),
    },
  };
}

/** Words that a later Veduta may add are passed over. */
function readHidden(value: unknown): Place["hidden"] {
  return new Set(HIDEABLE.filter((one) => Array.isArray(value) && value.includes(one)));
}

/** As Python's `datetime.isoformat` writes it: a date, a time, and an offset from UTC. */
const TIME = /^(\d{4}-\d\d-\d\d)T(\d\d):(\d\d)(?::(\d\d)(?:\.\d+)?)?([+-]\d\d:\d\d)$/;

function readSun(value: unknown, broken: (fault: string) => Fault): Place["sun"] {
  if (value === null || value === undefined) return null;
  if (typeof value !== "object") throw broken('"sun" is not a record');
  const { latitude_deg, longitude_deg, time, assumed } = value as Fields<PlaceSun>;
  const isAssumed = (what: string): boolean => Array.isArray(assumed) && assumed.includes(what);
  const northKnown = !isAssumed("north");
  if (typeof latitude_deg !== "number" || typeof longitude_deg !== "number" || typeof time !== "string") {
    return { northKnown, day: null };
  }
  const [, date = "", hours, minutes, seconds, offset = ""] = TIME.exec(time) ?? [];
  const midnight_ms = Date.parse(`${date}T00:00:00${offset}`);
  if (Math.abs(latitude_deg) > 90 || Math.abs(longitude_deg) > 180 || !Number.isFinite(midnight_ms)) {
    throw broken('"sun" is at no place or time');
  }
  const hour = Number(hours) + Number(minutes) / 60 + Number(seconds ?? 0) / 3600;
  const timeKnown = !isAssumed("time");
  return { northKnown, day: { latitude_deg, longitude_deg, midnight_ms, hour, date, zone: `UTC${offset}`, timeKnown } };
}

function readTileset(value: unknown, broken: (fault: string) => Fault): string | null {
  if (value === null || value === undefined) return null;
  if (!isInside(value)) throw broken('"tileset" is not a file of its folder');
  return value;
}

type Fields<T> = { readonly [Key in keyof T]?: unknown };

function parse(text: string, broken: (fault: string) => Fault): unknown {
  try {
    return JSON.parse(text) as unknown;
  } catch (error) {
    if (error instanceof SyntaxError) throw broken(`it is not JSON (${error.message})`);
    throw error;
  }
}

function record(value: unknown, bad: () => Fault): Fields<Manifest & Manifest["start"]> {
  if (typeof value !== "object" || value === null || Array.isArray(value)) throw bad();
  return value;
}

function readPart(value: unknown, which: string, broken: (fault: string) => Fault): Part {
  const bad = (field: string): Fault => broken(`${which} has no proper "${field}"`);
  if (typeof value !== "object" || value === null) throw broken(`${which} is not a record`);
  const part = value as Fields<PlacePart>;
  const text = (field: "id" | "name"): string => {
    const given: unknown = part[field];
    if (typeof given !== "string") throw bad(field);
    return given;
  };
  const transform: unknown = part.transform ?? IDENTITY;
  if (!isTransform(transform)) throw bad("transform");
  checkPlacement(transform, which, broken);
  if (part.arrangement !== "single" && part.arrangement !== "invented") throw bad("arrangement");
  if (!isInside(part.model)) throw bad("model");
  const id = text("id");
  const isGround = part.ground === true;
  const isBackdrop = part.backdrop === true;
  return {
    id,
    name: text("name"),
    model: part.model,
    photo: isInside(part.photo) ? part.photo : null,
    raw: isInside(part.raw) ? part.raw : null,
    document: isInside(part.document) ? part.document : null,
    worldFromPart: transform,
    arrangement: part.arrangement,
    bounds: readBounds(part.bounds),
    core: readBounds(part.core),
    isGround,
    isBackdrop,
    layer: isBackdrop ? "backdrop" : isGround ? null : id === WALLS ? "walls" : "model",
  };
}

function readBounds(value: unknown): Box | null {
  if (typeof value !== "object" || value === null) return null;
  const { min, max } = value as Fields<Box>;
  return isPoint(min) && isPoint(max) ? { min, max } : null;
}

/**
 * The corners of the boxes (around nearly all of each) of all parts but the ground and what is around it, world
 * frame: what one comes to see. Of a place that is nothing but ground, such as a map, those of the ground.
 */
export function cornersOfPlace(place: Place): Vec3[] {
  const alive = new Set(place.animals.map(({ part }) => part));
  const corners = (isWanted: (part: Part) => boolean): Vec3[] =>
    place.parts.flatMap((part, index) => {
      const { bounds, core, isBackdrop, worldFromPart } = part;
      if (bounds === null || isBackdrop || alive.has(index) || !isWanted(part)) return [];
      return cornersOf(core ?? bounds).map((corner) => worldPoint(worldFromPart, corner));
    });
  const built = corners(({ isGround }) => !isGround);
  // Of an animal one sees what is around its path.
  const seen = [...built, ...place.animals.flatMap(aroundPath)];
  return seen.length > 0 ? seen : corners(({ isGround }) => isGround);
}

function aroundPath({ path, length_m }: Animal): Vec3[] {
  const size = 0.25 * length_m;
  return path.flatMap(([x, y, z]): Vec3[] => [[x - size, y - size, z], [x + size, y + size, z + size]]);
}

/** The ground of a town ends this far below the plane around it, into which it dips (grammar/ground_margin.py). */
const DIPS_M = -0.3;

/**
 * The height of the lowest corner of the place's own ground, world frame; null where it has none, and 0
 * where its end is meant to dip into the plane around it.
 */
export function lowestGround(place: Place): number | null {
  const heights = place.parts.flatMap(({ bounds, isGround, isBackdrop, worldFromPart }) =>
    isGround || isBackdrop ? (bounds === null ? [0] : cornersOf(bounds).map((corner) => worldPoint(worldFromPart, corner)[2])) : [],
  );
  if (heights.length === 0) return null;
  const lowest = Math.min(...heights);
  const joins = place.parts.some(({ isBackdrop }) => isBackdrop);
  return joins || lowest < DIPS_M - 0.01 ? lowest : 0;
}

function list(value: unknown, most: number, what: string, broken: (fault: string) => Fault): unknown[] {
  if (!Array.isArray(value)) throw broken(`it has no list of ${what}`);
  if (value.length > most) throw broken(`it names more than ${most} ${what}`);
  return value as unknown[];
}

function readCloud(value: unknown, which: string, broken: (fault: string) => Fault): Cloud {
  const bad = (field: string): Fault => broken(`${which} has no proper "${field}"`);
  if (typeof value !== "object" || value === null) throw broken(`${which} is not a record`);
  const cloud = value as Fields<PlacePoints>;
  const transform: unknown = cloud.transform ?? IDENTITY;
  if (!isTransform(transform)) throw bad("transform");
  checkPlacement(transform, which, broken);
  if (!isInside(cloud.file)) throw bad("file");
  const bounds = (cloud.bounds ?? {}) as { min?: unknown; max?: unknown };
  const min = readVec3(bounds.min, () => bad("bounds"));
  const max = readVec3(bounds.max, () => bad("bounds"));
  if (min.some((low, axis) => low > (max[axis] ?? low))) throw bad("bounds");
  const layer: unknown = cloud.layer ?? "points";
  if (layer !== "points" && layer !== "distances") throw bad("layer");
  const count = typeof cloud.count === "number" ? cloud.count : null;
  return { file: cloud.file, layer, worldFromPoints: transform, count, bounds: { min, max } };
}

function readShot(value: unknown, which: string, broken: (fault: string) => Fault): Shot {
  const bad = (field: string): Fault => broken(`${which} has no proper "${field}"`);
  if (typeof value !== "object" || value === null) throw broken(`${which} is not a record`);
  const shot = value as Fields<PlaceCamera>;
  const { id, name, picture, transform } = shot;
  if (typeof id !== "string") throw bad("id");
  if (typeof name !== "string") throw bad("name");
  if (!isInside(picture)) throw bad("picture");
  if (!isTransform(transform)) throw bad("transform");
  checkPlacement(transform, which, broken);
  const size = readPair([shot.width_px, shot.height_px], () => bad("width_px"));
  const focal_px = readPair(shot.focal_px, () => bad("focal_px"));
  if (Math.min(...size, ...focal_px) <= 0) throw bad("focal_px");
  const [width_px, height_px] = size;
  const centre_px = readPair(shot.centre_px, () => bad("centre_px"));
  return { id, name, picture, width_px, height_px, focal_px, centre_px, worldFromCamera: transform };
}

function readPair(value: unknown, bad: () => Fault): [number, number] {
  if (!Array.isArray(value) || value.length !== 2) throw bad();
  const [x, y] = value as unknown[];
  if (!Number.isFinite(x) || !Number.isFinite(y)) throw bad();
  return [x as number, y as number];
}

function isTransform(value: unknown): value is number[] {
  return Array.isArray(value) && value.length === 16 && value.every((v) => Number.isFinite(v));
}

/** No coordinate of a projected CRS is larger; the rule is that of `place/manifest.py`. */
const FARTHEST_M = 1e7;

/** A transform (column-major) must put a thing somewhere, and not out of all reach. */
function checkPlacement(transform: readonly number[], which: string, broken: (fault: string) => Fault): void {
  const [a = 0, b = 0, c = 0, , d = 0, e = 0, f = 0, , g = 0, h = 0, i = 0] = transform;
  const volume = a * (e * i - f * h) - d * (b * i - c * h) + g * (b * f - c * e);
  const isAffine = [3, 7, 11].every((at) => transform[at] === 0) && transform[15] === 1;
  if (!isAffine || !(volume > 0)) throw broken(`${which} stands nowhere: its "transform" is no placement in space`);
  const farthest = Math.max(...transform.map(Math.abs));
  if (farthest > FARTHEST_M) throw broken(`${which} stands more than ${FARTHEST_M / 1000} km away, by its "transform"`);
}

/** A path that stays in the folder of the manifest; the rule is that of `place/manifest.py`. */
export function isInside(path: unknown): path is string {
  if (typeof path !== "string" || path === "") return false;
  const steps = path.split("/");
  return !path.startsWith("/") && !path.includes("\\") && !steps[0]?.includes(":") && !steps.includes("..");
}

function readVec3(value: unknown, bad: () => Fault): Vec3 {
  if (!isPoint(value)) throw bad();
  return [value[0], value[1], value[2]];
}

function isPoint(value: unknown): value is Vec3 {
  return Array.isArray(value) && value.length === 3 && value.every((v) => Number.isFinite(v));
}

/** The address of the manifest: `?place=` (a file, or a folder ending in /), else beside the page. */
export function placeAddress(page: URL): URL {
  const asked = page.searchParams.get("place") ?? "place.json";
  const url = URL.canParse(asked, page) ? new URL(asked, page) : null;
  if (url?.origin !== page.origin || url.protocol !== page.protocol) {
    throw new Fault(
      asked,
      "a place is shown only from the server that this page came from",
      "Copy the place beside the studio, or run `veduta view` on its folder.",
    );
  }
  if (url.pathname.endsWith("/")) url.pathname += "place.json";
  return url;
}

/** The address of a file that the manifest names; its name may hold `#`, `?` and `%`. */
export function fileAddress(file: string, manifest: URL): URL {
  return new URL(file.split("/").map(encodeURIComponent).join("/"), manifest);
}
