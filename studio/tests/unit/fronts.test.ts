import { describe, expect, it } from "vitest";
import { outlookOfFronts } from "../../src/core/fronts.ts";
import type { Part } from "../../src/core/place.ts";

/** A facade that is turned about the vertical: by 0 its front faces south. */
function facade(turn_deg: number, photo: string | null = "photo.jpg"): Part {
  const [c, s] = [Math.cos((turn_deg * Math.PI) / 180), Math.sin((turn_deg * Math.PI) / 180)];
  return {
    id: `${turn_deg}`, name: "", model: "m.glb", photo, raw: null, document: null, arrangement: "single", bounds: null, core: null,
    isGround: false, isBackdrop: false, layer: "model",
    worldFromPart: [c, s, 0, 0, -s, c, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1],
  };
}

const NORTHWARD = { eye: [3, -20, 1.7], target: [3, 0, 5] } as const;

/** How well a front that is turned so is seen: positive from before, negative from behind. */
function seen(parts: Part[], turn_deg: number): number {
  const [east, north] = outlookOfFronts({ parts, tileset: null, start: NORTHWARD });
  const turn = (turn_deg * Math.PI) / 180;
  return -Math.sin(turn) * east + Math.cos(turn) * north;
}

describe("the first look", () => {
  it.each([0, 90, 180, 250])("is at the front of a facade that is turned by %d degrees, from its left", (turn) => {
    expect(seen([facade(turn)], turn)).toBeCloseTo(Math.cos(Math.PI / 6), 9);
  });

  it("is at most fronts of a row with a corner house", () => {
    const row = [0, 0, 0, 90];
    for (const turn of row) expect(seen(row.map((one) => facade(one)), turn)).toBeGreaterThan(0.2);
  });

  it("goes along a street whose sides face each other", () => {
    const street = [20, 200, 20, 200].map((one) => facade(one));
    for (const turn of [20, 200]) expect(Math.abs(seen(street, turn))).toBeLessThan(0.2);
  });

  it("is from above where there is no front, the way that a visitor begins to look", () => {
    const eastward = { eye: [-9, 2, 1.7], target: [0, 2, 3] } as const;
    const [east, north, up] = outlookOfFronts({ parts: [facade(0, null), facade(0, null)], tileset: null, start: eastward });
    expect([east, north]).toEqual([1, 0]);
    expect(up).toBeLessThan(-0.3);
  });

  it("is that of a visitor in a town of tiles, whose size says from how high", () => {
    const west = { eye: [9, 2, 1.7], target: [0, 2, 3] } as const;
    const [east, north, up] = outlookOfFronts({ parts: [facade(0)], tileset: "tileset.json", start: west });
    expect(east).toBeCloseTo(-1, 9);
    expect(north).toBeCloseTo(0, 9);
    expect(up).toBeCloseTo(0, 9);
  });

  it("is three-quarter at a house before whose door one begins", () => {
    const house = { ...facade(0, null), document: "plan.json" };
    const [east, north] = outlookOfFronts({ parts: [house], tileset: null, start: NORTHWARD });
    expect(east).toBeCloseTo(0.5, 9);
    expect(north).toBeCloseTo(Math.sqrt(3) / 2, 9);
  });

  it("does not fail where the visitor looks straight down", () => {
    const down = { eye: [0, 0, 9], target: [0, 0, 0] } as const;
    expect(outlookOfFronts({ parts: [], tileset: null, start: down }).every((one) => Number.isFinite(one))).toBe(true);
  });
});
