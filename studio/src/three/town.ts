/**
 * A place that is too large to be loaded whole: 3D Tiles, fetched where the camera looks and as fine
 * as it sees. It answers what a click hits and what a walker bumps into, as `Solid` does, from the
 * tiles that are there.
 */
import type { Tile } from "3d-tiles-renderer/core";
import {
  Box3,
  Color,
  Group,
  type MeshStandardMaterial,
  type Object3D,
  type PerspectiveCamera,
  Raycaster,
  SRGBColorSpace,
  Vector3,
  type WebGLRenderer,
} from "three";
import { MeshoptDecoder } from "three/examples/jsm/libs/meshopt_decoder.module.js";
import { type GLTF, GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";
import { CLASS_LOOKS, PROVENANCE_LOOKS, type Provenance, type SemanticClass } from "../core/classes.ts";
import { Asking, type Missing } from "../core/asking.ts";
import type { Budget } from "../core/budget.ts";
import { Absent, Fault } from "../core/fault.ts";
import { drawnFromWorld, worldFromDrawn } from "../core/frames.ts";
import type { FeatureTable } from "../core/features.ts";
import type { Box } from "../core/framing.ts";
import type { FeatureRef, StudioState } from "../core/state.ts";
import type { Vec3 } from "../core/vector.ts";
import type { Body, Obstacles } from "../core/walking.ts";
import { FlatTiles, tableOf, WALKABLE_ERROR_M } from "./flat-tiles.ts";
import { layGround } from "./ground-material.ts";
import { type Hit, Solid } from "./solid.ts";
import { SharedImages } from "./shared-images.ts";
import { TileModel } from "./tile-model.ts";
import { TileSolids } from "./tile-solids.ts";

const COLOURING_STRENGTH = 0.78;
/** Whoever walks bumps into nothing of what is farther away before he has walked for some seconds (m). */
const AHEAD_M = 8;
const MOST_AHEAD = 3;
/** After so many rounds in which nothing is on its way nothing will come. */
const CALM_ROUNDS = 20;
/** Plainer tiles than with an error of so much on the screen there are not. */
const PLAINEST_PX = 1000;
/** The first picture is made of tiles that are so much plainer: it comes sooner, and finer ones follow at once. */
const FIRST_PLAINER = 8;
/** Of a tile that was dropped; what is chosen keeps its number. */
const GONE: FeatureTable = { rows: [] };

/** A tile that is there. */
interface Loaded {
  readonly model: TileModel;
  readonly part: number;
  readonly tile: Tile;
  /** Around it, world frame; null before anybody has asked. */
  box: Box3 | null;
}

export class Town implements Obstacles {
  readonly group = new Group();
  bounds: Box = { min: [-1, -1, 0], max: [1, 1, 1] };
  readonly tables: FeatureTable[] = [];
  readonly #tiles: FlatTiles;
  readonly #models = new Map<Object3D, Loaded>();
  readonly #floors = new Map<Object3D, Solid>();
  readonly #byPart: (TileModel | undefined)[] = [];
  readonly #solids = new TileSolids();
  readonly #images: SharedImages;
  readonly #onChange: () => void;
  readonly #error_px: number;
  /** What is asked for while finer tiles do not come. */
  #plain_px: number;
  readonly #failed = new Set<Tile>();
  #changes = 0;
  readonly #missing = new Map<string, Fault>();
  /** Of the place: files are named as they lie in it. */
  readonly #folder: string;
  readonly #asking = new Asking(() => this.#askAgain());
  #state: StudioState | null = null;

  /** `onShown` is called when other tiles are shown than before. */
  constructor(address: URL, budget: Budget, onChange: () => void, onShown: () => void) {
    this.#onChange = onChange;
    this.#folder = new URL("..", address).href;
    this.#tiles = new FlatTiles(address.href, budget);
    this.#images = new SharedImages(budget.mostTexture_px);
    this.#error_px = budget.tileError_px;
    this.#plain_px = this.#error_px;
    this.#tiles.errorTarget = this.#error_px;
    const loader = new GLTFLoader(this.#tiles.manager).setMeshoptDecoder(MeshoptDecoder);
    loader.register((parser) => this.#images.pluginOf(parser));
    this.#tiles.manager.addHandler(/\.(gltf|glb)$/i, loader);
    this.#tiles.group.rotation.x = -Math.PI / 2;
    this.group.add(this.#tiles.group);
    this.group.updateMatrixWorld(true);
    this.#tiles.addEventListener("load-model", ({ scene, tile, url }) => {
      this.#take(scene, tile, url);
    });
    this.#tiles.addEventListener("dispose-model", ({ scene }) => this.#drop(scene));
    this.#tiles.addEventListener("load-error", ({ tile, error, url }) => {
      if (tile !== null) this.#failed.add(tile);
      this.#tiles.errorTarget = this.#plain_px;
      this.#missing.set(String(url), new Absent(this.#nameOf(String(url)), error.message, "Check that the server still runs (`veduta view`)."));
      this.#asking.failed();
      onShown();
    });
    this.#tiles.addEventListener("tile-visibility-change", () => {
      this.#changes += 1;
      onShown();
    });
    for (const kind of ["tile-visibility-change", "needs-update", "load-tileset"] as const) {
      this.#tiles.addEventListener(kind, onChange);
    }
  }

  /** Fetches the tree, which says how large the place is. */
  async open(onProgress: (share: number) => void): Promise<void> {
    const box = new Box3();
    while (!this.#tiles.getBoundingBox(box)) {
      this.#stopAtFault();
      this.#advance();
      await pause();
    }
    this.bounds = { min: box.min.toArray(), max: box.max.toArray() };
    onProgress(0.3);
  }

  /** Waits until something of what is seen now is there: the rest comes while one looks. */
  async settle(camera: PerspectiveCamera): Promise<void> {
    this.#tiles.setCamera(camera);
    this.#tiles.setResolution(camera, 1280, 800);
    camera.updateMatrixWorld();
    this.#tiles.errorTarget = FIRST_PLAINER * this.#error_px;
    for (let calm = 0; this.tileCount === 0; ) {
      calm = this.isLoading ? 0 : calm + 1;
      if (calm > CALM_ROUNDS) {
        // Where the tiles that are fine enough did not come, plainer ones may.
        if (this.#tiles.errorTarget > PLAINEST_PX) this.#stopAtFault();
        this.#tiles.errorTarget *= 4;
        this.#plain_px = this.#tiles.errorTarget;
        calm = 0;
      }
      this.#advance();
      await pause();
    }
    this.#tiles.errorTarget = this.#plain_px;
  }

  get isLoading(): boolean {
    // The types leave it out.
    const { stats } = this.#tiles as unknown as { stats: Partial<Record<string, number>> };
    const { downloading, parsing, queued } = stats;
    return (downloading ?? 0) + (parsing ?? 0) + (queued ?? 0) > 0;
  }

  /** Tiles that did not come. */
  get missing(): Missing[] {
    return [...this.#missing].map(([url, fault]) => ({ file: this.#nameOf(url), fault }));
  }

  /** Does not wait for the end of a pause. */
  askNow(): void {
    this.#asking.now();
  }

  /** What is kept of tiles for the card, drawn or not. */
  get heldBytes(): number {
    return this.#tiles.heldBytes;
  }

  /** Tiles that are drawn now. */
  get tileCount(): number {
    return this.#tiles.visibleTiles.size;
  }

  /** How often other tiles have been shown than before. */
  get changes(): number {
    return this.#changes;
  }

  get faceCount(): number {
    let faces = 0;
    for (const { model } of this.#shown()) {
      for (const { mesh } of model.meshes) {
        const count = (mesh as { count?: number }).count ?? 1;
        faces += ((mesh.geometry.getIndex()?.count ?? 0) / 3) * count;
      }
    }
    return faces;
  }

  update(camera: PerspectiveCamera, renderer: WebGLRenderer): void {
    camera.updateMatrixWorld();
    this.#tiles.setResolutionFromRenderer(camera, renderer);
    const eye = worldFromDrawn(camera.position.toArray());
    this.#tiles.standAt(eye);
    if (this.#state?.mode === "walk") this.#growAhead(eye);
    this.#advance();
  }

  classOf(ref: FeatureRef): SemanticClass | null {
    return this.#byPart[ref.part]?.table.classOf(ref.row) ?? null;
  }

  nameOf(ref: FeatureRef): string {
    return this.#byPart[ref.part]?.table.buildingOf(ref.row) ?? "";
  }

  /** How many surfaces of each class are drawn. */
  counts(): Map<SemanticClass, number> {
    const all = new Map<SemanticClass, number>();
    for (const { model } of this.#shown()) {
      for (const [kind, count] of model.table.counts()) all.set(kind, (all.get(kind) ?? 0) + count);
    }
    return all;
  }

  /** How many surfaces of each provenance are drawn. */
  provenances(): Map<Provenance, number> {
    const all = new Map<Provenance, number>();
    for (const { model } of this.#shown()) {
      for (const [kind, count] of model.table.provenances()) all.set(kind, (all.get(kind) ?? 0) + count);
    }
    return all;
  }

  /** The first visible surface on the ray; `direction` is a unit vector. */
  firstHit(origin: Vec3, direction: Vec3, isVisible: (feature: FeatureRef) => boolean): Hit | null {
    const from = new Vector3(...drawnFromWorld(origin));
    const caster = new Raycaster(from, new Vector3(...drawnFromWorld(direction)));
    for (const hit of caster.intersectObject(this.#tiles.group, true)) {
      const known = this.#ownerOf(hit.object);
      const row = known?.model.rowOf(hit) ?? null;
      if (known === null || row === null) continue;
      const feature = { part: known.part, row };
      if (isVisible(feature)) {
        return { feature, point: worldFromDrawn(hit.point.toArray()), distance_m: hit.distance };
      }
    }
    return null;
  }

  pushOut(feet: Vec3, body: Body): Vec3 | null {
    let push: Vec3 | null = null;
    for (const solid of this.#near(feet, body)) {
      const more = solid.pushOut(push === null ? feet : added(feet, push), body);
      if (more !== null) push = push === null ? more : added(push, more);
    }
    return push;
  }

  groundAt(x: number, y: number): number | null {
    let highest: number | null = null;
    for (const floor of this.#floors.values()) {
      const { min, max } = floor.bounds;
      if (x < min[0] || y < min[1] || x > max[0] || y > max[1]) continue;
      const height = floor.topAt(x, y);
      if (height !== null) highest = Math.max(highest ?? height, height);
    }
    return highest;
  }

  /** Hides layers and colours surfaces as the state says. */
  show(state: StudioState): void {
    this.#state = state;
    for (const { model } of this.#models.values()) dress(model, state);
  }

  /** The faces of a surface, world frame; null where its tile is gone. */
  facesOf(ref: FeatureRef): Float32Array | null {
    return this.#byPart[ref.part]?.soup(ref.row).positions ?? null;
  }

  dispose(): void {
    this.#asking.dispose();
    this.#solids.dispose();
    this.#tiles.dispose();
    this.#images.dispose();
  }

  #advance(): void {
    // The library takes a tile that it wants to show for shown while that is on its way (0.4.26), and
    // would then leave it out when it is there.
    for (const { tile } of this.#models.values()) {
      // The types leave it out.
      const traversal = tile.traversal as unknown as { wasSetVisible: boolean };
      if (traversal.wasSetVisible && !this.#tiles.visibleTiles.has(tile)) traversal.wasSetVisible = false;
    }
    this.#tiles.update();
  }

  #nameOf(url: string): string {
    return url.startsWith(this.#folder) ? decodeURIComponent(url.slice(this.#folder.length)) : url;
  }

  #askAgain(): void {
    this.#missing.clear();
    this.#tiles.errorTarget = this.#error_px;
    // The library keeps a place in its cache for a tile that failed, and would not fetch it again (0.4.26).
    for (const tile of this.#failed) this.#tiles.lruCache.remove(tile);
    this.#failed.clear();
    this.#tiles.resetFailedTiles();
    this.#onChange();
  }

  #take(scene: Object3D, tile: Tile, url: string): void {
    this.#asking.succeeded();
    try {
      const { engineData } = tile as unknown as { engineData: { metadata: GLTF | null } };
      if (engineData.metadata === null) return;
      const model = new TileModel(scene, tableOf(engineData.metadata, url));
      engineData.metadata = null; // the file itself, which nobody asks for again
      const part = this.#byPart.length;
      this.#byPart.push(model);
      this.tables.push(model.table);
      this.#models.set(scene, { model, part, tile, box: null });
      if (model.meshes.every(({ kind }) => kind === "ground")) {
        this.#floors.set(scene, this.#inPlace(scene, () => new Solid(model.soup(null))));
        for (const { mesh } of model.meshes) layGround(mesh);
      }
      if (this.#state !== null) dress(model, this.#state);
    } catch (error) {
      if (!(error instanceof Fault)) throw error;
      this.#missing.set(url, error);
    }
    this.#onChange();
  }

  #drop(scene: Object3D): void {
    const known = this.#models.get(scene);
    if (known !== undefined) {
      this.#byPart[known.part] = undefined;
      this.tables[known.part] = GONE;
    }
    this.#models.delete(scene);
    this.#solids.drop(scene);
    this.#floors.delete(scene);
  }

  *#shown(): Generator<{ model: TileModel; part: number }> {
    const { visibleTiles } = this.#tiles;
    for (const known of this.#models.values()) if (visibleTiles.has(known.tile)) yield known;
  }

  #ownerOf(object: Object3D): { model: TileModel; part: number } | null {
    let at: Object3D | null = object;
    while (at !== null) {
      const known = this.#models.get(at);
      if (known !== undefined) return known;
      at = at.parent;
    }
    return null;
  }

  /** What stands around a body: of each tile there the plainest level that can be walked against. */
  *#near(feet: Vec3, body: Body): Generator<Solid> {
    const reach = new Box3(
      new Vector3(feet[0] - body.radius_m, feet[1] - body.radius_m, feet[2]),
      new Vector3(feet[0] + body.radius_m, feet[1] + body.radius_m, feet[2] + body.height_m),
    );
    for (const [scene, { model }] of this.#within(reach)) {
      yield this.#solids.of(scene, () => this.#inPlace(scene, () => model.pieces()));
    }
  }

  /** What can be walked against and stands within a box, world frame. */
  *#within(reach: Box3): Generator<[Object3D, Loaded]> {
    for (const [scene, known] of this.#models) {
      const { tile } = known;
      // Where nothing finer has come yet, what is drawn stops a walker, too.
      const isWalkable = tile.geometricError <= WALKABLE_ERROR_M ? !this.#isCovered(tile) : this.#tiles.visibleTiles.has(tile);
      if (!isWalkable) continue;
      known.box ??= this.#inPlace(scene, () => worldBoxOf(scene));
      if (known.box.intersectsBox(reach)) yield [scene, known];
    }
  }

  /** Lets a worker grow what a walker may soon bump into. */
  #growAhead(eye: Vec3): void {
    const reach = new Box3().setFromCenterAndSize(new Vector3(...eye), new Vector3(2 * AHEAD_M, 2 * AHEAD_M, 2 * AHEAD_M));
    const at = new Vector3(...eye);
    const away = ({ box }: Loaded): number => box?.distanceToPoint(at) ?? 0;
    // The nearest few alone: more than are kept would push each other out, and be grown anew for each picture.
    for (const [scene, { model }] of [...this.#within(reach)].sort(([, a], [, b]) => away(a) - away(b)).slice(0, MOST_AHEAD)) {
      this.#solids.growAhead(scene, () => this.#inPlace(scene, () => model.pieces()));
    }
  }

  /** Whether the tile above is loaded and can be walked against: it has fewer faces. */
  #isCovered(tile: Tile): boolean {
    const above = tile.parent;
    if (above === null || above.geometricError > WALKABLE_ERROR_M) return false;
    const { scene } = (above as unknown as { engineData: { scene: Object3D | null } }).engineData;
    return scene !== null && this.#models.has(scene);
  }

  /** A tile that is loaded but not drawn hangs nowhere: where it stands shows below the group only. */
  #inPlace<T>(scene: Object3D, look: () => T): T {
    const isLoose = scene.parent === null;
    if (isLoose) this.#tiles.group.add(scene);
    scene.updateMatrixWorld(true);
    const seen = look();
    if (isLoose) this.#tiles.group.remove(scene);
    return seen;
  }

  /** There is nothing to show without what is missing. */
  #stopAtFault(): void {
    const [first] = this.#missing.values();
    if (first !== undefined) throw first;
  }
}

function dress(model: TileModel, state: StudioState): void {
  for (const { mesh, kind, provenance, own, texture } of model.meshes) {
    mesh.visible = !state.hidden.has(kind);
    const material = mesh.material as MeshStandardMaterial;
    material.color.setHex(own);
    const map = state.colouring === "photo" ? texture : null;
    if (material.map !== map) {
      material.map = map;
      material.needsUpdate = true;
    }
    if (state.colouring === "photo") continue;
    const look = state.colouring === "class" ? CLASS_LOOKS[kind] : PROVENANCE_LOOKS[provenance];
    material.color.lerp(new Color().setStyle(look.colour, SRGBColorSpace), COLOURING_STRENGTH);
  }
}

function worldBoxOf(scene: Object3D): Box3 {
  const { min, max } = new Box3().setFromObject(scene);
  const corners = [min, max].map((corner) => new Vector3(...worldFromDrawn(corner.toArray())));
  return new Box3().setFromPoints(corners);
}

function added(a: Vec3, b: Vec3): Vec3 {
  return [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
}

async function pause(): Promise<void> {
  await new Promise((resolve) => setTimeout(resolve, 30));
}
