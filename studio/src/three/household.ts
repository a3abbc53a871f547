/** What goes on by itself in the houses of a place: doors open, lamps go on. */
import { Group } from "three";
import type { Daylight } from "../core/daylight.ts";
import type { House } from "../core/house.ts";
import type { StudioState } from "../core/state.ts";
import type { Tour } from "../core/tour.ts";
import type { Vec3 } from "../core/vector.ts";
import type { Walker } from "../core/walking.ts";
import { type Whereabouts, whereaboutsOf } from "../core/whereabouts.ts";
import type { Doors } from "./doors.ts";
import type { LoadedPart } from "./load.ts";
import { RoomLights } from "./room-lights.ts";

export interface LoadedHouse {
  readonly house: House;
  readonly part: LoadedPart;
}

/** Below this share of the day's light lamps are lit in a house that is seen from outside. */
const EVENING = 0.5;
const NONE: ReadonlySet<string> = new Set();

export class Household {
  /** Light around the lamps. */
  readonly group = new Group();
  readonly #houses: House[] = [];
  readonly #doorsNow: () => Doors | null;
  readonly #tours: readonly Tour[];
  readonly #lights: RoomLights[] = [];
  #day = 1;

  /** `doors` are those that there are now, `tours` those of the place. */
  constructor(houses: readonly LoadedHouse[], doors: () => Doors | null, tours: readonly Tour[]) {
    this.#doorsNow = doors;
    this.#tours = tours;
    for (const house of houses) this.take(house);
  }

  /** A house whose model and document have come. */
  take({ house, part }: LoadedHouse): void {
    const lights = new RoomLights(house, part);
    lights.day = this.#day;
    this.#houses.push(house);
    this.#lights.push(lights);
    this.group.add(lights.glow);
  }

  get doors(): Doors | null {
    return this.#doorsNow();
  }

  /** How far the lamps of each room of a house are on (0..1), by its number over all storeys. */
  levelsOf(house: number): readonly number[] {
    return [...(this.#lights[house]?.levels ?? [])];
  }

  whereabouts(feet: Vec3): Whereabouts | null {
    return whereaboutsOf(this.#houses, feet);
  }

  set daylight({ day }: Daylight) {
    this.#day = day;
    for (const lights of this.#lights) lights.day = day;
  }

  /** True for each of doors and lamps while it changes. */
  advance(state: StudioState, walker: Walker, eye: Vec3, seconds: number): { doors: boolean; lamps: boolean } {
    const walks = state.mode === "walk";
    const toured = state.tour?.playing === true ? state.tour : null;
    const heading = toured === null ? walker.heading : null;
    const shut = this.#tours[toured?.which ?? -1]?.shut ?? NONE;
    const visitor = walks ? { feet: walker.feet, heading } : null;
    const doors = this.doors?.advance(visitor, state.doors === "open", seconds, shut) ?? false;
    const here = walks ? this.whereabouts(walker.feet) : null;
    let lamps = false;
    for (const [house, lights] of this.#lights.entries()) {
      const occasion = {
        habit: state.lights,
        mode: state.mode,
        isNight: this.#day < EVENING,
        here: here?.house === house ? this.#roomOf(here) : null,
        now_s: performance.now() / 1000,
      };
      if (lights.advance(occasion, eye, seconds)) lamps = true;
    }
    return { doors, lamps };
  }

  /** The number over all storeys of the room that somebody is in. */
  #roomOf({ house, storey, room }: Whereabouts): number | null {
    if (room === null) return null;
    const below = this.#houses[house]?.storeys.slice(0, storey) ?? [];
    return below.reduce((count, { rooms }) => count + rooms.length, room);
  }
}
