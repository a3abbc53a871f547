import { describe, expect, it } from "vitest";
import { budgetOf } from "../../src/core/budget.ts";
import type { Part } from "../../src/core/place.ts";

function parts(count: number, side_m: number): Part[] {
  return Array.from({ length: count }, (_, index) => ({
    id: `part-${index}`,
    name: "",
    model: "part.glb",
    photo: null,
    raw: null,
    document: null,
    worldFromPart: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1],
    arrangement: "single",
    bounds: { min: [0, 0, 0], max: [side_m, side_m, 10] },
    core: null,
    isGround: false,
    isBackdrop: false,
    layer: "model",
  }));
}

describe("what a machine is asked to draw", () => {
  it("is finer for a street than for a town", () => {
    const street = budgetOf({ parts: parts(60, 12) }, { isSmall: false });
    const town = budgetOf({ parts: parts(60, 120) }, { isSmall: false });
    expect(street.tileError_px).toBeLessThan(town.tileError_px);
  });

  it("is that of a town where nobody knows how large it is", () => {
    const unknown = parts(1, 10).map((part) => ({ ...part, bounds: null }));
    expect(budgetOf({ parts: unknown }, { isSmall: false }).tileError_px).toBe(14);
  });

  it("does not count the ground", () => {
    const ground = parts(1, 1000).map((part) => ({ ...part, isGround: true }));
    expect(budgetOf({ parts: ground }, { isSmall: false }).tileError_px).toBe(4);
  });

  it("asks a phone for a quarter of the shadow's pixels over a house, and nobody for more over a wide place", () => {
    const side = (isSmall: boolean, radius_m: number): number => budgetOf({ parts: [] }, { isSmall }).shadowSide_px(radius_m);
    expect((side(false, 10) / side(true, 10)) ** 2).toBe(4);
    expect([side(false, 100), side(true, 100)]).toEqual([2048, 2048]);
  });

  it("makes pictures smaller for a phone alone", () => {
    expect(budgetOf({ parts: [] }, { isSmall: true }).mostTexture_px).toBe(2048);
    expect(budgetOf({ parts: [] }, { isSmall: false }).mostTexture_px).toBe(Infinity);
  });
});
