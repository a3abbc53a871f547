import { describe, expect, it } from "vitest";
import type { Shot } from "../../src/core/place.ts";
import { cornersOfProxy, focusOf, proxyOf } from "../../src/core/proxy.ts";

/** At the origin, looking along y with z up: right is x. */
const SHOT: Shot = {
  id: "a",
  name: "a.jpg",
  picture: "a.jpg",
  width_px: 600,
  height_px: 400,
  focal_px: [500, 500],
  centre_px: [320, 190],
  worldFromCamera: [1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1],
};

/** The same numbers in every run. */
function random(): () => number {
  let state = 7;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
}

/** Points of the plane y = 8 + 0.4 x, and a share of others anywhere nearer and farther. */
function street(astray: number): Float32Array {
  const draw = random();
  const points: number[] = [];
  for (let i = 0; i < 1500; i += 1) {
    const [x, z] = [12 * draw() - 6, 8 * draw() - 4];
    const wall = 8 + 0.4 * x;
    points.push(x, draw() < astray ? 2 + 20 * draw() : wall + 0.02 * (draw() - 0.5), z);
  }
  return new Float32Array(points);
}

describe("the plane of what a photo shows", () => {
  it.each([[0, 0.01], [0.25, 0.25]])("is found with a share of %s astray", (astray, within) => {
    const corners = cornersOfProxy(SHOT, proxyOf(SHOT, street(astray), () => 99));
    for (const [x, y] of corners) expect(Math.abs(y - 8 - 0.4 * x)).toBeLessThan(within);
    const [x, y] = focusOf(SHOT, proxyOf(SHOT, street(astray), () => 99));
    expect(Math.abs(y - 8 - 0.4 * x)).toBeLessThan(within);
  });

  it("lies before the corners of the picture", () => {
    const [upperLeft, , , lowerRight] = cornersOfProxy(SHOT, { slopes: [0, 0], inverse: 1 / 5 });
    expect(upperLeft).toEqual([-3.2, 5, 1.9]);
    expect(lowerRight?.map((v) => Number(v.toFixed(9)))).toEqual([2.8, 5, -2.1]);
  });

  it("is parallel to the picture at the median depth where the points tell no plane", () => {
    // All on one line of sight but for their depth, and so many that a tilt is asked for.
    const points = Array.from({ length: 31 }, (_, k) => [0, 4 + 0.1 * k, 0]).flat();
    const proxy = proxyOf(SHOT, new Float32Array(points), () => 99);
    expect(proxy.slopes).toEqual([0, 0]);
    expect(1 / proxy.inverse).toBeCloseTo(5.5, 6);
  });

  it("is where it is told to be when there are too few points", () => {
    const behind = new Float32Array(Array.from({ length: 60 }, () => [0, -5, 0]).flat());
    expect(proxyOf(SHOT, behind, () => 20)).toEqual({ slopes: [0, 0], inverse: 0.05 });
  });

  it("does not follow the ground to the horizon", () => {
    const draw = random();
    const ground = Array.from({ length: 900 }, () => [20 * draw() - 10, 2 + 60 * draw() ** 2, -1.2]).flat();
    const depths = cornersOfProxy(SHOT, proxyOf(SHOT, new Float32Array(ground), () => 99)).map(([, y]) => y);
    for (const depth of depths) expect(depth).toBeGreaterThan(0);
    expect(Math.max(...depths) / Math.min(...depths)).toBeLessThanOrEqual(9);
  });
});
