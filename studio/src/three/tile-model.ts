/** A loaded tile: its meshes, and which surface each face belongs to. */
import {
  type BufferAttribute,
  InstancedMesh,
  type InterleavedBufferAttribute,
  type Intersection,
  Matrix4,
  type Mesh,
  type MeshStandardMaterial,
  type Object3D,
  type Texture,
  Vector3,
} from "three";
import { isProvenance, isSemanticClass, type Provenance, type SemanticClass } from "../core/classes.ts";
import { worldFromDrawn } from "../core/frames.ts";
import type { TileTable } from "../core/tile-table.ts";
import type { Piece } from "../core/triangles.ts";
import { plain, type Soup } from "./soup.ts";

type Column = BufferAttribute | InterleavedBufferAttribute;

export interface TileMesh {
  readonly mesh: Mesh;
  readonly kind: SemanticClass;
  readonly provenance: Provenance;
  /** The colour of the rules, sRGB, and their texture. */
  readonly own: number;
  readonly texture: Texture | null;
}

export class TileModel {
  readonly meshes: readonly TileMesh[];

  constructor(
    readonly scene: Object3D,
    readonly table: TileTable,
  ) {
    const meshes: TileMesh[] = [];
    const all: Mesh[] = [];
    scene.traverse((node) => {
      if (isMesh(node)) all.push(node);
    });
    for (const mesh of all) {
      const material = mesh.material as MeshStandardMaterial;
      const { name } = material;
      const told = (material.userData.veduta as { provenance?: unknown } | undefined)?.provenance;
      // The faces are drawn flat; shadows are told from the surface's own by where its normals point.
      if (!mesh.geometry.hasAttribute("normal")) mesh.geometry.computeVertexNormals();
      mesh.castShadow = true;
      mesh.receiveShadow = true;
      meshes.push({
        mesh,
        kind: isSemanticClass(name) ? name : "other",
        provenance: isProvenance(told) ? told : "invented",
        own: material.color.getHex(),
        texture: material.map,
      });
    }
    this.meshes = meshes;
  }

  /** The row of the surface that a ray has hit. */
  rowOf(hit: Intersection): number | null {
    const mesh = hit.object as unknown as Mesh;
    if (hit.instanceId !== undefined) return rowAt(mesh, hit.instanceId);
    return hit.face ? rowAt(mesh, hit.face.a) : null;
  }

  /** What one bumps into, as a worker takes it. */
  pieces(): Piece[] {
    return this.meshes.flatMap(({ mesh }) => piecesOf(mesh));
  }

  /** The faces of one surface, or of all; positions in the world frame. */
  soup(row: number | null): Soup {
    const positions: number[] = [];
    const rows: number[] = [];
    for (const { mesh } of this.meshes) {
      if (isInstanced(mesh)) addInstances(mesh, row, positions, rows);
      else addFaces(mesh, mesh.matrixWorld, (vertex) => rowAt(mesh, vertex), row, positions, rows);
    }
    return {
      positions: new Float32Array(positions),
      partOfFace: new Uint32Array(rows.length),
      rowOfFace: new Uint32Array(rows),
      firstBoxFace: rows.length,
      instances: [],
    };
  }
}

/** The meshes and all their instances, which share their vertices. */
function piecesOf(mesh: Mesh): Piece[] {
  const { geometry } = mesh;
  const position = geometry.getAttribute("position");
  const index = geometry.getIndex();
  const shared = {
    positions: plain(position),
    faces: index === null ? Uint32Array.from({ length: position.count }, (_, k) => k) : Uint32Array.from(index.array),
  };
  if (!isInstanced(mesh)) return [{ ...shared, drawnFromMesh: mesh.matrixWorld.toArray() }];
  const matrix = new Matrix4();
  return Array.from({ length: mesh.count }, (_, instance) => {
    mesh.getMatrixAt(instance, matrix);
    return { ...shared, drawnFromMesh: matrix.premultiply(mesh.matrixWorld).toArray() };
  });
}

function isMesh(node: Object3D): node is Mesh {
  return (node as Partial<Mesh>).isMesh === true;
}

function isInstanced(mesh: Mesh): mesh is InstancedMesh {
  return mesh instanceof InstancedMesh;
}

function rowAt(mesh: Mesh, item: number): number {
  const attributes = mesh.geometry.attributes as Partial<Record<string, Column>>;
  const ids = attributes._feature_id_0 ?? attributes._FEATURE_ID_0;
  return ids === undefined ? 0 : Math.round(ids.getX(item));
}

function addInstances(mesh: InstancedMesh, row: number | null, positions: number[], rows: number[]): void {
  const matrix = new Matrix4();
  for (let instance = 0; instance < mesh.count; instance += 1) {
    const own = rowAt(mesh, instance);
    if (row !== null && own !== row) continue;
    mesh.getMatrixAt(instance, matrix);
    matrix.premultiply(mesh.matrixWorld);
    addFaces(mesh, matrix, () => own, null, positions, rows);
  }
}

function addFaces(
  mesh: Mesh,
  matrix: Matrix4,
  rowOf: (vertex: number) => number,
  only: number | null,
  positions: number[],
  rows: number[],
): void {
  const index = mesh.geometry.getIndex();
  const position = mesh.geometry.getAttribute("position");
  const count = index?.count ?? position.count;
  const corner = new Vector3();
  for (let k = 0; k + 2 < count; k += 3) {
    const own = rowOf(index?.getX(k) ?? k);
    if (only !== null && own !== only) continue;
    rows.push(own);
    for (let c = 0; c < 3; c += 1) {
      corner.fromBufferAttribute(position, index?.getX(k + c) ?? k + c).applyMatrix4(matrix);
      positions.push(...worldFromDrawn(corner.toArray()));
    }
  }
}
