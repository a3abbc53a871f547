import { Group } from "three";
import { describe, expect, it } from "vitest";
import type { Layer } from "../../src/core/state.ts";
import { readPoints, showClouds } from "../../src/three/clouds.ts";

/** Which of the clouds of these layers are seen, some layers being off. */
function seen(layers: readonly Layer[], off: readonly Layer[]): boolean[] {
  const clouds = new Group();
  for (const layer of layers) {
    const cloud = new Group();
    cloud.userData.layer = layer;
    clouds.add(cloud);
  }
  showClouds(clouds, new Set(off));
  return clouds.children.map(({ visible }) => visible);
}

/** A text of so many points, of whose head it has more. */
function ply(points: number, told = points): ArrayBuffer {
  const head = ["ply", "format ascii 1.0", `element vertex ${told}`, "property float x", "property float y", "property float z", "end_header"];
  const lines = Array.from({ length: points }, (_, k) => `${k} 0 1`);
  return new TextEncoder().encode([...head, ...lines, ""].join("\n")).buffer;
}

describe("a file of points", () => {
  it("is read where it is whole", () => {
    expect(readPoints(ply(3), { file: "points.ply", count: 3 }).getAttribute("position").count).toBe(3);
    expect(readPoints(ply(3), { file: "points.ply", count: null }).getAttribute("position").count).toBe(3);
  });

  it("is refused where it is cut short, or is none", () => {
    expect(() => readPoints(ply(2, 3), { file: "points.ply", count: 3 })).toThrow("points.ply: the points cannot be read (it is cut short)");
    const other = new TextEncoder().encode("<html>").buffer;
    expect(() => readPoints(other, { file: "points.ply", count: 3 })).toThrow("not a PLY file");
  });
});

describe("clouds", () => {
  it("are seen unless they are off", () => {
    expect(seen(["points", "points"], [])).toEqual([true, true]);
    expect(seen(["points"], ["points"])).toEqual([false]);
  });

  it("show distances in place of the points", () => {
    expect(seen(["points", "distances"], ["distances"])).toEqual([true, false]);
    expect(seen(["points", "distances"], [])).toEqual([false, true]);
    expect(seen(["points", "distances"], ["points"])).toEqual([false, true]);
    expect(seen(["points", "distances"], ["points", "distances"])).toEqual([false, false]);
  });
});
