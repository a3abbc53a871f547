/** The triangles of parts in the world frame, and whose each of them is: what a `Solid` is made of. */
import { BufferAttribute, type InterleavedBufferAttribute, Vector3 } from "three";
import { worldFromDrawn } from "../core/frames.ts";
import { fillTriangles, type Piece } from "../core/triangles.ts";
import { boxOf, type InstancedFeatures, placeOf } from "./instanced-mesh.ts";
import type { LoadedPart } from "./load.ts";

/** Whose the faces are. */
export interface Owners {
  readonly partOfFace: Uint32Array;
  readonly rowOfFace: Uint32Array;
  /** From this face on, twelve faces are the box of an instance: a walker bumps into the box. */
  readonly firstBoxFace: number;
  /** What stands in the boxes, in their order: a click hits it and not its box. */
  readonly instances: readonly Standing[];
}

export interface Soup extends Owners {
  /** Nine coordinates per triangle, world frame. */
  readonly positions: Float32Array;
}

/** An instance of a mesh, in the drawn frame. */
export interface Standing {
  readonly target: InstancedFeatures;
  readonly index: number;
}

/** What a soup takes of a part. */
export type Soupable = Pick<LoadedPart, "meshes" | "instanced">;

/** Triangles of a box. */
export const BOX_FACES = 12;
/** The corners of a box by the bits of their numbers: x, y, z. */
const BOX_CORNERS = [
  0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5,
];

/** `first` is the number of the first part in the place. */
export function soupOf(parts: readonly Soupable[], first = 0): Soup {
  const owners = ownersOf(parts, first);
  const positions = new Float32Array(9 * owners.rowOfFace.length);
  fillTriangles(piecesOf(parts), positions);
  positions.set(boxesOf(parts), 9 * owners.firstBoxFace);
  return { ...owners, positions };
}

export function ownersOf(parts: readonly Soupable[], first = 0): Owners {
  const own = parts.flatMap(({ meshes }) => meshes);
  const firstBoxFace = own.reduce((faces, mesh) => faces + mesh.rowOfFace.length, 0);
  const instances = parts.flatMap(({ instanced }) =>
    instanced.flatMap((target) => Array.from(target.rows, (_, index) => ({ target, index }))),
  );
  const count = firstBoxFace + BOX_FACES * instances.length;
  const owners = { partOfFace: new Uint32Array(count), rowOfFace: new Uint32Array(count), firstBoxFace, instances };
  let face = 0;
  const give = (part: number, rows: Uint32Array | number, faces: number): void => {
    owners.partOfFace.fill(first + part, face, face + faces);
    if (typeof rows === "number") owners.rowOfFace.fill(rows, face, face + faces);
    else owners.rowOfFace.set(rows, face);
    face += faces;
  };
  for (const [part, { meshes }] of parts.entries()) for (const { rowOfFace } of meshes) give(part, rowOfFace, rowOfFace.length);
  for (const [part, { instanced }] of parts.entries()) {
    for (const { rows } of instanced) for (const row of rows) give(part, row, BOX_FACES);
  }
  return owners;
}

/** Their own meshes, in the order of the faces. */
export function piecesOf(parts: readonly Soupable[]): Piece[] {
  return parts.flatMap(({ meshes }) =>
    meshes.map(({ mesh, faces }) => ({ positions: plain(mesh.geometry.getAttribute("position") as BufferAttribute), faces, drawnFromMesh: mesh.matrixWorld.toArray() })),
  );
}

/** Three floats per vertex, as a worker takes them: models may keep them as integers, or between other attributes. */
export function plain(attribute: BufferAttribute | InterleavedBufferAttribute): Float32Array {
  const { array, count } = attribute;
  if (array instanceof Float32Array && array.length === 3 * count) return array;
  const found = new Float32Array(3 * count);
  for (let i = 0; i < count; i += 1) found.set([attribute.getX(i), attribute.getY(i), attribute.getZ(i)], 3 * i);
  return found;
}

/** Twelve triangles for each instance: the box of its mesh where it stands; world frame. */
export function boxesOf(parts: readonly Soupable[]): Float32Array {
  const corners: number[] = [];
  const corner = new Vector3();
  for (const target of parts.flatMap(({ instanced }) => instanced)) {
    const { min, max } = boxOf(target.mesh);
    for (let index = 0; index < target.rows.length; index += 1) {
      const place = placeOf(target, index);
      for (const bits of BOX_CORNERS) {
        corner.set(bits & 1 ? max.x : min.x, bits & 2 ? max.y : min.y, bits & 4 ? max.z : min.z);
        corners.push(...worldFromDrawn(corner.applyMatrix4(place).toArray()));
      }
    }
  }
  return new Float32Array(corners);
}
