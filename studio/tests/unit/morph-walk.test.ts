import { describe, expect, it } from "vitest";
import { Fault } from "../../src/core/fault.ts";
import { goneOf, heightToCover, lengthOf, metresTo, type MorphWalk, nearestStation, nearTransitions, placeOn, reachOf, readMorphWalk, walkedOn } from "../../src/core/morph-walk.ts";
import { isInside } from "../../src/core/place.ts";

const station = (id: string, y: number): object => ({
  id,
  picture: `walk/${id}.webp`,
  width_px: 400,
  height_px: 200,
  focal_px: [300, 300],
  centre_px: [200, 100],
  transform: [1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, y, 0, 1],
});
const morph = { start: 0, end: 1, kind: "morph", forth: "walk/a.glb", back: "walk/b.glb", score_db: 20 };
const record = {
  id: "walk",
  name: "Walk",
  speed_m_s: 2,
  keys: [station("a", 0), station("b", 2), station("c", 6)],
  transitions: [morph, { start: 1, end: 2, kind: "cut", forth: null, back: null, score_db: null }],
};
const read = (change: object = {}, inMetres = true): MorphWalk =>
  readMorphWalk({ ...record, ...change }, "walk 1", (fault) => new Fault("place.json", fault, "Mend it."), isInside, inMetres);

describe("a walk from view to view", () => {
  it("is read with the lengths of its transitions", () => {
    const walk = read();
    expect(walk.lengths_m).toEqual([2, 4]);
    expect(walk.transitions.map(({ kind }) => kind)).toEqual(["morph", "cut"]);
  });

  it("says metres only where the scale is known", () => {
    expect(goneOf(read(), 1)).toBe("2.0 m of 6.0 m");
    expect(goneOf(read({}, false), 1)).toBe("2.0 of 6.0 steps");
    expect(lengthOf(read())).toBe("6.0 m");
    expect(lengthOf(read({}, false))).toBe("6.0 steps (scale unknown)");
  });

  it.each([
    [{ keys: [] }, "keys"],
    [{ keys: [{ ...station("a", 0), picture: "../x.webp" }] }, "keys"],
    [{ keys: [{ ...station("a", 0), transform: [1] }] }, "keys"],
    [{ keys: [{ ...station("a", 0), focal_px: [0, 1] }] }, "keys"],
    [{ keys: [{ ...station("a", 0), projection: "cone" }] }, "keys"],
    [{ transitions: [{ ...morph, end: 9 }] }, "transitions"],
    [{ transitions: [{ ...morph, kind: "jump" }] }, "transitions"],
    [{ transitions: [{ ...morph, back: null }] }, "transitions"],
    [{ transitions: [{ ...morph, forth: "/a.glb" }] }, "transitions"],
    [{ speed_m_s: 0 }, "speed_m_s"],
    [{ name: 3 }, "name"],
  ])("refuses %j", (change, field) => {
    expect(() => read(change)).toThrow(new RegExp(`walk 1 has no proper "${field}"`));
  });

  it("knows the transition and the morph parameter of a place, both ends included", () => {
    const walk = read();
    expect(placeOn(walk, -1)).toEqual({ transition: 0, m: 0 });
    expect(placeOn(walk, 1)).toEqual({ transition: 1, m: 0 });
    expect(placeOn(walk, 1.25)).toEqual({ transition: 1, m: 0.25 });
    expect(placeOn(walk, 7)).toEqual({ transition: 1, m: 1 });
    expect(placeOn(read({ keys: [station("a", 0)], transitions: [] }), 0.4)).toEqual({ transition: 0, m: 0 });
  });

  it("covers a canvas with a picture on a plane or a cylinder", () => {
    const [flat, round] = [read(), read({ keys: [{ ...station("a", 0), width_px: 900, projection: "cylinder" }], transitions: [] })];
    const [plane, cylinder] = [flat.stations[0], round.stations[0]];
    if (plane === undefined || cylinder === undefined) throw new Error("no stations");
    expect(reachOf(plane)).toBeCloseTo(Math.atan(2 / 3));
    expect(reachOf(cylinder)).toBeCloseTo(1.5);
    const high = 2 * Math.atan(1 / 3);
    expect(heightToCover(plane, 1)).toBeCloseTo(high);
    expect(heightToCover(plane, 4)).toBeCloseTo(2 * Math.atan(1 / 6));
    expect(heightToCover(cylinder, 3)).toBeCloseTo(high);
  });

  it("goes where one looks at a branch, and back", () => {
    // From b the way goes on to c; another one leads to d, on the left.
    const left = { ...station("d", 2), transform: [1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, -2, 4, 0, 1] };
    const walk = read({
      keys: [station("a", 0), station("b", 2), station("c", 6), left],
      transitions: [morph, { ...morph, start: 1, end: 2 }, { ...morph, start: 1, end: 3 }],
    });
    expect(walkedOn(walk, 0, 3)).toBeCloseTo(1.25);
    const onTheLeft = walkedOn(walk, 0, 3, 0.8);
    expect(placeOn(walk, onTheLeft)).toEqual({ transition: 2, m: expect.closeTo(1 / Math.hypot(2, 2)) as number });
    expect(walkedOn(walk, onTheLeft, -2)).toBeCloseTo(0.5);
    // The ends of both ways are no way on.
    expect(placeOn(walk, walkedOn(walk, 1.5, 99)).transition).toBe(1);
    expect(placeOn(walk, walkedOn(walk, 2.5, 99))).toEqual({ transition: 2, m: 1 });
    expect(nearTransitions(walk, 0.5)).toEqual([0, 1, 2]);
    expect(placeOn(walk, nearestStation(walk, 1.7)).transition).toBe(1);
    expect(nearestStation(walk, 1.3)).toBe(1);
  });

  it("walks metres across transitions of different lengths, and stops at both ends", () => {
    const walk = read();
    expect(walkedOn(walk, 0, 1)).toBeCloseTo(0.5);
    expect(walkedOn(walk, 0.5, 2)).toBeCloseTo(1.25);
    expect(walkedOn(walk, 1.25, -2)).toBeCloseTo(0.5);
    expect(walkedOn(walk, 0.5, -9)).toBe(0);
    expect(walkedOn(walk, 0.5, 99)).toBe(2);
    for (let metres = 0; metres <= 6; metres += 0.37) expect(metresTo(walk, walkedOn(walk, 0, metres))).toBeCloseTo(metres);
  });

  it("asks for the transition that one is in, one ahead and one behind", () => {
    const keys = [0, 1, 2, 3, 4].map((n) => station(`${n}`, n));
    const walk = read({ keys, transitions: [0, 1, 2, 3].map((n) => ({ ...morph, start: n, end: n + 1 })) });
    expect(nearTransitions(walk, 0)).toEqual([0, 1]);
    expect(nearTransitions(walk, 2.5)).toEqual([2, 3, 1]);
    expect(nearTransitions(walk, 4)).toEqual([3, 2]);
  });
});
