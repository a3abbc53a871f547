import { describe, expect, it } from "vitest";
import { beginsWithAnimal, lookAtAnimals, standsOf, type Sight, together } from "../../src/core/animal-view.ts";
import { boxOfPoints } from "../../src/core/framing.ts";
import { type Place, readPlace } from "../../src/core/place.ts";
import { dot, length, type Vec3 } from "../../src/core/vector.ts";

const START = { eye: [3, -6, 2] as Vec3, target: [3, 0, 0] as Vec3 };
const CAT = {
  id: "cat",
  name: "Cat",
  part: "cat",
  length: 0.5,
  clips: [{ name: "walk", seconds: 1, stride: 0.4, loops: true }],
  path: [[2, 0, 0], [3, 0, 0], [4, 0, 0], [3, 1, 0]],
  closed: true,
};

function place(size: number, more: Record<string, unknown> = {}): Place {
  const part = (id: string, max: number[]) => ({ id, name: id, model: `${id}.glb`, arrangement: "single", bounds: { min: [0, 0, 0], max } });
  const parts = [part("house", [size, size, size]), part("cat", [0.5, 0.2, 0.3])];
  return readPlace(JSON.stringify({ schema: "veduta/place", version: 1, parts, start: START, animals: [CAT], ...more }), "place.json");
}

describe("the first look at an animal", () => {
  const stand = { at: [3, 0, 0] as Vec3, ahead: [1, 0, 0] as Vec3, length_m: 0.5 };
  const free: Sight = () => Infinity;

  it("is wanted where a view of all would show a dot, and nowhere else", () => {
    expect(beginsWithAnimal(place(20))).toBe(true);
    expect(beginsWithAnimal(place(1, { animals: [{ ...CAT, length: 2 }] }))).toBe(false);
    expect(beginsWithAnimal(place(20, { animals: [] }))).toBe(false);
    expect(beginsWithAnimal(place(20, { tileset: "tileset.json" }))).toBe(false);
  });

  it("knows where the animal is at first", () => {
    expect(standsOf(place(20))).toMatchObject([{ at: [2, 0, 0], length_m: 0.5 }]);
    expect(standsOf(place(20, { animals: [] }))).toEqual([]);
  });

  it("is as the start looks, from above, and shows a few lengths around the animal", () => {
    const { corners, direction } = lookAtAnimals([stand], START, free);
    expect(length(direction)).toBeCloseTo(1, 9);
    expect(direction[0]).toBeCloseTo(0, 9);
    expect(direction[1]).toBeGreaterThan(0.9);
    expect(direction[2]).toBeLessThan(-0.25);
    const { min, max } = boxOfPoints(corners);
    expect([min[0], max[0]]).toEqual([3 - 0.75, 3 + 0.75]);
    expect(max[2]).toBeCloseTo(0.4, 9);
  });

  it("goes beside that as little as it takes for nothing to hide the animal", () => {
    // A wall hides what is looked at towards the north within 40 degrees.
    const wall: Sight = (_, along) => (-along[1] / Math.hypot(along[0], along[1]) > Math.cos((40 * Math.PI) / 180) ? 1 : Infinity);
    const { direction } = lookAtAnimals([stand], START, wall);
    expect((Math.acos(dot(direction, [0, 1, 0]) / Math.hypot(direction[0], direction[1])) * 180) / Math.PI).toBeCloseTo(60, 6);
  });

  it("looks from higher where something is in the way all around", () => {
    const yard: Sight = (_, along) => (along[2] < 0.5 ? 1 : Infinity);
    const { direction } = lookAtAnimals([stand], START, yard);
    expect(direction[2]).toBeLessThan(-0.5);
    expect(direction[0]).toBeCloseTo(0, 9);
  });

  it("looks as the start does where the animal is hidden from everywhere, and where the start says no way", () => {
    expect(lookAtAnimals([stand], START, () => 0).direction).toEqual(lookAtAnimals([stand], START, free).direction);
    const down = { eye: [3, 0, 9] as Vec3, target: [3, 0, 0] as Vec3 };
    const { direction } = lookAtAnimals([stand], down, free);
    expect(direction[0]).toBeCloseTo(0, 9);
    expect(direction[1]).toBeGreaterThan(0.7);
  });

  it("looks down as the start does", () => {
    const { direction } = lookAtAnimals([stand], { eye: [3, -6, 3], target: [3, 0, 0] }, free);
    expect(direction[2] / direction[1]).toBeCloseTo(-0.5, 9);
  });

  it("shows those that are together, and not one that is far away", () => {
    const other = { at: [5, 1, 0] as Vec3, ahead: [1, 0, 0] as Vec3, length_m: 0.5 };
    const far = { ...other, at: [40, 0, 0] as Vec3 };
    expect(together([stand, other, far])).toEqual([stand, other]);
    expect(together([])).toEqual([]);
    const { min, max } = boxOfPoints(lookAtAnimals([stand, other], START, free).corners);
    expect([min[0], max[0], min[1], max[1]]).toEqual([2.25, 5.75, -0.75, 1.75]);
  });

  it("shows the first alone where another is hidden from everywhere", () => {
    const other = { at: [5, 1, 0] as Vec3, ahead: [1, 0, 0] as Vec3, length_m: 0.5 };
    const hides: Sight = ([x]) => (x > 4 ? 0 : Infinity);
    const { min, max } = boxOfPoints(lookAtAnimals([stand, other], START, hides).corners);
    expect([min[0], max[0]]).toEqual([2.25, 3.75]);
  });
});
