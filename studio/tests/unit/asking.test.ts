import { describe, expect, it } from "vitest";
import { Asking, pauseAfter_ms } from "../../src/core/asking.ts";
import { Fake } from "./surroundings.ts";

describe("asking again", () => {
  it("waits longer each time, and a minute at most", () => {
    expect([1, 2, 3].map(pauseAfter_ms)).toEqual([2000, 4000, 8000]);
    expect(pauseAfter_ms(40)).toBe(60_000);
  });

  it("asks once for many failures of a round", () => {
    const around = new Fake();
    let asked = 0;
    const asking = new Asking(() => (asked += 1), around);
    asking.failed();
    asking.failed();
    around.wait();
    expect(asked).toBe(1);
    asking.failed();
    expect(around.pauses).toEqual([2000, 4000]);
    asking.succeeded();
    around.wait();
    asking.failed();
    expect(around.pauses).toEqual([2000, 4000, 2000]);
  });

  it("asks at once when the network is back, and only if something is missing", () => {
    const around = new Fake();
    let asked = 0;
    const asking = new Asking(() => (asked += 1), around);
    around.network();
    expect(asked).toBe(0);
    asking.failed();
    around.network();
    expect(asked).toBe(1);
    around.wait();
    expect(asked).toBe(1);
  });
});
