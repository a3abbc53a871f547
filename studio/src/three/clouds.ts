/** Clouds of points, in their own colours. */
import { type BufferGeometry, Group, Points, PointsMaterial } from "three";
import { PLYLoader } from "three/examples/jsm/loaders/PLYLoader.js";
import { Fault } from "../core/fault.ts";
import { drawnFromModel } from "../core/frames.ts";
import { type Cloud, fileAddress } from "../core/place.ts";
import { fetchBytes } from "./fetch.ts";

/** CSS pixels; points keep their size, so that a cloud is dense from afar and open from near. */
const POINT_PX = 2.5;
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
    placed.add(points);
    group.add(placed);
  }
  return group;
}

function makeMaterial(): PointsMaterial {
  return new PointsMaterial({
    size: POINT_PX * Math.min(devicePixelRatio, 2),
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
