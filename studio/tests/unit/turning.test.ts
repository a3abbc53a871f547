import { describe, expect, it } from "vitest";
import type { Animal } from "../../src/core/animal.ts";
import { Course } from "../../src/core/course.ts";
import { Curve } from "../../src/core/curve.ts";
import { Pivot, wrapped, yawOf } from "../../src/core/pivot.ts";
import { length, subtract, type Vec3 } from "../../src/core/vector.ts";

const LONG = 0.8;

function walker(path: readonly Vec3[], turns: readonly number[] | null): Animal {
  return {
    id: "goat",
    name: "Goat",
    part: 0,
    root: "root",
    length_m: LONG,
    swims: false,
    clips: [{ name: "walk", seconds: 1, stride_m: 0.5, loops: true }],
    path,
    closed: false,
    turns,
  };
}

/** What it does in so many seconds: where its middle is and where it looks, frame by frame. */
function gone(course: Course, seconds: number): { point: Vec3; yaw: number; turning: boolean }[] {
  return Array.from({ length: Math.round(seconds * 60) }, () => {
    course.advance(0.5, true, 1 / 60);
    const { point, ahead } = course.at(0);
    return { point, yaw: yawOf(ahead), turning: course.isTurning };
  });
}

const flat = (): number => 0;

describe("a turn on the spot", () => {
  it("is made in the corners that the path says, and the way goes on after it", () => {
    const course = new Course(walker([[0, 0, 0], [1.5, 0, 0], [3, 0, 0], [0, 0.5, 0]], [2]), flat);
    const frames = gone(course, 24);
    const turning = frames.filter((frame) => frame.turning);
    expect(turning.length).toBeGreaterThan(30);
    for (const { point } of turning) expect(length(subtract(point, [3, 0, 0]))).toBeLessThan(1e-6);
    const turn = wrapped((turning.at(-1)?.yaw ?? 0) - (turning[0]?.yaw ?? 0));
    expect(Math.abs(turn)).toBeGreaterThan(2.8);
    expect(course.standing).toBe(true);
    const [x, y] = course.at(0.5 * LONG).point;
    expect(Math.hypot(x, y - 0.5)).toBeLessThan(0.02);
  });

  it.each([
    [[-3, 0, 0] as Vec3],
    [[1, -2, 0] as Vec3],
    [[0.5, 1.5, 0] as Vec3],
  ])("comes before it goes to %j behind or beside it, wherever it is led from", (target) => {
    const course = new Course(walker([[0, 0, 0], [6, 0, 0]], []), flat);
    gone(course, 2);
    const before = course.at(0);
    course.leadTo(target);
    expect(length(subtract(course.at(0).point, before.point))).toBeLessThan(0.01);
    const frames = gone(course, 20);
    const spots = frames.filter((frame) => frame.turning).map((frame) => frame.point);
    expect(spots.length).toBeGreaterThan(15);
    for (const spot of spots) expect(length(subtract(spot, spots[0] ?? spot))).toBeLessThan(1e-6);
    const [x, y] = course.at(0).point;
    expect(Math.hypot(x - target[0], y - target[1])).toBeLessThan(0.05);
    // No body jumps: neither its middle nor where it looks.
    for (const [i, frame] of frames.entries()) {
      const last = i > 0 ? frames[i - 1] : undefined;
      if (last === undefined) continue;
      expect(length(subtract(frame.point, last.point))).toBeLessThan(0.02);
      expect(Math.abs(wrapped(frame.yaw - last.yaw))).toBeLessThan(0.06);
    }
  });

  it("is led elsewhere in the midst of a turn", () => {
    const course = new Course(walker([[0, 0, 0], [6, 0, 0]], []), flat);
    gone(course, 1);
    course.leadTo([-3, 0, 0]);
    const middle = gone(course, 1.5).at(-1);
    expect(middle?.turning).toBe(true);
    course.leadTo([0.4, -3, 0]);
    expect(Math.abs(wrapped(yawOf(course.at(0).ahead) - (middle?.yaw ?? 0)))).toBeLessThan(0.15);
    gone(course, 20);
    const [x, y] = course.at(0).point;
    expect(Math.hypot(x - 0.4, y + 3)).toBeLessThan(0.05);
  });

  it("is no way of what has no legs", () => {
    const course = new Course(walker([[0, 0, 0], [6, 0, 0]], null), flat);
    gone(course, 2);
    course.leadTo([-3, 0, 0]);
    expect(gone(course, 10).some((frame) => frame.turning)).toBe(false);
  });

  it("begins and ends as the curves lie, and goes by the shorter way", () => {
    const bent: Vec3[] = Array.from({ length: 20 }, (_, i) => [Math.sin(i / 15), 1 - Math.cos(i / 15), 0]);
    const before = new Curve(bent, false);
    const after = new Curve([bent.at(-1) ?? [0, 0, 0], [-1, 0.6, 0.2]], false);
    const pivot = new Pivot(before, after, LONG);
    expect(Math.abs(pivot.turn)).toBeLessThanOrEqual(Math.PI);
    const begun = pivot.at(-0.3, 0, 0);
    const wanted = before.at(before.length_m - 0.3);
    expect(length(subtract(begun.point, wanted.point))).toBeLessThan(1e-6);
    expect(length(subtract(begun.ahead, wanted.ahead))).toBeLessThan(1e-6);
    const done = pivot.at(0.3, 1, 0);
    expect(length(subtract(done.point, after.at(0.3).point))).toBeLessThan(1e-6);
    expect(length(subtract(done.ahead, after.at(0.3).ahead))).toBeLessThan(1e-6);
  });
});
