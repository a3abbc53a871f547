/** What one bumps into in a town: solids of the tiles near by, grown in a worker before one gets there. */
import type { Object3D } from "three";
import { fillTriangles, type Piece } from "../core/triangles.ts";
import { hireForSolids } from "./grower.ts";
import { type Help, Helper } from "./hired.ts";
import { Solid } from "./solid.ts";
import type { Asked, Grown } from "./soup-worker.ts";

/** Those of so many tiles are kept. */
const MOST_SOLIDS = 6;
const NOTHING = new Float32Array(0);

export class TileSolids {
  readonly #solids = new Map<Object3D, Solid>();
  readonly #growing = new Set<Object3D>();
  readonly #helper: Helper<Asked, Grown>;

  /** `hire` starts a worker; null where there can be none. */
  constructor(hire: () => Help | null = hireForSolids) {
    this.#helper = new Helper(hire);
  }

  /** At once: of a tile that nobody has grown ahead, too. `piecesOf` is asked for its faces where they are wanted. */
  of(scene: Object3D, piecesOf: () => Piece[]): Solid {
    const known = this.#solids.get(scene);
    if (known !== undefined) return known;
    const pieces = piecesOf();
    const positions = new Float32Array(9 * facesOf(pieces));
    fillTriangles(pieces, positions);
    return this.#keep(scene, solidOf(positions, null));
  }

  /** Grows the solid of a tile to which somebody is on his way. `piecesOf` is asked for its faces where they are wanted. */
  growAhead(scene: Object3D, piecesOf: () => Piece[]): void {
    // Without a worker it is made when it is needed: its faces are not even copied before.
    if (this.has(scene) || !this.#helper.isThere) return;
    this.#growing.add(scene);
    void this.#helper.ask({ pieces: piecesOf(), more: NOTHING }).then((grown) => {
      // What was dropped or grown meanwhile is not wanted.
      if (!this.#growing.delete(scene) || grown === null || this.#solids.has(scene)) return;
      this.#keep(scene, solidOf(grown.positions, grown.tree));
    });
  }

  /** Whether it can be told what of the tile one bumps into without doing anything for it. */
  has(scene: Object3D): boolean {
    const known = this.#solids.get(scene);
    if (known === undefined) return this.#growing.has(scene);
    // The most recently used is the last.
    this.#solids.delete(scene);
    this.#solids.set(scene, known);
    return true;
  }

  drop(scene: Object3D): void {
    this.#solids.delete(scene);
    this.#growing.delete(scene);
  }

  dispose(): void {
    this.#helper.dispose();
  }

  #keep(scene: Object3D, solid: Solid): Solid {
    this.#solids.set(scene, solid);
    const [oldest] = this.#solids.keys();
    if (this.#solids.size > MOST_SOLIDS && oldest !== undefined) this.#solids.delete(oldest);
    return solid;
  }
}

function facesOf(pieces: readonly Piece[]): number {
  return pieces.reduce((sum, { faces }) => sum + faces.length / 3, 0);
}

/** Whose the faces are nobody asks who bumps into them. */
function solidOf(positions: Float32Array, tree: Grown["tree"] | null): Solid {
  const count = positions.length / 9;
  const owners = new Uint32Array(count);
  return new Solid({ positions, partOfFace: owners, rowOfFace: owners, firstBoxFace: count, instances: [] }, null, tree);
}
