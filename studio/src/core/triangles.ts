/** Triangles of meshes, one after another in the world frame. Runs in a worker too. */

/** A mesh: its vertices, three of them per face, and where it stands. */
export interface Piece {
  /** Three coordinates per vertex, in the mesh's frame. */
  readonly positions: Float32Array;
  readonly faces: Uint32Array;
  /** Column-major, affine; drawn frame (y up). */
  readonly drawnFromMesh: readonly number[];
}

/** Nine coordinates per face into `target`, from its start on; world frame (z up). */
export function fillTriangles(pieces: readonly Piece[], target: Float32Array): void {
  let next = 0;
  for (const { positions, faces, drawnFromMesh } of pieces) {
    const [a = 1, b = 0, c = 0, , d = 0, e = 1, f = 0, , g = 0, h = 0, i = 1, , x0 = 0, y0 = 0, z0 = 0] = drawnFromMesh;
    for (const vertex of faces) {
      const x = positions[3 * vertex] ?? 0;
      const y = positions[3 * vertex + 1] ?? 0;
      const z = positions[3 * vertex + 2] ?? 0;
      target[next] = a * x + d * y + g * z + x0;
      // From y up to z up, as `worldFromDrawn` has it.
      target[next + 1] = -(c * x + f * y + i * z + z0);
      target[next + 2] = b * x + e * y + h * z + y0;
      next += 3;
    }
  }
}
