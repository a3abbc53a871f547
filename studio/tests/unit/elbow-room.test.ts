import { describe, expect, it } from "vitest";
import { withElbowRoom } from "../../src/core/elbow-room.ts";
import type { Vec3 } from "../../src/core/vector.ts";
import { DEFAULT_WALK, type Obstacles } from "../../src/core/walking.ts";

const { body } = DEFAULT_WALK;

/** Endless walls along y at these x; each pushes whoever overlaps it to the side where he stands. */
const walls = (...xs: readonly number[]): Obstacles => ({
  pushOut: (feet, { radius_m }) => {
    let x = feet[0];
    for (const wall of xs) {
      const apart = x - wall;
      if (Math.abs(apart) < radius_m) x = wall + (apart < 0 ? -radius_m : radius_m);
    }
    return x === feet[0] ? null : [x - feet[0], 0, 0];
  },
});
const from: Vec3 = [0.5, 2, 0];

describe("room where a walk begins", () => {
  it("moves off a wall that is half a metre away", () => {
    expect(withElbowRoom(from, walls(0), body)).toEqual([1.5, 2, 0]);
  });

  it("leaves whoever has room where he is", () => {
    expect(withElbowRoom(from, walls(-1.5, 9), body)).toEqual(from);
  });

  it("stays on this side of what stands in the way", () => {
    const [x] = withElbowRoom(from, walls(0, 1.2), body);
    expect(x).toBeGreaterThan(body.radius_m - 1e-9);
    expect(x).toBeLessThan(1.2 - body.radius_m + 1e-9);
  });

  it("does not step off a terrace", () => {
    const terrace = (end: number): Obstacles => ({
      pushOut: ([x, y, z], sized) => {
        if (x < end && z < 3) return [0, 0, 3 - z];
        return walls(0).pushOut([x, y, z], sized);
      },
    });
    expect(withElbowRoom([0.5, 2, 3], terrace(1), body)).toEqual([0.5, 2, 3]);
    expect(withElbowRoom([0.5, 2, 3], terrace(2), body)).toEqual([1.5, 2, 3]);
  });

  it("moves on a hill, whose ground is no obstacle", () => {
    const hill: Obstacles = { ...walls(0), groundAt: () => 3 };
    expect(withElbowRoom([0.5, 2, 3], hill, body)).toEqual([1.5, 2, 3]);
  });

  it("stays where nothing helps", () => {
    const stuck: Obstacles = { pushOut: () => [0.1, 0, 0] };
    expect(withElbowRoom(from, stuck, body)).toEqual(from);
  });
});
