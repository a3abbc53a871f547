import { describe, expect, it } from "vitest";
import { readAnimal } from "../../src/core/animal.ts";
import { Course } from "../../src/core/course.ts";
import { type Free, isClear, type Spot, wayRound } from "../../src/core/detour.ts";
import { Fault } from "../../src/core/fault.ts";

/** A wall along x = 0, 0.2 m thick, from y = -4 to where it ends. */
const wall = (end: number): Free => (x, y) => Math.abs(x) > 0.1 || y < -4 || y > end;
const long = (way: readonly Spot[], from: Spot): number =>
  way.reduce((sum, [x, y], i) => sum + Math.hypot(x - (way[i - 1] ?? from)[0], y - (way[i - 1] ?? from)[1]), 0);

describe("a way round", () => {
  it("is straight where nothing is in the way", () => {
    expect(wayRound([-2, 0], [-3, 5], wall(2), 0.2)).toEqual([[-3, 5]]);
  });

  it("goes by the nearer end, no longer than it must, and touches nothing", () => {
    const from: Spot = [-2, 0];
    const way = wayRound(from, [2, 0], wall(2), 0.2) ?? [];
    expect(way.at(-1)).toEqual([2, 0]);
    const least = 2 * Math.hypot(2, 2);
    expect(long(way, from)).toBeGreaterThan(least);
    expect(long(way, from)).toBeLessThan(1.15 * least);
    expect(way.every((spot, i) => isClear(way[i - 1] ?? from, spot, wall(2), 0.1))).toBe(true);
  });

  it("is none to where something stands, nor out of a closed room", () => {
    expect(wayRound([-2, 0], [0, 0], wall(2), 0.2)).toBeNull();
    const room: Free = (x, y) => Math.abs(Math.max(Math.abs(x), Math.abs(y)) - 2) > 0.15;
    expect(wayRound([0, 0], [5, 0], room, 0.2)).toBeNull();
  });

  it("is none from within something", () => {
    const free: Free = (x, y) => Math.hypot(x, y) > 0.5;
    expect(wayRound([0.1, 0], [3, 0], free, 0.25)).toBeNull();
  });
});

describe("an animal that is led round something", () => {
  const record = {
    id: "cat", name: "Cat", part: "cat", root: "root", length: 0.4, swims: false,
    clips: [{ name: "walk", seconds: 0.5, stride: 0.25, loops: true }],
    path: [[-4, 0, 0], [-2, 0, 0]], closed: false,
  };
  const animal = (turns: readonly number[] | null) =>
    readAnimal({ ...record, ...(turns === null ? {} : { turns }) }, "animal 1", [{ id: "cat" }], (fault) => new Fault("place.json", fault, ""));

  it.each([[[]], [null]])("comes there and never into it, with legs (%j) and without", (turns: readonly number[] | null) => {
    const course = new Course(animal(turns), () => null);
    const free = wall(2);
    const wide: Free = (x, y) => Math.abs(x) > 0.5 || y < -4.4 || y > 2.4;
    for (let i = 0; i < 20; i += 1) course.advance(0.5, true, 0.05);
    const { point } = course.at(0);
    const way = wayRound([point[0], point[1]], [2, 0], wide, 0.1) ?? [];
    course.leadTo([2, 0, 0], way.slice(0, -1).map(([x, y]) => [x, y, 0] as const));
    let blocked = 0;
    for (let i = 0; i < 900; i += 1) {
      course.advance(0.5, true, 0.05);
      const [x, y] = course.at(0).point;
      if (!free(x, y)) blocked += 1;
    }
    expect(blocked).toBe(0);
    const [x, y] = course.at(0).point;
    expect(Math.hypot(x - 2, y)).toBeLessThan(0.05);
  });
});
