import { describe, expect, it } from "vitest";
import { waits, type Goer } from "../../src/core/giving-way.ts";

const at = (x: number, y: number, turn = 0, length_m = 1, standing = false): Goer => ({
  place: [x, y, 0],
  ahead: [Math.cos(turn), Math.sin(turn), 0],
  length_m,
  standing,
});

describe("animals that meet", () => {
  it("waits for one that is close before it, and that one does not", () => {
    const all = [at(0, 0), at(1, 0)];
    expect(waits(0, all)).toBe(true);
    expect(waits(1, all)).toBe(false);
  });

  it("goes on past what is beside, behind, or far away", () => {
    expect(waits(0, [at(0, 0), at(0.5, 1)])).toBe(false);
    expect(waits(0, [at(0, 0), at(-1, 0)])).toBe(false);
    expect(waits(0, [at(0, 0), at(4, 0)])).toBe(false);
  });

  it("lets the first of two that face each other go", () => {
    const all = [at(0, 0), at(1, 0, Math.PI)];
    expect(waits(0, all)).toBe(false);
    expect(waits(1, all)).toBe(true);
  });

  it("goes on past one that stands at the end of its path", () => {
    expect(waits(0, [at(0, 0), at(1, 0, 0, 1, true)])).toBe(false);
    expect(waits(0, [at(0, 0), at(1, 0, 0, 1, true), at(1.2, 0)])).toBe(true);
  });

  it("lets the first of a ring go", () => {
    const third = (2 * Math.PI) / 3;
    const ring = [0, 1, 2].map((k) => at(0.6 * Math.cos(third * k), 0.6 * Math.sin(third * k), third * k + (5 * Math.PI) / 6));
    expect(ring.map((_, which) => waits(which, ring))).toEqual([false, true, true]);
    const later = [at(10, 0), ...ring];
    expect(later.map((_, which) => waits(which, later))).toEqual([false, false, true, true]);
    // Whoever is before it and in no ring is waited for.
    const ahead = (5 * Math.PI) / 6;
    const blocked = [...ring, at(0.6 + 1.3 * Math.cos(ahead), 1.3 * Math.sin(ahead), Math.PI)];
    expect(waits(0, blocked)).toBe(true);
  });

  it("does not wait for what has not come yet", () => {
    expect(waits(0, [at(0, 0), null])).toBe(false);
    expect(waits(1, [at(0, 0), null])).toBe(false);
  });

  it("one of two crossing paths goes on whatever their lengths", () => {
    const all = [at(0, 0, 0, 3), at(1.2, -0.1, Math.PI / 2, 0.4)];
    expect(all.map((_, which) => waits(which, all)).filter((one) => !one).length).toBeGreaterThan(0);
  });
});
