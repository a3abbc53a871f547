import { describe, expect, it } from "vitest";
import { changeBy } from "../../src/core/house-keys.ts";
import type { House, Point, Room } from "../../src/core/house.ts";
import { reflectedLux, RoomSwitches } from "../../src/core/lights.ts";
import { areaOf, boxOfStorey, onMap } from "../../src/core/map-drawing.ts";
import { roomMapOf, roomsOf } from "../../src/core/room-map.ts";
import { INITIAL_STATE } from "../../src/core/state.ts";
import { isIn } from "../../src/core/whereabouts.ts";

function room(id: string, outline: Point[], holes: Point[][] = []): Room {
  return { id, name: "", use: "bedroom", outline, holes, area_m2: 12, isOutdoors: false };
}

const SQUARE = room("a", [[0, 0], [4, 0], [4, 3], [0, 3]]);
/** An L whose arms are aslant, with a column in it. */
const ASLANT = room("b", [[4.2, 0], [8, 0.5], [7.6, 3.4], [6.1, 3.2], [6.2, 2], [4.2, 1.8]], [[[5, 0.8], [5.6, 0.8], [5.3, 1.4]]]);
const HOUSE: House = {
  storeys: [
    { name: "0", floor_m: 0, height_m: 2.5, rooms: [SQUARE, ASLANT], walls: [], openings: [], lamps: [{ at: [2, 1, 2.3], room: 0, lumen: 1000 }] },
    { name: "1", floor_m: 2.8, height_m: 2.5, rooms: [room("c", [[0, 0], [2, 0], [2, 3], [0, 3]])], walls: [], openings: [], lamps: [] },
  ],
};

describe("the grid of rooms", () => {
  const { corner, cell_m, columns, rows, cells } = roomMapOf(HOUSE);
  const at = (storey: number, x: number, y: number): number =>
    cells[(storey * rows + Math.floor((y - corner[1]) / cell_m)) * columns + Math.floor((x - corner[0]) / cell_m)] ?? -1;

  it("says for each place in which room it is, but for a cell at its edge", () => {
    for (let x = -0.03; x < 8.03; x += 0.173) {
      for (let y = -0.03; y < 3.43; y += 0.119) {
        const truth = isIn(SQUARE, x, y) ? 1 : isIn(ASLANT, x, y) ? 2 : 0;
        const near = [-1, 1].flatMap((dx) => [-1, 1].map((dy) => at(0, x + 1.5 * dx * cell_m, y + 1.5 * dy * cell_m)));
        if (near.every((value) => value === near[0])) expect(at(0, x, y), `${x} ${y}`).toBe(truth);
      }
    }
  });

  it("tells the storeys apart, and keeps the wall between two rooms free in its middle", () => {
    expect([at(1, 1, 1), at(1, 3, 1), at(0, 3, 1)]).toEqual([3, 0, 1]);
    expect([at(0, 4.1, 1), at(0, 4.02, 1), at(0, 4.18, 1)]).toEqual([0, 1, 2]);
  });
});

describe("a house of many rooms", () => {
  it("has each of them on its map, those beyond the two hundred and fifty-fifth, too", () => {
    const cells = Array.from({ length: 600 }, (_, i) => {
      const [x, y] = [(i % 30) / 2, Math.floor(i / 30) / 2];
      return room(`r${i}`, [[x, y], [x + 0.4, y], [x + 0.4, y + 0.4], [x, y + 0.4]]);
    });
    const storeys = [{ name: "0", floor_m: 0, height_m: 2.5, rooms: cells, walls: [], openings: [], lamps: [] }];
    const map = roomMapOf({ storeys });
    const found = cells.map((_, i) => {
      const [x, y] = [(i % 30) / 2 + 0.2, Math.floor(i / 30) / 2 + 0.2];
      const [column, row] = [x - map.corner[0], y - map.corner[1]].map((away) => Math.floor(away / map.cell_m));
      return map.cells[(row ?? 0) * map.columns + (column ?? 0)];
    });
    expect(found).toEqual(cells.map((_, i) => i + 1));
  });
});

describe("lamps", () => {
  const now = { habit: "auto", mode: "walk", isNight: true, here: null, now_s: 0 } as const;

  it("go on where one comes in and off 20 s after one has left", () => {
    const switches = new RoomSwitches(roomsOf(HOUSE).map(() => true));
    expect(switches.advance({ ...now, here: 1 }, 10)).toBe(true);
    expect([...switches.levels]).toEqual([0, 1, 0]);
    switches.advance({ ...now, here: 0, now_s: 15 }, 10);
    expect([...switches.levels]).toEqual([1, 1, 0]);
    switches.advance({ ...now, here: 0, now_s: 21 }, 10);
    expect([...switches.levels]).toEqual([1, 0, 0]);
    expect(switches.advance({ ...now, here: 0, now_s: 22 }, 1)).toBe(false);
  });

  it("fade, and only those that there are are switched", () => {
    const switches = new RoomSwitches([true, false, true]);
    switches.advance({ ...now, habit: "on" }, 0.1);
    expect(switches.levels[0]).toBeGreaterThan(0);
    expect(switches.levels[0]).toBeLessThan(1);
    switches.advance({ ...now, habit: "on" }, 5);
    expect([...switches.levels]).toEqual([1, 0, 1]);
    switches.advance({ ...now, habit: "off", here: 0 }, 5);
    expect([...switches.levels]).toEqual([0, 0, 0]);
  });

  it("are on in a house that is seen from outside by night", () => {
    const switches = new RoomSwitches([true]);
    switches.advance({ ...now, mode: "orbit", isNight: false }, 5);
    expect(switches.levels[0]).toBe(0);
    switches.advance({ ...now, mode: "orbit" }, 5);
    expect(switches.levels[0]).toBe(1);
  });

  it("light their room by reflection, as much as its surfaces are small", () => {
    const [first, second, third] = reflectedLux(HOUSE);
    expect(first).toBeCloseTo((0.8 * 1000) / (2 * 12 + 14 * 2.5), 9);
    expect([second, third]).toEqual([0, 0]);
  });
});

describe("the keys of a house", () => {
  it("make night and day, and go through the habits of lamps and doors", () => {
    const night = changeBy("daylight", INITIAL_STATE);
    expect(night).toEqual({ change: { hour: 22 }, words: "22:00, night" });
    expect(changeBy("daylight", { ...INITIAL_STATE, hour: 22 }).change.hour).toBeCloseTo(INITIAL_STATE.hour, 9);
    expect(changeBy("lights", INITIAL_STATE).change).toEqual({ lights: "on" });
    expect(changeBy("lights", { ...INITIAL_STATE, lights: "off" }).change).toEqual({ lights: "auto" });
    expect(changeBy("doors", INITIAL_STATE).change).toEqual({ doors: "open" });
    expect(changeBy("map", INITIAL_STATE).change).toEqual({ map: false });
  });
});

describe("the map", () => {
  it("has north up, and shows those at its rim who are further out", () => {
    const [storey] = HOUSE.storeys;
    if (storey === undefined) throw new Error("no storey");
    const box = boxOfStorey(storey);
    expect([box.x, box.y, box.x + box.width, box.y + box.height].map((v) => Number(v.toFixed(6)))).toEqual([-1.2, -4.6, 9.2, 1.2]);
    expect(onMap(box, [2, 1])).toEqual([2, -1]);
    expect(onMap(box, [-50, 40]).map((v) => Number(v.toFixed(6)))).toEqual([-0.8, -4.2]);
    expect(areaOf(SQUARE)).toBe("M0 0L4 0L4 -3L0 -3Z");
  });
});
