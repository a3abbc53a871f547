import { describe, expect, it } from "vitest";
import { pointAlong, polylineOf } from "../../src/core/arc.ts";
import { Fault } from "../../src/core/fault.ts";
import { type House, readHouse } from "../../src/core/house.ts";
import { roomTitle, standingPlaces, storeyAt, whereaboutsOf } from "../../src/core/whereabouts.ts";

const UNMOVED = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
/** A quarter turn to the left about the vertical, then 10 east and 0.5 up. */
const TURNED = [0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 10, 0, 0.5, 1];

/** Two rooms of 4 x 3 m beside each other, the second with a column; a door between them. */
function storey(elevation_m = 0): Record<string, unknown> {
  const room = (id: string, x: number, more: object): object => ({
    id, outline_m: [[x, 0], [x + 4, 0], [x + 4, 3], [x, 3]], area_m2: 12, use: "bedroom", name: "", ...more,
  });
  return {
    name: `floor at ${elevation_m}`,
    elevation_m,
    height_m: 2.8,
    junctions: [{ id: "a", at_m: [4.1, 0] }, { id: "b", at_m: [4.1, 3] }],
    walls: [{ id: "w", start: "a", end: "b", bulge: 0, thickness_m: 0.2 }],
    openings: [{ id: "o", wall: "w", kind: "door", along_m: 1, width_m: 0.9 }],
    rooms: [room("r1", 0, {}), room("r2", 4.2, { name: "KITCHEN", holes_m: [[[6, 1], [7, 1], [7, 2], [6, 2]]] })],
    lights: [{ id: "l", kind: "ceiling", room: "r2", at_m: [5, 1.5], above_m: 2.4, lumen: 900 }],
  };
}

function plan(...storeys: object[]): Record<string, unknown> {
  return { schema: "veduta/plan", version: 1, storeys };
}

function read(document: object, matrix = UNMOVED): House {
  const house = readHouse(JSON.stringify(document), "plan.json", matrix);
  if (house === null) throw new Error("it is not read as a house");
  return house;
}

describe("a plan document", () => {
  it("is read in the world frame", () => {
    const [only] = read(plan(storey()), TURNED).storeys;
    expect(only?.floor_m).toBeCloseTo(0.5, 9);
    expect(only?.rooms[0]?.outline[1]).toEqual([10, 4]);
    expect(only?.lamps[0]).toMatchObject({ room: 1, lumen: 900 });
    expect(only?.lamps[0]?.at.map((v) => Number(v.toFixed(6)))).toEqual([8.5, 5, 2.9]);
    const ends = only?.openings[0]?.line ?? [];
    expect([ends[0], ends[2]].map((p) => p?.map((v) => Number(v.toFixed(6))))).toEqual([[9, 4.1], [8.1, 4.1]]);
  });

  it("has its storeys from the lowest up, and may have no lights yet", () => {
    const { storeys } = read(plan(storey(2.8), { ...storey(0), lights: null }));
    expect(storeys.map(({ floor_m }) => floor_m)).toEqual([0, 2.8]);
    expect(storeys[0]?.lamps).toEqual([]);
  });

  it("of something else is no house", () => {
    expect(readHouse('{"schema": "veduta/facade", "version": 1}', "facade.json", UNMOVED)).toBeNull();
    expect(readHouse("3", "x.json", UNMOVED)).toBeNull();
  });

  it.each([
    [{ ...storey(), rooms: 7 }, "storeys[0].rooms"],
    [{ ...storey(), walls: [{ id: "w", start: "a", end: "z", thickness_m: 0.1 }] }, "storeys[0].walls[0].end"],
    [{ ...storey(), junctions: [{ id: "a", at_m: [4, "x"] }] }, "storeys[0].junctions[0].at_m"],
    [{ ...storey(), elevation_m: null }, "storeys[0].elevation_m"],
  ])("that is broken is refused with the place of the fault (%#)", (broken, where) => {
    expect(() => read(plan(broken))).toThrow(Fault);
    expect(() => read(plan(broken))).toThrow(where);
  });
});

describe("somebody in a house", () => {
  const house = read(plan(storey(0), storey(2.8)));

  it("is in a room, in a wall, or outside", () => {
    const at = (x: number, y: number, z = 0): unknown => whereaboutsOf([house], [x, y, z]);
    expect(at(1, 1)).toEqual({ house: 0, storey: 0, room: 0 });
    expect(at(5, 1, 2.8)).toEqual({ house: 0, storey: 1, room: 1 });
    expect(at(4.1, 1)).toEqual({ house: 0, storey: 0, room: null });
    expect(at(6.5, 1.5)).toEqual({ house: 0, storey: 0, room: null });
    expect(at(-3, 1)).toEqual({ house: 0, storey: 0, room: null });
  });

  it("is on the next storey only at the end of the stair", () => {
    expect([-1, 0, 1.5, 2.3, 2.8, 9].map((z) => storeyAt(house, z))).toEqual([0, 0, 0, 1, 1, 1]);
  });

  it("of several houses is in the nearest", () => {
    const far = read(plan(storey()), [...UNMOVED.slice(0, 12), 40, 0, 0, 1]);
    expect(whereaboutsOf([house, far], [38, 1, 0])?.house).toBe(1);
    expect(whereaboutsOf([], [0, 0, 0])).toBeNull();
  });

  it("is put where there is room to stand, as near as can be to where one pointed", () => {
    const room = house.storeys[0]?.rooms[1];
    if (room === undefined) throw new Error("there is no such room");
    expect(standingPlaces(room, [5, 1])[0]).toEqual([5, 1]);
    for (const [x, y] of standingPlaces(room, [6.5, 1.5])) {
      expect(Math.min(x - 4.2, 8.2 - x, y, 3 - y)).toBeGreaterThan(0.35);
      expect(Math.max(Math.abs(x - 6.5), Math.abs(y - 1.5))).toBeGreaterThan(0.8);
    }
    expect(standingPlaces(room, [6.5, 1.5]).length).toBeGreaterThan(10);
  });

  it("is told the room's name, else its use", () => {
    const [bedroom, kitchen] = house.storeys[0]?.rooms ?? [];
    expect([bedroom, kitchen].map((room) => room && roomTitle(room))).toEqual(["Bedroom", "Kitchen"]);
    expect(bedroom && roomTitle({ ...bedroom, name: "MH 2" })).toBe("MH 2");
    expect(bedroom && roomTitle({ ...bedroom, use: "unknown" })).toBe("Room");
  });
});

describe("a curved wall", () => {
  it("is an arc of a circle: a half circle to the right of its chord", () => {
    const line = polylineOf([0, 0], [2, 0], 1);
    for (const [x, y] of line) expect(Math.hypot(x - 1, y)).toBeCloseTo(1, 9);
    const lowest = Math.min(...line.map(([, y]) => y));
    expect(lowest).toBeCloseTo(-1, 2);
    expect(Math.max(...line.map(([, y]) => y))).toBeLessThan(1e-9);
  });

  it("of a bulge bows by half the chord times the bulge", () => {
    const line = polylineOf([0, 0], [0, 4], -0.3);
    expect(Math.min(...line.map(([x]) => x))).toBeCloseTo(-0.6, 2);
  });

  it("is measured along itself", () => {
    expect(pointAlong([[0, 0], [3, 0], [3, 4]], 5)).toEqual([3, 2]);
    expect(pointAlong([[0, 0], [3, 0]], 9)).toEqual([3, 0]);
  });
});
