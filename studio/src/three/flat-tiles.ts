/** 3D Tiles of a flat world, and the tables in them. */
import type { Tile } from "3d-tiles-renderer/core";
import { TilesRenderer } from "3d-tiles-renderer/three";
import { type BufferAttribute, type BufferGeometry, type InterleavedBufferAttribute, type Object3D, Sphere, Vector3 } from "three";
import type { GLTF } from "three/examples/jsm/loaders/GLTFLoader.js";
import type { Budget } from "../core/budget.ts";
import { TileTable } from "../core/tile-table.ts";
import type { Vec3 } from "../core/vector.ts";

interface VedutaTile extends Tile {
  extras?: { veduta?: { world_m?: readonly number[] } };
  transform?: number[];
}

/** Levels that differ from the truth by more are nothing to walk against. */
export const WALKABLE_ERROR_M = 1;
/** So far around the eye tiles come that are not seen: a visitor who runs takes some seconds to meet them (m). */
const AROUND_M = 12;

/** What the library finds of a tile: whether it is seen, and its error on the screen. */
export interface Seen {
  inView: boolean;
  error: number;
}

interface Placed extends Tile {
  engineData: { boundingVolume: { intersectsSphere(sphere: Sphere): boolean } };
}

/** The world frame is flat: tiles stand where the place's own frame has them, not on the globe. */
export class FlatTiles extends TilesRenderer {
  readonly #bytes = new WeakMap<Tile, number>();
  /** What is around a person, seen or not; world frame. */
  readonly #around = new Sphere(new Vector3(), AROUND_M);

  constructor(address: string, budget: Pick<Budget, "keptTiles_bytes" | "mostTiles_bytes">) {
    super(address);
    this.lruCache.minBytesSize = budget.keptTiles_bytes;
    this.lruCache.maxBytesSize = budget.mostTiles_bytes;
  }

  /** What is kept of tiles for the card, drawn or not. */
  get heldBytes(): number {
    // The types leave it out.
    return (this.lruCache as unknown as { cachedBytes: number }).cachedBytes;
  }

  /** Of the geometry alone: the library would count images again in each tile that shows them, and they are held once. */
  calculateBytesUsed(tile: Tile, scene: Object3D | null): number | null {
    if (scene !== null && !this.#bytes.has(tile)) this.#bytes.set(tile, geometryBytes(scene));
    return this.#bytes.get(tile) ?? null;
  }

  /** Where somebody is. */
  standAt(eye: Vec3): void {
    this.#around.center.set(...eye);
  }

  /** What one may bump into comes like what one sees: who steps back does not walk through what is behind. */
  calculateTileViewError(tile: Placed, target: Seen): void {
    // The types leave it out.
    (TilesRenderer.prototype as unknown as Looking).calculateTileViewError.call(this, tile, target);
    if (target.inView || !tile.engineData.boundingVolume.intersectsSphere(this.#around)) return;
    target.inView = true;
    target.error = tile.geometricError > WALKABLE_ERROR_M ? Infinity : 0;
  }

  preprocessNode(tile: VedutaTile, folder: string, parent: Tile | null = null): void {
    const at = tile.extras?.veduta?.world_m;
    if (at?.length === 3) {
      const [x = 0, y = 0, z = 0] = at;
      tile.transform = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, y, z, 1];
    }
    // The types leave it out; plugins and this class rely on it.
    (TilesRenderer.prototype as unknown as Preprocessing).preprocessNode.call(this, tile, folder, parent);
  }
}

interface Preprocessing {
  preprocessNode(this: FlatTiles, tile: Tile, folder: string, parent: Tile | null): void;
}

interface Looking {
  calculateTileViewError(this: FlatTiles, tile: Tile, target: Seen): void;
}

/** What the meshes of a tile take on the card; what two of them share counts once. */
export function geometryBytes(scene: Object3D): number {
  const arrays = new Set<ArrayBufferLike>();
  const add = (column: BufferAttribute | InterleavedBufferAttribute | null | undefined): void => {
    const array = column === null || column === undefined ? undefined : "data" in column ? column.data.array : column.array;
    if (array !== undefined) arrays.add(array.buffer);
  };
  scene.traverse((node) => {
    const { geometry, instanceMatrix } = node as { geometry?: BufferGeometry; instanceMatrix?: BufferAttribute };
    if (geometry === undefined) return;
    for (const column of Object.values(geometry.attributes)) add(column);
    add(geometry.getIndex());
    add(instanceMatrix);
  });
  let bytes = 0;
  for (const { byteLength } of arrays) bytes += byteLength;
  return bytes;
}

/** What the surfaces of a tile are, with nothing of its file held; `url` names it where it does not say. */
export function tableOf(gltf: GLTF, url: string): TileTable {
  const parser = gltf.parser as unknown as {
    json: { bufferViews: { byteOffset?: number; byteLength: number }[]; extensions?: Record<string, unknown> };
    extensions: Record<string, { body?: ArrayBuffer } | undefined>;
  };
  const body = parser.extensions.KHR_binary_glTF?.body ?? new ArrayBuffer(0);
  const views = (view: number): Uint8Array => {
    const { byteOffset = 0, byteLength } = parser.json.bufferViews[view] ?? { byteLength: 0 };
    return new Uint8Array(body, byteOffset, byteLength).slice();
  };
  return new TileTable(parser.json.extensions?.EXT_structural_metadata, views, url);
}
