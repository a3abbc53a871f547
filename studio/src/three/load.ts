/** From the place to parts that can be drawn. */
import { type AnimationClip, Group, InstancedMesh, Light, Mesh, Texture } from "three";
import { type GLTF, GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";
import { areDrawnOnly, readFeatureTable, type FeatureTable } from "../core/features.ts";
import { drawnFromModel } from "../core/frames.ts";
import { Fault } from "../core/fault.ts";
import type { Part } from "../core/place.ts";
import { featureMesh, type FeatureMesh } from "./feature-mesh.ts";
import { instancedFeatures, type InstancedFeatures } from "./instanced-mesh.ts";
import { loadMasks, type Masks } from "./invented-mask.ts";
import { type Mover, moversOf } from "./movers.ts";
import { gatherRepeated } from "./repeated-nodes.ts";
import { SharedImages } from "./shared-images.ts";

export interface LoadedPart {
  readonly part: Part;
  readonly table: FeatureTable;
  readonly group: Group;
  readonly meshes: readonly FeatureMesh[];
  readonly instanced: readonly InstancedFeatures[];
  readonly masks: Masks;
  /** What of the meshes moves. */
  readonly movers: readonly Mover[];
  /** The motions of its skeleton. */
  readonly animations: readonly AnimationClip[];
}

const REMEDY = "Write the model again, for example with `veduta facade`.";
const GLB_MAGIC = 0x46546c67;
/** Texture size at a grazing angle costs little and keeps a street's walls sharp. */
const ANISOTROPY = 8;

/** The part that a GLB file holds. Fault where it is broken. */
export async function readPart(part: Part, bytes: ArrayBuffer, images: SharedImages): Promise<LoadedPart> {
  checkContainer(bytes, part.model);
  const gltf = await parse(bytes, part.model, images);
  const { scene } = gltf;
  removeLights(scene);
  gatherRepeated(scene);
  const extras = scene.userData as { veduta?: { features?: unknown } };
  const table = readFeatureTable(extras.veduta?.features, part.model);
  const group = new Group();
  group.name = part.id;
  group.add(scene);
  group.matrix.fromArray(drawnFromModel(part.worldFromPart));
  group.matrixAutoUpdate = false;
  group.updateMatrixWorld(true);
  const meshes: FeatureMesh[] = [];
  const instanced: InstancedFeatures[] = [];
  scene.traverse((node) => {
    if (node instanceof InstancedMesh) instanced.push(instancedFeatures(node as InstancedMesh, table, part.model));
    else if (node instanceof Mesh) meshes.push(featureMesh(node as Mesh, table, part.model));
  });
  for (const { mesh, rowOfFace } of meshes) if (areDrawnOnly(rowOfFace, table)) layOver(mesh);
  if (part.isBackdrop) for (const { mesh } of meshes) setApart(mesh);
  const drawn = [...meshes, ...instanced].map(({ mesh }) => mesh);
  if (drawn.length === 0) throw new Fault(part.model, "there is no mesh in the model", REMEDY);
  for (const mesh of drawn) sharpenTextures(mesh);
  const masks = await named(part.model, () => loadMasks(gltf, drawn));
  return { part, table, group, meshes, instanced, masks, movers: moversOf(gltf, meshes), animations: gltf.animations };
}

/** The loader trusts the lengths in the file; a truncated one must not reach it. */
function checkContainer(bytes: ArrayBuffer, file: string): void {
  const view = new DataView(bytes);
  if (bytes.byteLength < 20 || view.getUint32(0, true) !== GLB_MAGIC) {
    throw new Fault(file, "it is not a binary glTF file", REMEDY);
  }
  const announced = view.getUint32(8, true);
  if (announced > bytes.byteLength) {
    throw new Fault(
      file,
      `it is cut short (${bytes.byteLength} of ${announced} bytes)`,
      "Copy the file again, or write the model again.",
    );
  }
}

async function parse(bytes: ArrayBuffer, file: string, images: SharedImages): Promise<GLTF> {
  const loader = new GLTFLoader().register((parser) => images.pluginOf(parser));
  return await named(file, () => loader.parseAsync(bytes, ""));
}

/** What the loader throws, said about the file. */
async function named<T>(file: string, read: () => Promise<T>): Promise<T> {
  try {
    return await read();
  } catch (error) {
    const words = error instanceof Error ? error.message : String(error);
    throw new Fault(file, `the model is broken (${words})`, REMEDY);
  }
}

/**
 * A model may bring the lamps of a whole house (KHR_lights_punctual). They would all shine at once and
 * through its walls: what shines is what the house's document says (`RoomLights`).
 */
function removeLights(scene: Group): void {
  const lights: Light[] = [];
  scene.traverse((node) => {
    if (node instanceof Light) lights.push(node);
  });
  for (const light of lights) light.removeFromParent();
}

/** A picture of far away throws no shadow on the place, and none falls on it. */
function setApart(mesh: Mesh): void {
  mesh.castShadow = false;
  mesh.receiveShadow = false;
  mesh.renderOrder = -1;
}

/** Sheets that lie closely over a floor: from afar their depth is the floor's. */
function layOver(mesh: Mesh): void {
  mesh.castShadow = false;
  for (const material of [mesh.material].flat()) {
    material.depthWrite = false;
    material.polygonOffset = true;
    material.polygonOffsetFactor = -1;
    material.polygonOffsetUnits = -4;
  }
}

function sharpenTextures(mesh: Mesh): void {
  for (const material of [mesh.material].flat()) {
    for (const value of Object.values(material)) {
      if (value instanceof Texture) value.anisotropy = ANISOTROPY;
    }
  }
}
