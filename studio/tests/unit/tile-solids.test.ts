import { BufferAttribute, BufferGeometry, Group, InstancedMesh, Matrix4, Mesh, MeshStandardMaterial } from "three";
import { beforeAll, describe, expect, it, vi } from "vitest";
import { TileTable } from "../../src/core/tile-table.ts";
import { Solid } from "../../src/three/solid.ts";
import { TileModel } from "../../src/three/tile-model.ts";
import { TileSolids } from "../../src/three/tile-solids.ts";
import { helpHere } from "./worker-here.ts";

beforeAll(async () => {
  await import("../../src/three/soup-worker.ts");
});

const BODY = { radius_m: 0.3, height_m: 1.8, eye_m: 1.7, step_m: 0.25 };

/** A wall of 8 x 4 m and three posts before it, as a tile has them: quantised, and instanced. */
function tile(): TileModel {
  const wall = new BufferGeometry();
  wall.setAttribute("position", new BufferAttribute(new Int16Array([0, 0, 0, 8, 0, 0, 8, 4, 0, 0, 4, 0]), 3));
  wall.setIndex([0, 1, 2, 0, 2, 3]);
  const post = new BufferGeometry();
  post.setAttribute("position", new BufferAttribute(new Float32Array([0, 0, 0, 0.4, 0, 0, 0.2, 3, 0]), 3));
  const posts = new InstancedMesh(post, new MeshStandardMaterial(), 3);
  for (const k of [0, 1, 2]) posts.setMatrixAt(k, new Matrix4().makeTranslation(1 + 3 * k, 0, 2));
  const scene = new Group().add(new Mesh(wall, new MeshStandardMaterial()), posts);
  scene.position.set(10, 0, -5);
  scene.updateMatrixWorld(true);
  const table = new TileTable({ schema: { enums: {} }, propertyTables: [{ class: "surface", count: 0, properties: {} }, { class: "building", count: 0, properties: {} }] }, () => new Uint8Array(), "a.glb");
  return new TileModel(scene, table);
}

/** All that follows from an answer has happened. */
async function settled(): Promise<void> {
  await new Promise((resolve) => setTimeout(resolve));
}

describe("the solids of tiles", () => {
  it("are those of all faces, whether grown here or in a worker", async () => {
    const model = tile();
    const whole = new Solid(model.soup(null));
    const help = helpHere("when told");
    const ahead = new TileSolids(() => help);
    ahead.growAhead(model.scene, () => model.pieces());
    ahead.growAhead(model.scene, () => model.pieces());
    expect(help.asked).toEqual([1]);
    help.answer();
    await settled();
    const here = new TileSolids(() => null).of(model.scene, () => model.pieces());
    const pieces = vi.spyOn(model, "pieces");
    expect(ahead.of(model.scene, () => model.pieces()).faceCount).toBe(5);
    expect(pieces).not.toHaveBeenCalled(); // it is the worker's
    for (const solid of [here, ahead.of(model.scene, () => model.pieces())]) {
      expect(solid.bounds).toEqual(whole.bounds);
      for (const [x, y] of [[14, 4.9], [11.2, 2.9], [30, 4]] as const) {
        expect(solid.pushOut([x, y, 0], BODY)).toEqual(whole.pushOut([x, y, 0], BODY));
      }
    }
  });

  it("are there at once where nobody has grown them, and the worker's is not wanted then", async () => {
    const model = tile();
    const help = helpHere("when told");
    const solids = new TileSolids(() => help);
    solids.growAhead(model.scene, () => model.pieces());
    const own = solids.of(model.scene, () => model.pieces());
    help.answer();
    await settled();
    expect(solids.of(model.scene, () => model.pieces())).toBe(own);
    solids.drop(model.scene);
    expect(solids.has(model.scene)).toBe(false);
  });

  it("are not grown ahead where there is no worker, and no face is copied for it", () => {
    const model = tile();
    const pieces = vi.spyOn(model, "pieces");
    const solids = new TileSolids(() => null);
    solids.growAhead(model.scene, () => model.pieces());
    expect([pieces.mock.calls.length, solids.has(model.scene)]).toEqual([0, false]);
  });

  it("are kept of the last few alone", () => {
    const solids = new TileSolids(() => null);
    const all = Array.from({ length: 8 }, tile);
    for (const model of all) solids.of(model.scene, () => model.pieces());
    expect(all.map(({ scene }) => solids.has(scene))).toEqual([false, false, true, true, true, true, true, true]);
  });
});
