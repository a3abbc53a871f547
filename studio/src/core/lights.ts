/** Which rooms are lit: lamps go on where one comes in, and off some time after one has left. */
import type { House } from "./house.ts";
import { roomsOf } from "./room-map.ts";
import type { LightHabit, Mode } from "./state.ts";

/** How long a room that was left stays lit. */
const LINGER_S = 20;
/** How long lamps take to go on or off. */
const FADE_S = 0.35;

export interface Occasion {
  readonly habit: LightHabit;
  readonly mode: Mode;
  readonly isNight: boolean;
  /** The number over all storeys of the room that somebody is in. */
  readonly here: number | null;
  /** A clock that only goes forward. */
  readonly now_s: number;
}

export class RoomSwitches {
  /** From 0 (dark) to 1, by the room's number. */
  readonly levels: Float32Array;
  readonly #hasLamps: readonly boolean[];
  readonly #lastIn_s: Float64Array;

  /** `hasLamps`: for each room, whether there is anything to switch. */
  constructor(hasLamps: readonly boolean[]) {
    this.#hasLamps = hasLamps;
    this.levels = new Float32Array(hasLamps.length);
    this.#lastIn_s = new Float64Array(hasLamps.length).fill(-Infinity);
  }

  /** True while lamps go on or off. */
  advance(occasion: Occasion, seconds: number): boolean {
    if (occasion.here !== null && occasion.mode === "walk") this.#lastIn_s[occasion.here] = occasion.now_s;
    let fades = false;
    for (const [room, level] of this.levels.entries()) {
      const target = this.#isLit(room, occasion) ? 1 : 0;
      if (level === target) continue;
      const step = seconds / FADE_S;
      this.levels[room] = target > level ? Math.min(1, level + step) : Math.max(0, level - step);
      fades = true;
    }
    return fades;
  }

  #isLit(room: number, { habit, mode, isNight, now_s }: Occasion): boolean {
    if (this.#hasLamps[room] !== true || habit === "off") return false;
    if (habit === "on") return true;
    // Who looks at the house from outside by night sees that somebody is at home.
    if (mode === "orbit") return isNight;
    return now_s - (this.#lastIn_s[room] ?? -Infinity) < LINGER_S;
  }
}

/** Of all light of a room's lamps, how much falls on each square metre after the walls' reflections. */
const REFLECTED = 0.8;

/** Mean illuminance (lx) by reflection in each room with all of its lamps on, by the room's number. */
export function reflectedLux(house: House): number[] {
  return roomsOf(house).map(({ room, storey }) => {
    const { height_m = 0, lamps = [], rooms = [] } = house.storeys[storey] ?? {};
    const lumen = lamps.reduce((sum, lamp) => sum + (rooms[lamp.room ?? -1] === room ? lamp.lumen : 0), 0);
    const round = room.outline.reduce((sum, [x, y], i) => {
      const [nextX, nextY] = room.outline[(i + 1) % room.outline.length] ?? [x, y];
      return sum + Math.hypot(nextX - x, nextY - y);
    }, 0);
    const surface = 2 * room.area_m2 + round * height_m;
    return surface > 0 ? (REFLECTED * lumen) / surface : 0;
  });
}
