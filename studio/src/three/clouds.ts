/** Clouds of points, in their own colours. */
import { type BufferGeometry, Group, Points, PointsMaterial, Vector3 } from "three";
import { PLYLoader } from "three/examples/jsm/loaders/PLYLoader.js";
import { Fault } from "../core/fault.ts";
import { drawnFromModel, worldFromDrawn } from "../core/frames.ts";
import { type Cloud, fileAddress } from "../core/place.ts";
import type { Layer } from "../core/state.ts";
import { fetchBytes } from "./fetch.ts";

const MAGIC = "ply";
const REMEDY = "Write the place again, for example with `veduta photos`.";

export async function loadClouds(
  clouds: readonly Cloud[],
  manifest: URL,
  onProgress: (share: number, file: string) => void,
): Promise<Group> {
  const group = new Group();
  for (const [index, cloud] of clouds.entries()) {
    const bytes = await fetchBytes(fileAddress(cloud.file, manifest), cloud.file, (got, total) => {
      onProgress((index + (total === null ? 0.5 : got / total)) / clouds.length, cloud.file);
    });
    const points = new Points(readPoints(bytes, cloud.file), makeMaterial());
    // The file is z-up like the place, so its own axes turn with it.
    points.rotation.x = -Math.PI / 2;
    const placed = new Group();
    placed.matrix.fromArray(drawnFromModel(cloud.worldFromPoints));
    placed.matrixAutoUpdate = false;
    placed.userData.layer = cloud.layer;
    placed.add(points);
    group.add(placed);
  }
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

function readPoints(bytes: ArrayBuffer, file: string): BufferGeometry {
  const magic = new TextDecoder().decode(bytes.slice(0, MAGIC.length));
  if (magic !== MAGIC) throw new Fault(file, "it is not a PLY file", REMEDY);
  try {
    const geometry = new PLYLoader().parse(bytes);
    if (!geometry.hasAttribute("position")) throw new Error("it has no points");
    return geometry;
  } catch (error) {
    const words = error instanceof Error ? error.message : String(error);
    throw new Fault(file, `the points cannot be read (${words})`, REMEDY);
  }
}
