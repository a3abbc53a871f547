import { describe, expect, it } from "vitest";
import { lookAlong } from "../../src/core/long-view.ts";
import { boxOfPoints } from "../../src/core/framing.ts";
import type { Vec3 } from "../../src/core/vector.ts";

const START = { eye: [190, -33, 1.7] as Vec3, target: [203, 0, 9] as Vec3 };

describe("a long street", () => {
  it("is seen by a stretch of four widths around what the visitor sees, from the visitor's side", () => {
    const look = lookAlong({ min: [0, 0, 0], max: [720, 12, 20] }, START);
    const { min, max } = boxOfPoints(look?.corners ?? []);
    expect(min).toEqual([203 - 80, 0, 0]);
    expect(max).toEqual([203 + 80, 12, 20]);
    const [east, north, up] = look?.direction ?? [0, 0, 0];
    expect(Math.hypot(east, north, up)).toBeCloseTo(1, 9);
    expect(east).toBeGreaterThan(0); // on along the longer rest
    expect(north).toBeGreaterThan(0); // the visitor stands south of it
    expect(up).toBeLessThan(0);
  });

  it("is seen within its ends, and where it goes north", () => {
    const start = { eye: [40, 590, 2] as Vec3, target: [6, 598, 4] as Vec3 };
    const look = lookAlong({ min: [0, 0, 0], max: [20, 600, 10] }, start);
    const { min, max } = boxOfPoints(look?.corners ?? []);
    expect([min[1], max[1]]).toEqual([520, 600]);
    const [east, north] = look?.direction ?? [0, 0, 0];
    expect(east).toBeLessThan(0); // the visitor stands east of it
    expect(north).toBeLessThan(0); // the rest lies south
  });

  it("is none where a place is no longer than wide and high", () => {
    expect(lookAlong({ min: [0, 0, 0], max: [100, 40, 20] }, START)).toBeNull();
    expect(lookAlong({ min: [0, 0, 0], max: [20, 2, 20] }, START)).toBeNull();
    expect(lookAlong({ min: [0, 0, 0], max: [0, 0, 0] }, START)).toBeNull();
  });
});
