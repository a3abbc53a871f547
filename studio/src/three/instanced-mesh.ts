/** A mesh that stands many times in a part: each instance is of one feature. */
import {
  Box3,
  type BufferAttribute,
  BufferGeometry,
  InstancedBufferAttribute,
  InstancedMesh,
  Matrix4,
  type Mesh,
} from "three";
import type { FeatureTable } from "../core/features.ts";
import { Fault } from "../core/fault.ts";

/** As the file has it: the loader leaves the names of instances' attributes alone. */
const FEATURE_ATTRIBUTE = "_FEATURE_ID_0";

export interface InstancedFeatures {
  readonly mesh: InstancedMesh;
  /** Row in the feature table of each instance. */
  readonly rows: Uint32Array;
  /** Sixteen numbers per instance, as in the file: hiding some moves the others up. */
  readonly matrices: Float32Array;
}

/** What the loader made of EXT_mesh_gpu_instancing, or `gatherRepeated` of nodes, with the file's rows. */
export function instancedFeatures(
  mesh: InstancedMesh,
  table: FeatureTable,
  file: string,
): InstancedFeatures {
  const ids = mesh.geometry.getAttribute(FEATURE_ATTRIBUTE) as BufferAttribute | undefined;
  const given = Array.from({ length: mesh.count }, (_, index) =>
    ids === undefined || index >= ids.count ? -1 : Math.round(ids.getX(index)),
  );
  const unknown = given.find((row) => table.rows[row] === undefined);
  if (unknown !== undefined) {
    throw new Fault(
      file,
      `a repeated part of the model has the feature id ${unknown}, which is not in the table`,
      "Write the model again with this version of Veduta.",
    );
  }
  mesh.geometry.deleteAttribute(FEATURE_ATTRIBUTE);
  mesh.geometry.setAttribute("featureRow", new InstancedBufferAttribute(new Float32Array(given), 1));
  mesh.castShadow = true;
  mesh.receiveShadow = true;
  return { mesh, rows: Uint32Array.from(given), matrices: mesh.instanceMatrix.array.slice() as Float32Array };
}

/** Leaves out the instances of hidden features. */
export function showInstances(target: InstancedFeatures, isVisible: (row: number) => boolean): void {
  const { mesh, rows, matrices } = target;
  const shownRows = mesh.geometry.getAttribute("featureRow");
  let shown = 0;
  for (const [index, row] of rows.entries()) {
    if (!isVisible(row)) continue;
    mesh.instanceMatrix.array.set(matrices.subarray(16 * index, 16 * index + 16), 16 * shown);
    shownRows.setX(shown, row);
    shown += 1;
  }
  mesh.instanceMatrix.needsUpdate = true;
  shownRows.needsUpdate = true;
  mesh.count = shown;
  mesh.visible = shown > 0;
}

/** Where an instance stands: from the mesh's frame to the drawn one. */
export function placeOf(target: InstancedFeatures, index: number): Matrix4 {
  return new Matrix4().fromArray(target.matrices, 16 * index).premultiply(target.mesh.matrixWorld);
}

/** The box around the mesh in its own frame. */
export function boxOf(mesh: Mesh): Box3 {
  const { geometry } = mesh;
  if (geometry.boundingBox === null) geometry.computeBoundingBox();
  return geometry.boundingBox ?? new Box3();
}

/** The faces of all instances of a row, in the drawn frame. */
export function facesOfInstances(target: InstancedFeatures, row: number): BufferGeometry[] {
  const found: BufferGeometry[] = [];
  for (const [index, own] of target.rows.entries()) {
    if (own !== row) continue;
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", target.mesh.geometry.getAttribute("position").clone());
    geometry.setIndex(target.mesh.geometry.getIndex());
    found.push(geometry.applyMatrix4(placeOf(target, index)));
  }
  return found;
}

