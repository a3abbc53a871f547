/** A house as one walks in it: storeys, rooms, walls, openings and lamps, of a `plan.json`. */
import { pointAlong, polylineOf } from "./arc.ts";
import { Fault } from "./fault.ts";
import { worldPoint } from "./frames.ts";
import type { Vec3 } from "./vector.ts";

/** x and y of the world frame. */
export type Point = readonly [number, number];

export interface Room {
  readonly id: string;
  /** As it is written on the plan; empty where it is not. */
  readonly name: string;
  readonly use: string;
  readonly outline: readonly Point[];
  readonly holes: readonly (readonly Point[])[];
  readonly area_m2: number;
  readonly isOutdoors: boolean;
}

export interface Wall {
  readonly line: readonly Point[];
  readonly thickness_m: number;
}

export interface Opening {
  readonly kind: "door" | "window" | "gap";
  readonly line: readonly Point[];
  readonly thickness_m: number;
}

export interface Lamp {
  readonly at: Vec3;
  /** Number of its room in the storey; null where it lights none. */
  readonly room: number | null;
  readonly lumen: number;
}

export interface Storey {
  readonly name: string;
  /** Height of its floor in the world frame. */
  readonly floor_m: number;
  readonly height_m: number;
  readonly rooms: readonly Room[];
  readonly walls: readonly Wall[];
  readonly openings: readonly Opening[];
  readonly lamps: readonly Lamp[];
}

/** The storeys from the lowest up. */
export interface House {
  readonly storeys: readonly Storey[];
}

/** More than any house has; a larger number is a broken or hostile file. */
const MOST_STOREYS = 200;
const MOST_RECORDS = 20_000;
const REMEDY = "Mend the document, or write the house again with `veduta plan`.";
/** A wall that bends by more is no wall. */
const MOST_BULGE = 10;

type Record_ = Readonly<Record<string, unknown>>;

/** The house of a document; null where the document is of something else. */
export function readHouse(text: string, file: string, worldFromPart: readonly number[]): House | null {
  const fault = (where: string): Fault => new Fault(file, `${where} is missing or no proper value`, REMEDY);
  const document = parsed(text, file);
  if (typeof document !== "object" || document === null) return null;
  const { schema, version, storeys } = document as Record_;
  if (schema !== "veduta/plan") return null;
  if (version !== 1) {
    throw new Fault(file, `its version is ${String(version)}, and this studio reads version 1`, "Use the studio of the Veduta that wrote it.");
  }
  const read = list(storeys, "storeys", fault, MOST_STOREYS).map((storey, index) =>
    new Reader(worldFromPart, `storeys[${index}]`, fault).storey(storey),
  );
  return { storeys: read.toSorted((a, b) => a.floor_m - b.floor_m) };
}

function parsed(text: string, file: string): unknown {
  try {
    return JSON.parse(text) as unknown;
  } catch (error) {
    if (error instanceof SyntaxError) throw new Fault(file, `it is not JSON (${error.message})`, REMEDY);
    throw error;
  }
}

function list(value: unknown, where: string, fault: (where: string) => Fault, most = MOST_RECORDS): Record_[] {
  if (!Array.isArray(value) || value.length > most) throw fault(where);
  return value.map((item: unknown, index) => {
    if (typeof item !== "object" || item === null) throw fault(`${where}[${index}]`);
    return item as Record_;
  });
}

/** Reads the records of one storey; lengths are metres, in the document and in the world. */
class Reader {
  readonly #worldFromPart: readonly number[];
  readonly #place: string;
  readonly #fault: (where: string) => Fault;

  constructor(worldFromPart: readonly number[], place: string, fault: (where: string) => Fault) {
    this.#worldFromPart = worldFromPart;
    this.#place = place;
    this.#fault = fault;
  }

