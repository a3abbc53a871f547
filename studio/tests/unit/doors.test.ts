import { describe, expect, it } from "vitest";
import { doorwayOf, eased, isWanted, OPENING_S, swung } from "../../src/core/doors.ts";
import { headingOf } from "../../src/core/heading.ts";
import type { Vec3 } from "../../src/core/vector.ts";

/** A leaf 0.9 m wide and 4 cm thick, from the hinge at `at` in a direction (radians from east). */
function leaf(at: Vec3, angle: number): Vec3[] {
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  return [0, 0.9].flatMap((u) =>
    [0, 0.04].flatMap((v) => [0, 2.05].map((z): Vec3 => [at[0] + u * c - v * s, at[1] + u * s + v * c, at[2] + z])),
  );
}

const DOOR = doorwayOf(leaf([2, 5, 0], 0));
const north = headingOf([0, 1, 0]);
const south = headingOf([0, -1, 0]);
const east = headingOf([1, 0, 0]);

describe("the doorway of leaves", () => {
  it.each([0, 0.4, Math.PI / 2, 2.5])("has their middle, direction and width at an angle of %f", (angle) => {
    const { foot, along, halfWidth_m } = doorwayOf(leaf([3, -2, 2.8], angle));
    const [c, s] = [Math.cos(angle), Math.sin(angle)];
    expect(foot[0]).toBeCloseTo(3 + 0.45 * c - 0.02 * s, 2);
    expect(foot[1]).toBeCloseTo(-2 + 0.45 * s + 0.02 * c, 2);
    expect(foot[2]).toBeCloseTo(2.8, 9);
    expect(Math.abs(along[0] * c + along[1] * s)).toBeCloseTo(1, 3);
    expect(halfWidth_m).toBeCloseTo(0.45, 2);
  });
});

describe("a door", () => {
  const wanted = (feet: Vec3, heading = north, isOpen = false): boolean => isWanted(DOOR, { feet, heading }, isOpen);

  it("opens for whoever comes to it from either side", () => {
    expect(wanted([2.45, 3.4, 0])).toBe(true);
    expect(wanted([2.45, 6.6, 0], south)).toBe(true);
    expect(wanted([2.45, 1.5, 0])).toBe(false);
  });

  it("stays closed for whoever looks away or walks past, until he touches it", () => {
    expect(wanted([2.45, 3.4, 0], south)).toBe(false);
    expect(wanted([1.6, 4.0, 0], east)).toBe(false);
    expect(wanted([2.45, 4.5, 0], south)).toBe(true);
  });

  it("stays open for whoever is in it, and closes behind him", () => {
    expect(wanted([2.45, 6.8, 0], north, true)).toBe(true);
    expect(wanted([2.45, 7.8, 0], north, true)).toBe(false);
  });

  it("of another storey does not open", () => {
    expect(wanted([2.45, 4.4, 2.8])).toBe(false);
  });

  it("takes as long to open however the time is cut", () => {
    let share = 0;
    for (let i = 0; i < 40; i += 1) share = swung(share, true, OPENING_S / 80);
    expect(share).toBeCloseTo(0.5, 9);
    expect(swung(share, true, 10)).toBe(1);
    expect(swung(share, false, 10)).toBe(0);
    expect([eased(0), eased(0.5), eased(1)]).toEqual([0, 0.5, 1]);
  });
});
