import { describe, expect, it } from "vitest";
import { headingOf } from "../../src/core/heading.ts";
import { DEFAULT_WALK, INDOOR_BODY, standing, step } from "../../src/core/walking.ts";
import type { Vec3 } from "../../src/core/vector.ts";
import { Solid } from "../../src/three/solid.ts";

/** Two triangles per quad; the quad's number is its row. */
function solidOf(quads: readonly (readonly [Vec3, Vec3, Vec3, Vec3])[]): Solid {
  const positions = quads.flatMap(([a, b, c, d]) => [a, b, c, a, c, d].flat());
  const rowOfFace = Uint32Array.from({ length: 2 * quads.length }, (_, face) => Math.floor(face / 2));
  return new Solid({
    positions: new Float32Array(positions),
    partOfFace: new Uint32Array(rowOfFace.length),
    rowOfFace,
    firstBoxFace: rowOfFace.length,
    instances: [],
  });
}

const WALL: readonly [Vec3, Vec3, Vec3, Vec3] = [[-5, 2, 0], [5, 2, 0], [5, 2, 4], [-5, 2, 4]];
const SHELF: readonly [Vec3, Vec3, Vec3, Vec3] = [[-5, -5, 1], [5, -5, 1], [5, 5, 1], [-5, 5, 1]];
const { body } = DEFAULT_WALK;

describe("pushing out", () => {
  it("does nothing at a distance", () => {
    expect(solidOf([WALL]).pushOut([0, 1, 0], body)).toBeNull();
  });

  it("moves off a wall by the depth, along its normal", () => {
    const push = solidOf([WALL]).pushOut([0, 1.9, 0], body);
    expect(push?.[0]).toBeCloseTo(0, 6);
    expect(push?.[1]).toBeCloseTo(-0.2, 6);
    expect(push?.[2]).toBeCloseTo(0, 6);
  });

  it("rounds an edge: the distance to it becomes the radius", () => {
    const feet: Vec3 = [5.1, 1.8, 0];
    const push = solidOf([WALL]).pushOut(feet, body) ?? [0, 0, 0];
    expect(Math.hypot(feet[0] + push[0] - 5, feet[1] + push[1] - 2)).toBeCloseTo(body.radius_m, 6);
  });

  it("carries a body that falls onto a floor", () => {
    const floor = solidOf([SHELF]);
    let walker = standing([0, 0, 4], headingOf([0, 1, 0]), DEFAULT_WALK);
    for (let i = 0; i < 200; i += 1) {
      walker = step(walker, { forward: 0, right: 0, run: false }, 1 / 60, floor, DEFAULT_WALK);
    }
    expect(walker.feet[2]).toBeCloseTo(1, 3);
    expect(walker.grounded).toBe(true);
  });

  it.each([1 / 60, 0.1])("is not thrown aside by the edge of a floor at the wall's foot, steps of %f s", (dt) => {
    const floor: readonly [Vec3, Vec3, Vec3, Vec3] = [[-5, 2, 0], [5, 2, 0], [5, 9, 0], [-5, 9, 0]];
    let walker = standing([0.3, 0, 1.7], headingOf([0, 1, 0]), DEFAULT_WALK);
    for (let i = 0; i < 200; i += 1) {
      walker = step(walker, { forward: 1, right: 0, run: false }, dt, solidOf([WALL, floor]), DEFAULT_WALK);
    }
    expect(walker.feet[0]).toBeCloseTo(0.3, 6);
    expect(walker.feet[1]).toBeCloseTo(2 - body.radius_m, 4);
    expect(walker.feet[2]).toBe(0);
  });

  it("stops a runner at a wall of triangles", () => {
    let walker = standing([0, 0, 1.7], headingOf([0, 1, 0]), DEFAULT_WALK);
    for (let i = 0; i < 60; i += 1) {
      walker = step(walker, { forward: 1, right: 0, run: true }, 0.1, solidOf([WALL]), DEFAULT_WALK);
    }
    expect(walker.feet[1]).toBeCloseTo(2 - body.radius_m, 3);
    expect(walker.blocked).toBe(true);
  });
});

