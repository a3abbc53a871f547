import { describe, expect, it } from "vitest";
import { boxOfPoints, cornersOf, framePoints, homeDirection, NO_INSETS, shiftOf } from "../../src/core/framing.ts";
import { drawnFromModel, drawnFromWorld, worldFromDrawn, worldPoint } from "../../src/core/frames.ts";
import { directionOf, headingOf, turned } from "../../src/core/heading.ts";
import { photoWindow } from "../../src/core/photo-window.ts";
import { dot, length, scale, subtract, type Vec3 } from "../../src/core/vector.ts";

describe("frames", () => {
  const turnedPart = [0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1];

  it("go there and back", () => {
    expect(worldFromDrawn(drawnFromWorld([1, 2, 3]))).toEqual([1, 2, 3]);
    expect(drawnFromWorld([0, 0, 1])[1]).toBe(1);
  });

  it.each<{ p: Vec3 }>([{ p: [0, 0, 0] }, { p: [1, 0, 0] }, { p: [0, 1, 0] }, { p: [1, 2, 3] }])("place a model's point $p as the world does", ({ p }) => {
    // Model coordinates are the part's in glTF axes.
    const drawn = worldPoint(drawnFromModel(turnedPart), drawnFromWorld(p));
    const expected = drawnFromWorld(worldPoint(turnedPart, p));
    for (const axis of [0, 1, 2] as const) expect(drawn[axis]).toBeCloseTo(expected[axis], 12);
  });
});

describe("headings", () => {
  it.each<{ d: Vec3 }>([{ d: [0, 1, 0] }, { d: [1, 0, 0] }, { d: [-1, -1, 0.5] }, { d: [0.3, -0.2, -0.6] }])("of $d point that way", ({ d }) => {
    const again = directionOf(headingOf(d));
    for (const axis of [0, 1, 2] as const) expect(again[axis]).toBeCloseTo(d[axis] / length(d), 9);
  });

  it("turn left anticlockwise and stop short of straight up", () => {
    expect(directionOf(turned(headingOf([0, 1, 0]), Math.PI / 2, 0))[0]).toBeCloseTo(-1, 9);
    expect(turned({ yaw: 0, pitch: 0 }, 0, 9).pitch).toBeLessThan(Math.PI / 2);
  });
});