  storey(given: Record_): Storey {
    const elevation = this.#number(given.elevation_m, "elevation_m");
    const rooms = this.#list(given.rooms, "rooms").map((room, index) => this.#room(room, `rooms[${index}]`));
    const junctions = new Map(
      this.#list(given.junctions, "junctions").map(({ id, at_m }, index) => [id, this.#point(at_m, `junctions[${index}].at_m`)]),
    );
    const walls = new Map(
      this.#list(given.walls, "walls").map((wall, index) => [wall.id, this.#wall(wall, junctions, `walls[${index}]`)]),
    );
    const lamps = given.lights === null || given.lights === undefined ? [] : this.#list(given.lights, "lights");
    return {
      name: typeof given.name === "string" ? given.name : "",
      floor_m: worldPoint(this.#worldFromPart, [0, 0, elevation])[2],
      height_m: this.#number(given.height_m, "height_m"),
      rooms,
      walls: [...walls.values()],
      openings: this.#list(given.openings, "openings").flatMap((opening, index) => this.#opening(opening, walls, `openings[${index}]`)),
      lamps: lamps.map((lamp, index) => this.#lamp(lamp, elevation, rooms, `lights[${index}]`)),
    };
  }

  #room(given: Record_, where: string): Room {
    const { id, name, use } = given;
    if (typeof id !== "string") throw this.#bad(`${where}.id`);
    const holes = given.holes_m ?? [];
    if (!Array.isArray(holes)) throw this.#bad(`${where}.holes_m`);
    return {
      id,
      name: typeof name === "string" ? name : "",
      use: typeof use === "string" ? use : "unknown",
      outline: this.#points(given.outline_m, `${where}.outline_m`),
      holes: holes.map((hole: unknown, index) => this.#points(hole, `${where}.holes_m[${index}]`)),
      area_m2: this.#number(given.area_m2, `${where}.area_m2`),
      isOutdoors: given.outdoors === true,
    };
  }

  #wall(given: Record_, junctions: ReadonlyMap<unknown, Point>, where: string): Wall {
    const [start, end] = [junctions.get(given.start), junctions.get(given.end)];
    if (start === undefined) throw this.#bad(`${where}.start`);
    if (end === undefined) throw this.#bad(`${where}.end`);
    const bulge = this.#number(given.bulge ?? 0, `${where}.bulge`);
    if (Math.abs(bulge) > MOST_BULGE) throw this.#bad(`${where}.bulge`);
    return { line: polylineOf(start, end, bulge), thickness_m: this.#number(given.thickness_m, `${where}.thickness_m`) };
  }

  #opening(given: Record_, walls: ReadonlyMap<unknown, Wall>, where: string): Opening[] {
    const wall = walls.get(given.wall);
    const { kind } = given;
    if (kind !== "door" && kind !== "window" && kind !== "gap") throw this.#bad(`${where}.kind`);
    if (wall === undefined) throw this.#bad(`${where}.wall`);
    const along = this.#number(given.along_m, `${where}.along_m`);
    const width = this.#number(given.width_m, `${where}.width_m`);
    const line = [along, along + width / 2, along + width].map((distance) => pointAlong(wall.line, distance));
    return [{ kind, line, thickness_m: wall.thickness_m }];
  }

  #lamp(given: Record_, elevation: number, rooms: readonly Room[], where: string): Lamp {
    const at = this.#pair(given.at_m, `${where}.at_m`);
    const above = this.#number(given.above_m, `${where}.above_m`);
    const lumen = this.#number(given.lumen, `${where}.lumen`);
    const room = rooms.findIndex(({ id }) => id === given.room);
    return { at: worldPoint(this.#worldFromPart, [...at, elevation + above]), room: room < 0 ? null : room, lumen };
  }

  #points(value: unknown, where: string): Point[] {
    if (!Array.isArray(value) || value.length > MOST_RECORDS) throw this.#bad(where);
    return value.map((point: unknown, index) => this.#point(point, `${where}[${index}]`));
  }

  #point(value: unknown, where: string): Point {
    const [x, y] = worldPoint(this.#worldFromPart, [...this.#pair(value, where), 0]);
    return [x, y];
  }

  #pair(value: unknown, where: string): [number, number] {
    if (!Array.isArray(value) || value.length !== 2) throw this.#bad(where);
    return [this.#number(value[0], where), this.#number(value[1], where)];
  }

  #number(value: unknown, where: string): number {
    if (typeof value !== "number" || !Number.isFinite(value)) throw this.#bad(where);
    return value;
  }

  #list(value: unknown, where: string): Record_[] {
    return list(value, `${this.#place}.${where}`, this.#fault);
  }

  #bad(where: string): Fault {
    return this.#fault(`${this.#place}.${where}`);
  }
}
