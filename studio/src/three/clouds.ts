/** Clouds of points, in their own colours. */
import { type BufferGeometry, Group, Points, PointsMaterial, Vector3 } from "three";
import { Asking, type Missing, PAGE, type Surroundings } from "../core/asking.ts";
import { Absent, Fault, faultOf } from "../core/fault.ts";
import { drawnFromModel, worldFromDrawn } from "../core/frames.ts";
import { type Cloud, fileAddress } from "../core/place.ts";
import type { Layer } from "../core/state.ts";
import { fetchBytes } from "./fetch.ts";
import { PointReader } from "./points.ts";

/** The clouds of a place on their way, one after the other. One that does not come is asked for again; one that is broken is left out. */
export class CloudArrivals {
  /** Those that have come. */
  readonly group = new Group();
  readonly #clouds: readonly Cloud[];
  readonly #manifest: URL;
  readonly #onChange: () => void;
  readonly #asking: Asking;
  readonly #reader = new PointReader();
  readonly #missing = new Map<number, Fault>();
  readonly #underway = new Set<number>();
  #tried = 0;

  /** `onChange` is called when one that had not come was asked for again. */
  constructor(clouds: readonly Cloud[], manifest: URL, onChange: () => void, around: Surroundings = PAGE) {
    this.#clouds = clouds;
    this.#manifest = manifest;
    this.#onChange = onChange;
    this.#asking = new Asking(() => void this.#askAgain(), around);
  }

  /** How many have not been asked for yet. */
  get waiting(): number {
    return this.#clouds.length - this.#tried;
  }

  get missing(): Missing[] {
    return [...this.#missing].map(([index, fault]) => ({ file: this.#clouds[index]?.file ?? "", fault }));
  }

  /** Does not wait for the end of a pause. */
  askNow(): void {
    this.#asking.now();
  }

  /** To be called once; the result comes when each was asked for. */
  async bring(onProgress: (share: number, file: string) => void): Promise<void> {
    for (const [index, { file }] of this.#clouds.entries()) {
      await this.#try(index, (share) => onProgress((index + share) / this.#clouds.length, file));
      this.#tried = index + 1;
    }
  }

  dispose(): void {
    this.#asking.dispose();
    this.#reader.dispose();
  }

  async #try(index: number, onShare: (share: number) => void): Promise<void> {
    const cloud = this.#clouds[index];
    if (cloud === undefined || this.#underway.has(index)) return;
    this.#underway.add(index);
    try {
      this.group.add(placed(await this.#read(cloud, onShare), cloud));
      this.#missing.delete(index);
      this.#asking.succeeded();
    } catch (error) {
      const told = faultOf(error);
      this.#missing.set(index, told instanceof Absent ? told : new Fault(cloud.file, told.fault, told.remedy));
      // What is broken is as broken the next time.
      if (told instanceof Absent) this.#asking.failed();
    }
    this.#underway.delete(index);
  }

  async #askAgain(): Promise<void> {
    // One that has come while others were asked for is not asked for again.
    for (const index of [...this.#missing.keys()]) if (this.#missing.get(index) instanceof Absent) await this.#try(index, () => undefined);
    this.#onChange();
  }

  async #read(cloud: Cloud, onShare: (share: number) => void): Promise<BufferGeometry> {
    const bytes = await fetchBytes(fileAddress(cloud.file, this.#manifest), cloud.file, (got, total) => {
      onShare(total === null ? 0.5 : got / total);
    });
    return await this.#reader.read(bytes, cloud);
  }
}

function placed(geometry: BufferGeometry, { worldFromPoints, layer }: Cloud): Group {
  const points = new Points(geometry, makeMaterial());
  // The file is z-up like the place, so its own axes turn with it.
  points.rotation.x = -Math.PI / 2;
  const group = new Group();
  group.matrix.fromArray(drawnFromModel(worldFromPoints));
  group.matrixAutoUpdate = false;
  group.userData.layer = layer;
  group.add(points);
  return group;
}

/** Distances are shown in place of the points whose places they have. */
export function showClouds(clouds: Group, off: ReadonlySet<Layer>): void {
  const layers = new Set(clouds.children.map(({ userData }) => userData.layer as Layer));
  const distances = layers.has("distances") && !off.has("distances");
  for (const cloud of clouds.children) {
    cloud.visible = cloud.userData.layer === "distances" ? distances : !distances && !off.has("points");
  }
}

/** `px` CSS pixels; points keep their size, so that a cloud is dense from afar and open from near. */
export function sizePoints(clouds: Group, px: number): void {
  for (const points of pointsOf(clouds)) points.material.size = px * Math.min(devicePixelRatio, 2);
}

/** Points of all clouds, evenly taken: three numbers each, world frame. */
export function samplePoints(clouds: Group, most: number): Float32Array {
  const all = pointsOf(clouds);
  const count = all.reduce((sum, { geometry }) => sum + geometry.getAttribute("position").count, 0);
  const stride = Math.max(1, Math.ceil(count / most));
  clouds.updateMatrixWorld(true);
  const sampled: number[] = [];
  const point = new Vector3();
  for (const points of all) {
    const position = points.geometry.getAttribute("position");
    for (let i = 0; i < position.count; i += stride) {
      point.fromBufferAttribute(position, i).applyMatrix4(points.matrixWorld);
      sampled.push(...worldFromDrawn(point.toArray()));
    }
  }
  return new Float32Array(sampled);
}

function pointsOf(clouds: Group): Points<BufferGeometry, PointsMaterial>[] {
  const found: Points<BufferGeometry, PointsMaterial>[] = [];
  clouds.traverse((node) => {
    if (node instanceof Points) found.push(node as Points<BufferGeometry, PointsMaterial>);
  });
  return found;
}

function makeMaterial(): PointsMaterial {
  return new PointsMaterial({
    sizeAttenuation: false,
    vertexColors: true,
    // The photos' colours as they are.
    toneMapped: false,
  });
}
