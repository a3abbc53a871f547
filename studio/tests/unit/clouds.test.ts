import { Group } from "three";
import { describe, expect, it } from "vitest";
import type { Layer } from "../../src/core/state.ts";
import { showClouds } from "../../src/three/clouds.ts";

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
