import { describe, expect, it, vi } from "vitest";
import { rowNamed } from "../../src/core/features.ts";
import { Fault } from "../../src/core/fault.ts";
import { TileTable } from "../../src/core/tile-table.ts";

const text = (words: string): Uint8Array => new TextEncoder().encode(words);
const sixteen = (...values: number[]): Uint8Array => new Uint8Array(new Uint16Array(values).buffer);
const offsets = (...values: number[]): Uint8Array => new Uint8Array(new Uint32Array(values).buffer);

const VIEWS = [
  new Uint8Array([3, 0, 9]), // class
  sixteen(1, 0, 1), // building
  sixteen(0, 1, 1), // rule
  sixteen(1200, 65_535, 80), // width
  sixteen(2471, 65_535, 90), // height
  text("ab"),
  offsets(0, 1, 2),
  text("Rue 1Rue 22"),
  offsets(0, 5, 11),
];

function metadata(): unknown {
  const named = (...names: string[]): { values: { name: string; value: number }[] } => ({
    values: names.map((name, value) => ({ name, value })),
  });
  return {
    schema: {
      enums: {
        semantic: named("wall", "roof", "ground", "window", "door", "x", "x", "x", "x", "other"),
        rule: named("Window", "Front"),
      },
    },
    propertyTables: [
      {
        class: "surface",
        count: 3,
        properties: {
          class: { values: 0 },
          building: { values: 1 },
          rule: { values: 2 },
          width: { values: 3 },
          height: { values: 4 },
        },
      },
      {
        class: "building",
        count: 2,
        properties: {
          id: { values: 5, stringOffsets: 6 },
          name: { values: 7, stringOffsets: 8 },
        },
      },
    ],
  };
}

const views = (view: number): Uint8Array => VIEWS[view] ?? new Uint8Array();

describe("the surfaces of a tile", () => {
  it("say their class, size and building", () => {
    const table = new TileTable(metadata(), views, "a.glb");
    expect(table.rows[0]).toMatchObject({
      id: "b/Window-0",
      class: "window",
      name: "Window",
      width_m: 1.2,
      height_m: 2.471,
      provenance: "invented",
    });
    expect(table.rows[1]).toMatchObject({ class: "wall", width_m: null, height_m: null });
    expect([table.buildingOf(0), table.buildingOf(1)]).toEqual(["Rue 22", "Rue 1"]);
    expect(table.counts()).toEqual(new Map([["window", 1], ["wall", 1], ["other", 1]]));
  });

  it.each([
    ["no tables", undefined],
    ["no schema", { propertyTables: [] }],
    ["one table", { ...(metadata() as object), propertyTables: [] }],
  ])("are refused where there are %s", (_, given) => {
    expect(() => new TileTable(given, views, "a.glb")).toThrow(Fault);
  });

  it("are refused where a column is cut short", () => {
    const short = (view: number): Uint8Array => views(view).subarray(0, 2);
    expect(() => new TileTable(metadata(), short, "a.glb")).toThrow("cut short");
  });

  it("finds the row that a link names without making its rows", () => {
    const table = new TileTable(metadata(), views, "a.glb");
    const rows = vi.spyOn(table, "rows", "get");
    const { id } = table.ending(table.rows[2]?.id ?? "") ?? { id: "" };
    rows.mockClear();
    expect(rowNamed(table, id, () => "")).toBe(2);
    expect(rowNamed(table, `Mill/${id}`, () => "Mill")).toBe(2);
    expect([`Barn/${id}`, `${id}0`, "wall", "", "a-9"].map((text) => rowNamed(table, text, () => "Mill"))).toEqual([null, null, null, null, null]);
    expect(rows).not.toHaveBeenCalled();
  });
});
