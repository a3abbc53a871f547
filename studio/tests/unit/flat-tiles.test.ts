import type { Sphere } from "three";
import { describe, expect, it } from "vitest";
import { FlatTiles, type Seen } from "../../src/three/flat-tiles.ts";

/** A tile of a town: a ball at a place of the world, so wrong (m); no camera sees it. */
function seenBehind(eye: readonly [number, number, number], at: readonly [number, number, number], error_m: number): Seen {
  const tiles = new FlatTiles("http://127.0.0.1/tileset.json", { keptTiles_bytes: 1, mostTiles_bytes: 2 });
  tiles.standAt(eye);
  const boundingVolume = {
    intersectsSphere: ({ center, radius }: Sphere): boolean => Math.hypot(...center.toArray().map((value, k) => value - (at[k] ?? 0))) < radius,
  };
  const seen = { inView: false, error: 0 };
  tiles.calculateTileViewError({ geometricError: error_m, engineData: { boundingVolume } } as Parameters<FlatTiles["calculateTileViewError"]>[0], seen);
  tiles.dispose();
  return seen;
}

describe("tiles that are not seen", () => {
  it("come as fine as one can walk against where somebody stands", () => {
    expect(seenBehind([40, 74, 1.7], [40, 66, 1], 25)).toMatchObject({ inView: true, error: Infinity });
    expect(seenBehind([40, 74, 1.7], [40, 66, 1], 0.5)).toMatchObject({ inView: true, error: 0 });
  });

  it("stay away elsewhere", () => {
    expect(seenBehind([40, 74, 1.7], [40, 50, 1], 25).inView).toBe(false);
    expect(seenBehind([40, 74, 90], [40, 66, 1], 25).inView).toBe(false);
  });
});