describe("framing", () => {
  const box = { min: [0, 0, 0] as Vec3, max: [12, 8, 15] as Vec3 };
  const direction = scale([0.5, 0.86, -0.12], 1 / length([0.5, 0.86, -0.12]));
  const insets = { left: 0.25, right: 0, top: 0.05, bottom: 0.15 };

  it("looks at a house from near the level, and down on a town", () => {
    const down = (size: Vec3): number => {
      const direction = homeDirection({ min: [0, 0, 0], max: size });
      expect(length(direction)).toBeCloseTo(1);
      return Math.asin(-direction[2]) * (180 / Math.PI);
    };
    expect(down([14, 10, 20])).toBeCloseTo(6.88, 1); // atan(0.12 / hypot(0.5, 0.86))
    expect(down([200, 12, 20])).toBeCloseTo(6.88, 1); // a row of houses
    expect(down([400, 300, 20])).toBeCloseTo(37.0, 1); // atan(0.75 / hypot(0.5, 0.86))
    expect(down([400, 300, 40])).toBeLessThan(down([400, 300, 30]));
  });

  it("looks to where the photos do, as much from above as else", () => {
    const [usual, direction] = [homeDirection(box), homeDirection(box, [-0.6, 0.8, 0])];
    expect(length(direction)).toBeCloseTo(1);
    expect(direction[0] / direction[1]).toBeCloseTo(-0.75);
    expect(direction[2]).toBeCloseTo(usual[2], 2);
  });

  it.each([16 / 9, 1, 9 / 19])("has all corners in the free part and one near its edge, aspect %f", (aspect) => {
    for (const free of [NO_INSETS, insets]) {
      const { eye } = framePoints(cornersOf(box), direction, 0.6, aspect, free);
      const right: Vec3 = scale([direction[1], -direction[0], 0], 1 / Math.hypot(direction[0], direction[1]));
      const up: Vec3 = [
        right[1] * direction[2] - right[2] * direction[1],
        right[2] * direction[0] - right[0] * direction[2],
        right[0] * direction[1] - right[1] * direction[0],
      ];
      const tan = Math.tan(0.3);
      const used = cornersOf(box).map((corner) => {
        const arm = subtract(corner, eye);
        const depth = dot(arm, direction);
        const x = Math.abs(dot(arm, right)) / depth / (tan * aspect * (1 - free.left - free.right));
        const y = Math.abs(dot(arm, up)) / depth / (tan * (1 - free.top - free.bottom));
        return Math.max(x, y);
      });
      expect(Math.max(...used)).toBeLessThan(1);
      expect(Math.max(...used)).toBeGreaterThan(0.85);
    }
  });

  it("is as near as can be, with the same room on both sides", () => {
    const points: Vec3[] = [[0, 0, 0], [90, 10, 4], [60, 160, 9], [-20, 120, 6], [30, 70, 22]];
    const flat = homeDirection(boxOfPoints(points));
    const right: Vec3 = scale([flat[1], -flat[0], 0], 1 / Math.hypot(flat[0], flat[1]));
    const up: Vec3 = [right[1] * flat[2], -right[0] * flat[2], right[0] * flat[1] - right[1] * flat[0]];
    const fit = Math.tan(0.3) * 0.93;
    // The shares of the free part at which the outermost points lie, along both axes of the picture.
    const ends = (eye: Vec3, aspect: number): [number, number][] =>
      ([[right, fit * aspect], [up, fit]] as const).map(([axis, tan]) => {
        const at = points.map((p) => dot(subtract(p, eye), axis) / dot(subtract(p, eye), flat) / tan);
        return [Math.min(...at), Math.max(...at)];
      });
    for (const aspect of [2, 1, 0.5]) {
      const { eye, target } = framePoints(points, flat, 0.6, aspect);
      const shares = ends(eye, aspect);
      for (const share of shares.flat()) expect(Math.abs(share)).toBeLessThan(1 + 1e-9);
      // Along one axis both ends are at the border: no nearer eye has all points in the picture.
      const widest = Math.max(...shares.map(([low, high]) => Math.min(-low, high)));
      expect(widest).toBeCloseTo(1, 9);
      expect(dot(subtract(target, eye), right)).toBeCloseTo(0, 9);
      expect(dot(subtract(target, eye), up)).toBeCloseTo(0, 9);
      expect(target[2]).toBeGreaterThanOrEqual(-1e-9);
    }
  });

  it("shifts the picture's middle to the free part's", () => {
    expect(shiftOf(insets)[0]).toBeCloseTo(0.125, 12);
    expect(shiftOf(insets)[1]).toBeCloseTo(-0.05, 12);
  });
});

describe("the part of the photo that is shown", () => {
  it.each([[[10, 10, 40, 60]], [[0, 0, 500, 20]], [[480, 560, 20, 20]], [[0, 0, 500, 600]]] as const)(
    "holds the rectangle %j in the wanted aspect",
    (rectangle) => {
      const view = photoWindow(rectangle, 500, 600, 1.5);
      const [x, y, w, h] = rectangle;
      expect(view.width / view.height).toBeCloseTo(1.5, 9);
      expect(view.x).toBeLessThanOrEqual(x + 1e-9);
      expect(view.y).toBeLessThanOrEqual(y + 1e-9);
      expect(view.x + view.width).toBeGreaterThanOrEqual(x + w - 1e-9);
      expect(view.y + view.height).toBeGreaterThanOrEqual(y + h - 1e-9);
    },
  );

  it("stays in the photo where it can", () => {
    const view = photoWindow([0, 0, 20, 20], 500, 600, 1.5);
    expect([view.x, view.y]).toEqual([0, 0]);
  });
});
