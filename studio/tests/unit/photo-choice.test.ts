import { describe, expect, it } from "vitest";
import {
  approached,
  chosenPhotos,
  nearestPhoto,
  strayOf,
  type Vantage,
  type Visitor,
} from "../../src/core/photo-choice.ts";
import type { Vec3 } from "../../src/core/vector.ts";

const DISTANCE = 10;

/** Photos of a street along x, taken every two metres towards a wall at y = 10. */
const STREET: Vantage[] = Array.from({ length: 20 }, (_, k) => ({ eye: [2 * k, 0, 1.7], focus: [2 * k, DISTANCE, 1.7] }));

function at(x: number, y = 0, direction: Vec3 = [0, 1, 0]): Visitor {
  return { eye: [x, y, 1.7], direction };
}

describe("how far astray a visitor is from a photo", () => {
  const [photo] = STREET as [Vantage];

  it("is nothing in its place, looking its way", () => {
    expect(strayOf(at(0), photo)).toBeCloseTo(0, 6);
  });

  it("is the angle of view between them, in shares of 0.75 rad", () => {
    // On the circle about what it shows, looking there: no turn, no zoom.
    const angle = 0.3;
    const visitor = at(DISTANCE * Math.sin(angle), DISTANCE * (1 - Math.cos(angle)), [-Math.sin(angle), Math.cos(angle), 0]);
    expect(strayOf(visitor, photo)).toBeCloseTo(0.3 / 0.75, 6);
  });

  it("is the doublings of the distance, in shares of 1.4 farther off and 2.2 nearer", () => {
    expect(strayOf(at(0, -DISTANCE), photo)).toBeCloseTo(1 / 1.4, 6);
    expect(strayOf(at(0, DISTANCE / 2), photo)).toBeCloseTo(1 / 2.2, 6);
  });

  it("is the turn away, in shares of 0.7 rad", () => {
    expect(strayOf(at(0, 0, [Math.sin(0.35), Math.cos(0.35), 0]), photo)).toBeCloseTo(0.5, 6);
  });

  it("is without end from the other side, and in the very thing it shows", () => {
    expect(strayOf(at(0, 2 * DISTANCE, [0, -1, 0]), photo)).toBe(Infinity);
    expect(strayOf(at(0, DISTANCE), photo)).toBe(Infinity);
  });
});

describe("the photos that fade in", () => {
  it("are the nearest, in order, and the nearest has the whole share", () => {
    for (const x of [0, 3.1, 17.7, 38]) {
      const visitor = at(x);
      const chosen = chosenPhotos(visitor, STREET, new Set(), 3);
      const order = STREET.map((photo, index) => ({ index, off: Math.abs(photo.eye[0] - x) }))
        .sort((a, b) => a.off - b.off)
        .slice(0, 3)
        .map(({ index }) => index);
      expect(chosen.map(({ index }) => index)).toEqual(order);
      expect(chosen[0]).toMatchObject({ share: 1 });
      expect(nearestPhoto(visitor, STREET)).toBe(order[0]);
    }
  });

  it("are shown wholly in their place, and not at all from elsewhere", () => {
    expect(chosenPhotos(at(6), STREET, new Set(), 1)[0]).toMatchObject({ index: 3, level: 1 });
    expect(chosenPhotos(at(6, 0, [0, -1, 0]), STREET, new Set(), 3)).toEqual([]);
    expect(chosenPhotos(at(6, -60), STREET, new Set(), 3)).toEqual([]);
  });

  it("do not flicker on the border between two", () => {
    const pick = (x: number, shown: ReadonlySet<number>): number | undefined =>
      chosenPhotos(at(x), STREET, shown, 1)[0]?.index;
    // Between photos 2 (x = 4) and 3 (x = 6); a walk to and fro about the middle changes nothing.
    let shown = new Set([2]);
    for (const x of [4.9, 5.05, 4.95, 5.05, 4.97]) {
      const now = pick(x, shown);
      expect(now).toBe(2);
      shown = new Set([now ?? -1]);
    }
    expect(pick(5.4, shown)).toBe(3);
    expect(pick(4.97, new Set([3]))).toBe(3);
  });

  it("come without a jump as one walks on", () => {
    let before = new Map<number, number>();
    for (let x = 0; x < 30; x += 0.02) {
      const now = new Map(chosenPhotos(at(x), STREET, new Set(), 20).map(({ index, level }) => [index, level]));
      if (x > 0) {
        for (const index of new Set([...before.keys(), ...now.keys()])) {
          expect(Math.abs((now.get(index) ?? 0) - (before.get(index) ?? 0))).toBeLessThan(0.02);
        }
      }
      before = now;
    }
  });
});

describe("a level on its way", () => {
  it("moves evenly, and stops where it is to be", () => {
    expect(approached(0, 1, 0.15, 0.6)).toBeCloseTo(0.25);
    expect(approached(0.9, 1, 0.15, 0.6)).toBe(1);
    expect(approached(0.1, 0, 1, 0.6)).toBe(0);
    expect(approached(0.5, 0.5, 1, 0.6)).toBe(0.5);
  });
});
