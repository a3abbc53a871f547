/** A worker that gathers triangles and grows the tree over them, so that the page goes on being drawn. */
import { BufferAttribute, BufferGeometry } from "three";
import { MeshBVH, type SerializedBVH } from "three-mesh-bvh";
import { fillTriangles, type Piece } from "../core/triangles.ts";

export interface Asked {
  readonly id: number;
  readonly pieces: readonly Piece[];
  /** Nine coordinates per triangle that come after those of the pieces; world frame. */
  readonly more: Float32Array;
}

export interface Grown {
  readonly id: number;
  readonly positions: Float32Array;
  readonly tree: SerializedBVH;
}

/** What this file uses of a worker's scope, which the types of pages do not have. */
interface Scope {
  postMessage(message: Grown, moved: ArrayBufferLike[]): void;
  onmessage: ((event: MessageEvent<Asked>) => void) | null;
}

const scope = globalThis as unknown as Scope;

scope.onmessage = ({ data: { id, pieces, more } }) => {
  const own = pieces.reduce((corners, { faces }) => corners + faces.length, 0);
  const positions = new Float32Array(3 * own + more.length);
  fillTriangles(pieces, positions);
  positions.set(more, 3 * own);
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(positions, 3));
  // `indirect` leaves the triangles in the order of the soup.
  const tree = MeshBVH.serialize(new MeshBVH(geometry, { indirect: true }), { cloneBuffers: false });
  const indirect = tree.indirectBuffer === null ? [] : [tree.indirectBuffer.buffer];
  scope.postMessage({ id, positions, tree }, [positions.buffer, ...tree.roots, ...indirect]);
};
