/** Loading what a walk needs near the person: the models of transitions, and the pictures of stations. */
import { BufferAttribute, BufferGeometry, Mesh, NoColorSpace, Texture } from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { Fault } from "../core/fault.ts";
import { type MorphWalk, nearTransitions, placeOn } from "../core/morph-walk.ts";
import { fileAddress } from "../core/place.ts";
import type { Wish, Wishes } from "../core/wishes.ts";
import { bitmapTexture } from "./bitmap-texture.ts";
import { fetchBytes } from "./fetch.ts";
import { HandingOver, OneByOne } from "./handing-over.ts";
import { within } from "./limited-image.ts";

const REMEDY = "Write the walk again with `veduta walk`.";

/** One end's model: what was seen there, what spans breaks in depth, and what is elsewhere in the other view. */
export interface EndModel {
  readonly seen: BufferGeometry;
  readonly torn: BufferGeometry;
  readonly moving: BufferGeometry;
}

/** Both models of a transition; null while they are on their way, or where it does not morph. */
export interface WayModels {
  readonly forth: EndModel;
  readonly back: EndModel;
}

/** What is asked for while one is near it; null until it has come. */
interface Near<T> {
  came: T | null;
  wishes: readonly Wish[];
}

export class MorphFiles {
  readonly #walk: MorphWalk;
  readonly #manifest: URL;
  readonly #onArrival: () => void;
  readonly #most_px: number;
  readonly #wishes: Wishes;
  readonly #ways = new Map<number, Near<WayModels>>();
  readonly #pictures = new Map<number, Near<Texture>>();
  #wanted = new Set<number>();
  readonly #fresh = new HandingOver();
  readonly #reading = new OneByOne();

  constructor(walk: MorphWalk, manifest: URL, most_px: number, onArrival: () => void, wishes: Wishes) {
    this.#walk = walk;
    this.#manifest = manifest;
    this.#onArrival = onArrival;
    this.#most_px = most_px;
    this.#wishes = wishes;
  }

  way(transition: number): WayModels | null {
    return this.#ways.get(transition)?.came ?? null;
  }

  picture(station: number): Texture | null {
    return this.#pictures.get(station)?.came ?? null;
  }