describe("the first hit", () => {
  const behind: readonly [Vec3, Vec3, Vec3, Vec3] = [[-5, 6, 0], [5, 6, 0], [5, 6, 4], [-5, 6, 4]];
  // Enough quads that the tree reorders them: rows must still be those of the soup.
  const stripes = Array.from({ length: 40 }, (_, i): readonly [Vec3, Vec3, Vec3, Vec3] => [
    [i, 10, 0], [i + 1, 10, 0], [i + 1, 10, 1], [i, 10, 1],
  ]);

  it("is the nearest visible surface", () => {
    const solid = solidOf([behind, WALL]);
    const all = solid.firstHit([0, 0, 1], [0, 1, 0], () => true);
    expect(all?.feature.row).toBe(1);
    expect(all?.distance_m).toBeCloseTo(2, 6);
    const without = solid.firstHit([0, 0, 1], [0, 1, 0], ({ row }) => row !== 1);
    expect(without?.feature.row).toBe(0);
    expect(without?.point[1]).toBeCloseTo(6, 6);
  });

  it("names the row of each stripe", () => {
    const solid = solidOf(stripes);
    for (let i = 0; i < 40; i += 1) {
      expect(solid.firstHit([i + 0.5, 0, 0.5], [0, 1, 0], () => true)?.feature.row).toBe(i);
    }
  });

  it("is nothing where there is nothing", () => {
    expect(solidOf([WALL]).firstHit([0, 0, 1], [0, -1, 0], () => true)).toBeNull();
  });
});

describe("a stair", () => {
  const [RISER, TREAD, STEPS] = [0.18, 0.27, 12];
  const WIDTH = 0.5;
  /** It rises to the north from y = 1, between two walls; a landing is on top. */
  const quads: (readonly [Vec3, Vec3, Vec3, Vec3])[] = Array.from({ length: STEPS }, (_, i) => i).flatMap((i) => {
    const [y, z] = [1 + i * TREAD, i * RISER];
    const end = i === STEPS - 1 ? y + 4 : y + TREAD;
    const at = (py: number, pz: number): readonly [Vec3, Vec3] => [[-WIDTH, py, pz], [WIDTH, py, pz]];
    const [a, b] = at(y, z);
    const [d, c] = at(y, z + RISER);
    const [f, e] = at(end, z + RISER);
    return [[a, b, c, d] as const, [d, c, e, f] as const];
  });
  const side = (x: number): readonly [Vec3, Vec3, Vec3, Vec3] => [[x, -3, 0], [x, 12, 0], [x, 12, 6], [x, -3, 6]];
  const stair = solidOf([...quads, side(-WIDTH), side(WIDTH)]);
  const top = STEPS * RISER;

  it.each([
    ["in the middle", 1 / 60, 0, [0, 1, 0] as Vec3],
    ["along its wall, slowly drawn", 0.1, 0.2, [0.5, 1, 0] as Vec3],
  ])("is climbed %s, and walked down again", (_, dt, x, direction) => {
    const options = { ...DEFAULT_WALK, body: INDOOR_BODY };
    let walker = standing([x, 0, INDOOR_BODY.eye_m], headingOf(direction), options);
    const go = (forward: number, seconds: number): void => {
      for (let t = 0; t < seconds; t += dt) walker = step(walker, { forward, right: 0, run: false }, dt, stair, options);
    };
    go(1, 3.4);
    expect(walker.feet[1]).toBeGreaterThan(1 + STEPS * TREAD);
    expect(walker.feet[2]).toBeCloseTo(top, 2);
    expect(walker.grounded).toBe(true);
    go(-1, 4);
    expect(walker.feet[1]).toBeLessThan(0.5);
    expect(walker.feet[2]).toBeCloseTo(0, 2);
  });

  it("with steps as high as a table is none", () => {
    const table: readonly [Vec3, Vec3, Vec3, Vec3] = [[-5, 1, 0], [5, 1, 0], [5, 1, 0.5], [-5, 1, 0.5]];
    const top: readonly [Vec3, Vec3, Vec3, Vec3] = [[-5, 1, 0.5], [5, 1, 0.5], [5, 9, 0.5], [-5, 9, 0.5]];
    let walker = standing([0, 0, 1.7], headingOf([0, 1, 0]), DEFAULT_WALK);
    for (let i = 0; i < 120; i += 1) walker = step(walker, { forward: 1, right: 0, run: true }, 1 / 60, solidOf([table, top]), DEFAULT_WALK);
    expect(walker.feet[2]).toBeCloseTo(0, 6);
    expect(walker.feet[1]).toBeLessThan(1);
  });
});
