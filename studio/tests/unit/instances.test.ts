import {
  BoxGeometry,
  BufferAttribute,
  Group,
  InstancedMesh,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  type Object3D,
} from "three";
import { describe, expect, it } from "vitest";
import type { FeatureTable } from "../../src/core/features.ts";
import { facesOfInstances, instancedFeatures, showInstances } from "../../src/three/instanced-mesh.ts";
import { gatherRepeated } from "../../src/three/repeated-nodes.ts";
import { Solid } from "../../src/three/solid.ts";
import { soupOf } from "../../src/three/soup.ts";
import { DEFAULT_WALK } from "../../src/core/walking.ts";

const table = { rows: Array.from({ length: 4 }, (_, row) => ({ id: `${row}` })) } as unknown as FeatureTable;

/** Two uprights of a frame 2 m wide and 2 m high, with a gap between; three.js has y up. */
function frame(): BoxGeometry {
  const geometry = new BoxGeometry(2, 2, 0.2);
  const position = geometry.getAttribute("position");
  const index = geometry.getIndex();
  const kept: number[] = [];
  // Only the faces at the left and right ends stay: a ray through the middle passes between them.
  for (let face = 0; face < (index?.count ?? 0); face += 3) {
    const corners = [0, 1, 2].map((k) => index?.getX(face + k) ?? 0);
    const x = corners.map((corner) => position.getX(corner));
    if (x.every((value) => value === x[0])) kept.push(...corners);
  }
  geometry.setIndex(kept);
  return geometry;
}

function instanced(rows: readonly number[]): ReturnType<typeof instancedFeatures> {
  const mesh = new InstancedMesh(frame(), new MeshBasicMaterial(), rows.length);
  for (const [index] of rows.entries()) mesh.setMatrixAt(index, new Matrix4().makeTranslation(5 * index, 1, -3 * index));
  mesh.geometry.setAttribute("_FEATURE_ID_0", new BufferAttribute(new Float32Array(rows), 1));
  mesh.updateMatrixWorld(true);
  return instancedFeatures(mesh, table, "model.glb");
}

function solidOf(target: ReturnType<typeof instancedFeatures>): Solid {
  return new Solid(soupOf([{ meshes: [], instanced: [target] }]));
}

const ALL = (): boolean => true;

describe("repeated meshes", () => {
  it("are hit themselves, and not their boxes", () => {
    const solid = solidOf(instanced([2, 3]));
    // World: y goes north, into the picture. The first frame stands at x 0, the second at 5, y 3.
    expect(solid.firstHit([0, -5, 1], [0, 1, 0], ALL)).toBeNull();
    const hit = solid.firstHit([-5, 0, 1], [1, 0, 0], ALL);
    expect(hit?.feature).toEqual({ part: 0, row: 2 });
    expect(hit?.distance_m).toBeCloseTo(4, 5);
    expect(solid.firstHit([-5, 3, 1], [1, 0, 0], ALL)?.point[0]).toBeCloseTo(4, 5);
    expect(solid.firstHit([-5, 0, 1], [1, 0, 0], ({ row }) => row === 3)).toBeNull();
  });

  it("stop a walker at their boxes", () => {
    const solid = solidOf(instanced([1]));
    const { body } = DEFAULT_WALK;
    const push = solid.pushOut([0, -0.1 - body.radius_m + 0.05, 0], body);
    expect(push?.[1]).toBeCloseTo(-0.05, 4);
  });

  it("leave out the instances of hidden features, and show them again", () => {
    const target = instanced([1, 2, 3]);
    showInstances(target, (row) => row !== 1);
    const shown = new Matrix4();
    target.mesh.getMatrixAt(0, shown);
    expect([target.mesh.count, shown.elements[12]]).toEqual([2, 5]);
    expect(target.mesh.geometry.getAttribute("featureRow").getX(0)).toBe(2);
    showInstances(target, ALL);
    target.mesh.getMatrixAt(0, shown);
    expect([target.mesh.count, shown.elements[12]]).toEqual([3, 0]);
    showInstances(target, () => false);
    expect(target.mesh.visible).toBe(false);
  });

  it("are outlined where they stand", () => {
    const [outlined] = facesOfInstances(instanced([1, 2]), 2);
    outlined?.computeBoundingBox();
    expect(outlined?.boundingBox?.min.x).toBeCloseTo(4, 5);
  });

  it("that name no row are a fault of the file", () => {
    expect(() => instanced([9])).toThrow(/model.glb/u);
  });
});

/** As the loader has it: a marked group of nodes with one geometry, of two materials each. */
function chairs(rows: readonly number[], geometry: BoxGeometry): Group {
  const group = new Group();
  group.userData = { veduta: { instances: true } };
  for (const [index, row] of rows.entries()) {
    const place = new Group();
    place.position.x = 5 * index;
    place.userData = { veduta: { instance: row } };
    place.add(new Mesh(geometry, new MeshBasicMaterial({ name: "wood" })));
    place.add(new Mesh(geometry, new MeshBasicMaterial({ name: "cloth" })));
    group.add(place);
  }
  return group;
}

function drawnIn(scene: Object3D): InstancedMesh[] {
  const found: InstancedMesh[] = [];
  scene.traverse((node) => {
    if (node instanceof InstancedMesh) found.push(node as InstancedMesh);
  });
  return found;
}

describe("nodes that share a mesh", () => {
  it("are drawn once for each material, where they stand", () => {
    const scene = new Group();
    const geometry = new BoxGeometry(1, 1, 1);
    scene.add(chairs([1, 2, 3], geometry), chairs([0], geometry));
    gatherRepeated(scene);
    const drawn = drawnIn(scene);
    expect(drawn.map(({ count }) => count)).toEqual([3, 3, 1, 1]);
    const targets = drawn.map((mesh) => instancedFeatures(mesh, table, "model.glb"));
    expect(targets.map(({ rows }) => [...rows])).toEqual([[1, 2, 3], [1, 2, 3], [0], [0]]);
    expect(targets[0]?.matrices[16 + 12]).toBe(5);
  });

  it("without a row are a fault of the file", () => {
    const scene = new Group();
    scene.add(chairs([1], new BoxGeometry(1, 1, 1)));
    delete scene.children[0]?.children[0]?.userData.veduta;
    gatherRepeated(scene);
    expect(() => drawnIn(scene).map((mesh) => instancedFeatures(mesh, table, "model.glb"))).toThrow(/model.glb/u);
  });
});