  /** Gives the card one piece of what has come; changes the renderer's target. */
  handOver(renderer: Parameters<HandingOver["giveOne"]>[0]): void {
    if (this.#fresh.count === 0) return;
    this.#fresh.giveOne(renderer);
    if (this.#fresh.count > 0) this.#onArrival();
  }

  /** How many models of transitions are held. */
  get held(): number {
    return this.#ways.size;
  }

  /** How many models and pictures are on their way. */
  get waiting(): number {
    const near = [...this.#ways.values(), ...this.#pictures.values()];
    return near.flatMap(({ wishes }) => wishes).filter(({ isUnderway }) => isUnderway).length;
  }

  /** On the card: models as they are, pictures with their smaller ones. */
  get bytes(): number {
    let sum = 0;
    for (const { came } of this.#ways.values()) {
      for (const end of endsOf(came)) sum += bytesOf(end.seen) + bytesOf(end.torn) + bytesOf(end.moving);
    }
    for (const { came } of this.#pictures.values()) {
      const { width, height } = (came?.image ?? { width: 0, height: 0 }) as ImageBitmap;
      sum += (width * height * 4 * 4) / 3;
    }
    return Math.round(sum);
  }

  /** Asks for what is near, and lets go of the rest. */
  follow(at: number): void {
    const near = nearTransitions(this.#walk, at);
    this.#wanted = new Set(near);
    const stations = new Set(near.flatMap((n) => [this.#walk.transitions[n]?.start ?? 0, this.#walk.transitions[n]?.end ?? 0]));
    if (near.length === 0) stations.add(0);
    for (const [transition, { came, wishes }] of this.#ways) {
      if (this.#wanted.has(transition)) continue;
      this.#ways.delete(transition);
      for (const wish of wishes) wish.drop();
      for (const end of endsOf(came)) dispose(end);
    }
    for (const [station, { came, wishes }] of this.#pictures) {
      if (stations.has(station)) continue;
      this.#pictures.delete(station);
      for (const wish of wishes) wish.drop();
      came?.dispose();
    }
    for (const station of stations) if (!this.#pictures.has(station)) void this.#bringPicture(station);
    for (const transition of near) if (!this.#ways.has(transition)) void this.#bringWay(transition);
  }

  /** Until the picture of the station next to a place is there; what leads to others comes after it. */
  async settle(at: number): Promise<void> {
    const { transition, m } = placeOn(this.#walk, at);
    const way = this.#walk.transitions[transition];
    const station = (m < 0.5 ? way?.start : way?.end) ?? 0;
    if (!this.#pictures.has(station)) await this.#bringPicture(station);
    this.follow(at);
  }

  dispose(): void {
    this.#wanted.clear();
    for (const { came } of this.#ways.values()) for (const end of endsOf(came)) dispose(end);
    for (const { came } of this.#pictures.values()) came?.dispose();
    this.#ways.clear();
    this.#pictures.clear();
    this.#fresh.dispose();
  }

  /** What does not come stays null, so that nobody but `wishes` asks for it again. */
  async #bringWay(transition: number): Promise<void> {
    const { forth, back } = this.#walk.transitions[transition] ?? {};
    if (forth === null || forth === undefined || back === null || back === undefined) return;
    const own: Near<WayModels> = { came: null, wishes: [] };
    this.#ways.set(transition, own);
    const came: Partial<Record<"forth" | "back", EndModel>> = {};
    const take = (end: "forth" | "back", model: EndModel): void => {
      came[end] = model;
      if (came.forth === undefined || came.back === undefined) return;
      const models = { forth: came.forth, back: came.back };
      const now = this.#ways.get(transition);
      if (now?.came === null && this.#wanted.has(transition)) {
        now.came = models;
        this.#fresh.add(...endsOf(models).flatMap(({ seen, torn, moving }) => [seen, torn, moving]));
      } else for (const one of endsOf(models)) dispose(one);
      this.#onArrival();
    };
    own.wishes = ([["forth", forth], ["back", back]] as const).map(([end, file]) =>
      this.#wishes.bring(file, async () => await this.#model(file, () => this.#ways.get(transition) === own), (model) => take(end, model)),
    );
    await Promise.all(own.wishes.map(async ({ tried }) => await tried));
  }

  async #bringPicture(station: number): Promise<void> {
    const file = this.#walk.stations[station]?.picture;
    if (file === undefined) return;
    const own: Near<Texture> = { came: null, wishes: [] };
    this.#pictures.set(station, own);
    const wish = this.#wishes.bring(file, async () => await this.#bitmap(file, () => this.#pictures.get(station) === own), (bitmap) => {
      const texture = bitmapTexture(bitmap, NoColorSpace);
      const now = this.#pictures.get(station);
      if (now?.came === null) {
        now.came = texture;
        this.#fresh.add(texture);
      } else texture.dispose();
      this.#onArrival();
    });
    own.wishes = [wish];
    await wish.tried;
  }

  async #bitmap(file: string, isWanted: () => boolean): Promise<ImageBitmap> {
    const bytes = await fetchBytes(fileAddress(file, this.#manifest), file, () => undefined);
    return await this.#reading.do(async () => {
      const bitmap = await createImageBitmap(new Blob([bytes])).catch(() => {
        throw new Fault(file, "the picture cannot be read", REMEDY);
      });
      return await within(bitmap, this.#most_px);
    }, isWanted);
  }

  async #model(file: string, isWanted: () => boolean): Promise<EndModel> {
    const bytes = await fetchBytes(fileAddress(file, this.#manifest), file, () => undefined);
    const loader = new GLTFLoader();
    // The picture is for other programs: here one is shared by all models of its station.
    loader.register(() => ({ name: "EXT_texture_webp", loadTexture: async () => await Promise.resolve(new Texture()) }));
    const { scene } = await this.#reading.do(async () => await loader.parseAsync(bytes, ""), isWanted).catch((error: unknown) => {
      throw new Fault(file, `the model is broken (${error instanceof Error ? error.message : String(error)})`, REMEDY);
    });
    const geometries = new Map<string, BufferGeometry>();
    scene.traverse((node) => {
      if (!(node instanceof Mesh)) return;
      const mesh = node as Mesh;
      const material = [mesh.material].flat()[0];
      geometries.set(material?.name ?? "", taken(mesh.geometry, file));
      material?.dispose();
    });
    const seen = geometries.get("seen");
    if (seen === undefined) throw new Fault(file, "it holds no surface that was seen", REMEDY);
    const others = ["between", "moving"].map((name) => geometries.get(name) ?? new BufferGeometry());
    const [torn = new BufferGeometry(), moving = new BufferGeometry()] = others;
    return { seen, torn, moving };
  }
}

function endsOf(models: WayModels | null): readonly EndModel[] {
  return models === null ? [] : [models.forth, models.back];
}

/** The columns under the names that the shaders have for them. */
function taken(geometry: BufferGeometry, file: string): BufferGeometry {
  const column = (name: string): BufferAttribute => {
    const attribute = geometry.getAttribute(name);
    if (attribute instanceof BufferAttribute) return attribute;
    throw new Fault(file, `its mesh has no ${name}`, REMEDY);
  };
  const moved = geometry.morphAttributes.position?.[0];
  if (!(moved instanceof BufferAttribute)) throw new Fault(file, "its mesh does not morph", REMEDY);
  const own = new BufferGeometry();
  own.setIndex(geometry.index);
  own.setAttribute("position", column("position"));
  own.setAttribute("uv", column("uv"));
  own.setAttribute("uvThere", column("uv1"));
  own.setAttribute("psi", column("_psi"));
  own.setAttribute("moved", moved);
  return own;
}

function bytesOf(geometry: BufferGeometry): number {
  const columns = [...Object.values(geometry.attributes), ...(geometry.index === null ? [] : [geometry.index])];
  return columns.reduce((sum, column) => sum + column.array.byteLength, 0);
}

function dispose({ seen, torn, moving }: EndModel): void {
  for (const geometry of [seen, torn, moving]) geometry.dispose();
}
