import { describe, expect, it } from "vitest";
import { rowAfter, rowsSeen, scrolledTo } from "../../src/core/rows.ts";

const [COUNT, ROW, HEIGHT] = [300, 50, 220];

describe("a long list", () => {
  it("draws every row that is seen, at any scrolling, and few others", () => {
    for (let top = 0; top <= COUNT * ROW - HEIGHT; top += 37) {
      const { first, end } = rowsSeen(COUNT, ROW, top, HEIGHT);
      for (let row = 0; row < COUNT; row += 1) {
        const isSeen = (row + 1) * ROW > top && row * ROW < top + HEIGHT;
        if (isSeen) expect(row >= first && row < end).toBe(true);
      }
      expect(end - first).toBeLessThanOrEqual(Math.ceil(HEIGHT / ROW) + 9);
    }
  });

  it("draws nothing of an empty list", () => {
    expect(rowsSeen(0, ROW, 0, HEIGHT)).toEqual({ first: 0, end: 0 });
  });

  it("scrolls no further than it has to", () => {
    expect(scrolledTo(4, ROW, 100, HEIGHT)).toBe(100);
    expect(scrolledTo(1, ROW, 100, HEIGHT)).toBe(50);
    expect(scrolledTo(9, ROW, 100, HEIGHT)).toBe(280);
  });

  it("is walked by keys, and ends where it ends", () => {
    expect(rowAfter("ArrowDown", 0, COUNT, 4)).toBe(1);
    expect(rowAfter("ArrowUp", 0, COUNT, 4)).toBe(0);
    expect(rowAfter("PageDown", 298, COUNT, 4)).toBe(299);
    expect(rowAfter("End", 3, COUNT, 4)).toBe(299);
    expect(rowAfter("Home", 3, COUNT, 4)).toBe(0);
    expect(rowAfter("KeyW", 3, COUNT, 4)).toBeNull();
  });
});
