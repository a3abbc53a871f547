import { describe, expect, it, vi } from "vitest";
import { Absent } from "../../src/core/fault.ts";
import type { Part } from "../../src/core/place.ts";
import { type Sight, sightOf } from "../../src/core/sight.ts";
import { Arrivals } from "../../src/three/arrivals.ts";
import { Fake } from "./surroundings.ts";

/** A house of 4 m beside a place. */
function house(id: string, x: number, y: number, more: Partial<Part> = {}): Part {
  return {
    id, name: id, model: `${id}.glb`, photo: null, raw: null, document: null,
    worldFromPart: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, y, 0, 1],
    arrangement: "single", bounds: { min: [-2, -2, 0], max: [2, 2, 6] }, core: null, isGround: false, isBackdrop: false, layer: "model",
    ...more,
  };
}

const EYE = [0, 0, 1.7] as const;
const north = sightOf(EYE, [0, 1, 0], 0.9, 1.5);
const south = sightOf(EYE, [0, -1, 0], 0.9, 1.5);

/** Parts whose models come when the test says so, one by one. */
function coming(parts: readonly Part[], sight: () => Sight, around = new Fake()) {
  const asked: string[] = [];
  const open: { come: () => void; fail: () => void }[] = [];
  const fetch = async (index: number): Promise<void> => {
    asked.push(parts[index]?.id ?? "");
    await new Promise<void>((come, reject) => {
      open.push({ come, fail: () => reject(new Absent("x", "it is not there", "Copy it.")) });
    });
  };
  const arrivals = new Arrivals(parts, sight, fetch, () => undefined, around);
  arrivals.start();
  return { arrivals, asked, open, around };
}

describe("the parts of a place", () => {
  const ring = [
    house("far north", 0, 60), house("south", 0, -10), house("north", 0, 10), house("far south", 0, -60),
    house("sky", 0, 0, { isBackdrop: true }), house("ground", 0, 0, { isGround: true }), house("east", 30, 0), house("west", -30, 0),
  ];

  it("come by what is seen: the ground, what is before one, the rest, a picture around it last", async () => {
    const { asked, open } = coming(ring, () => north);
    expect(asked).toEqual(["ground", "north", "far north", "south", "east", "west"]);
    open[0]?.come();
    await vi.waitFor(() => expect(asked).toHaveLength(7));
    open[1]?.come();
    await vi.waitFor(() => expect(asked.slice(6)).toEqual(["far south", "sky"]));
  });

  it("come by the nearness alone before anything is seen", () => {
    const { asked } = coming(ring, () => ({ eye: EYE, direction: null, half_rad: 0 }));
    expect(asked).toEqual(["ground", "south", "north", "east", "west", "far north"]);
  });

  it("are ordered anew for whoever turns", async () => {
    const row = Array.from({ length: 9 }, (_, k) => house(`n${k}`, 0, 10 + 10 * k));
    const behind = house("behind", 0, -80);
    let now = north;
    const { asked, open } = coming([behind, ...row], () => now);
    expect(asked).toEqual(["n0", "n1", "n2", "n3", "n4", "n5"]);
    now = south;
    open[0]?.come();
    await vi.waitFor(() => expect(asked.at(-1)).toBe("behind"));
  });

  it("are asked for again in the order of what is seen then", async () => {
    const two = [house("north", 0, 20), house("south", 0, -10)];
    const { asked, open, around, arrivals } = coming(two, () => north);
    for (const { fail } of open) fail();
    await vi.waitFor(() => expect(arrivals.missing).toHaveLength(2));
    around.wait();
    await vi.waitFor(() => expect(asked).toEqual(["north", "south", "north", "south"]));
  });

  it("are not asked for twice at once, though another fails meanwhile", async () => {
    const two = [house("north", 0, 20), house("south", 0, -10)];
    const { asked, open, around, arrivals } = coming(two, () => north);
    open[0]?.fail();
    await vi.waitFor(() => expect(arrivals.missing).toHaveLength(1));
    around.wait();
    expect(asked).toEqual(["north", "south", "north"]);
    open[1]?.fail();
    await vi.waitFor(() => expect(arrivals.missing).toHaveLength(2));
    around.wait();
    expect([asked, arrivals.waiting]).toEqual([["north", "south", "north", "south"], 2]);
  });
});
