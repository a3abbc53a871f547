import { describe, expect, it } from "vitest";
import { Mesh } from "three";
import { areDrawnOnly, childrenOf, countCarried, countClasses, countProvenances, readFeatureTable } from "../../src/core/features.ts";
import { Fault } from "../../src/core/fault.ts";
import { scoreText } from "../../src/core/wording.ts";
import type { FeatureMesh } from "../../src/three/feature-mesh.ts";
import type { LoadedPart } from "../../src/three/load.ts";
import { stillOf } from "../../src/three/part-slot.ts";

function columns(): Record<string, unknown[]> {
  return {
    id: ["front", "window-1", "window-2", "roof"],
    class: ["wall", "window", "window", "roof"],
    parent: [-1, 0, 0, -1],
    provenance: ["measured", "measured", "inferred", "invented"],
    name: ["Front", "Window 1", "Window 2", "Roof"],
    width_m: [12, 1.1, 1.1, null],
    height_m: [15, 1.8, 1.8, null],
    area_m2: [170, 1.98, 1.98, 120],
    photo_px: [[0, 0, 480, 600], [40, 50, 44, 72], null, null],
  };
}

describe("the feature table", () => {
  it("becomes one row per feature", () => {
    const { rows } = readFeatureTable(columns(), "model.glb");
    expect(rows).toHaveLength(4);
    expect(rows[1]).toEqual({
      id: "window-1",
      class: "window",
      parent: 0,
      provenance: "measured",
      name: "Window 1",
      width_m: 1.1,
      height_m: 1.8,
      area_m2: 1.98,
      photo_px: [40, 50, 44, 72],
      seen_height_m: null,
      score: null,
    });
    expect(rows[3]?.width_m).toBeNull();
    expect(rows[0]?.parent).toBeNull();
  });

  it("knows children and counts", () => {
    const table = readFeatureTable(columns(), "model.glb");
    expect(childrenOf(table, 0).map(({ id }) => id)).toEqual(["window-1", "window-2"]);
    expect([...countCarried(table, 0)]).toEqual([["window", 2]]);
    expect(countCarried(table, 3).size).toBe(0);
    expect([...countClasses([table, table])]).toEqual([["wall", 2], ["window", 4], ["roof", 2]]);
    expect(countProvenances([table]).get("measured")).toBe(2);
  });

  it("counts a thing and its pieces of the same class once", () => {
    const pieces = { ...columns(), class: ["wall", "window", "wall", "roof"] };
    const table = readFeatureTable(pieces, "model.glb");
    expect([...countClasses([table])]).toEqual([["wall", 1], ["window", 1], ["roof", 1]]);
    expect([...countCarried(table, 0)]).toEqual([["window", 1]]);
  });

  it("says how much of a height was seen, where the model does", () => {
    const read = (seen: unknown[]): unknown =>
      readFeatureTable({ ...columns(), seen_height_m: seen }, "m").rows.map((row) => row.seen_height_m);
    expect(read([null, 1.3, null, null])).toEqual([null, 1.3, null, null]);
    expect(() => read([null, "much", null, null])).toThrow("seen_height_m");
    expect(() => read([1.3])).toThrow("seen_height_m");
  });

  it("says how sure an element was, where the model does", () => {
    const read = (scores: unknown[]): unknown =>
      readFeatureTable({ ...columns(), score: scores }, "m").rows.map((row) => row.score);
    expect(read([null, 0.83, 0.4, null])).toEqual([null, 0.83, 0.4, null]);
    expect(() => read([null, "sure", null, null])).toThrow("score");
    expect([null, 0.83, 0.4].map(scoreText)).toEqual(["", "Score 0.83 of 1.", "Doubtful: score 0.40 of 1."]);
  });

  it("ignores columns that it does not know", () => {
    expect(readFeatureTable({ ...columns(), shell: [0, 0, 0, 0] }, "m").rows).toHaveLength(4);
  });

  it.each<[string, (c: Record<string, unknown[]>) => void, string]>([
    ["a missing column", (c) => delete c.name, "name"],
    ["a short column", (c) => c.area_m2?.pop(), "area_m2"],
    ["an unknown class", (c) => (c.class = ["wall", "spire", "window", "roof"]), "class"],
    ["an unknown provenance", (c) => (c.provenance = ["guess", "measured", "measured", "measured"]), "provenance"],
    ["a parent out of range", (c) => (c.parent = [-1, 9, 0, -1]), "parent"],
    ["a parent that is itself", (c) => (c.parent = [0, 0, 0, -1]), "parent"],
    ["a size that is no number", (c) => (c.width_m = ["wide", 1, 1, 1]), "width_m"],
    ["a rectangle with three numbers", (c) => (c.photo_px = [[1, 2, 3], null, null, null]), "photo_px"],
    ["two equal ids", (c) => (c.id = ["a", "a", "b", "c"]), "same id"],
  ])("refuses %s and names it", (_, damage, word) => {
    const damaged = columns();
    damage(damaged);
    const read = (): unknown => readFeatureTable(damaged, "x/model.glb");
    expect(read).toThrow(Fault);
    expect(read).toThrow(word);
    expect(read).toThrow("x/model.glb");
  });

  it.each([null, undefined, 3, "text", {}, []])("refuses %j", (value) => {
    expect(() => readFeatureTable(value, "model.glb")).toThrow(Fault);
  });
});

describe("what is drawn only", () => {
  const { rows } = readFeatureTable({ ...columns(), class: ["wall", "shadow", "shadow", "roof"] }, "model.glb");

  it("is a mesh of shadows alone", () => {
    expect(areDrawnOnly([1, 2, 1], { rows })).toBe(true);
    expect(areDrawnOnly([1, 0], { rows })).toBe(false);
    expect(areDrawnOnly([9], { rows })).toBe(false);
  });

  it("is nothing that one bumps into or points at", () => {
    const mesh = (row: number): FeatureMesh => ({ mesh: new Mesh(), faces: new Uint32Array(3), rowOfFace: new Uint32Array([row]) });
    const [wall, shade] = [mesh(0), mesh(1)];
    const part = { table: { rows }, meshes: [wall, shade], instanced: [], movers: [] } as unknown as LoadedPart;
    expect(stillOf(part).meshes).toEqual([wall]);
  });
});
