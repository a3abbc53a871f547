/**
 * Which pixels of a texture were invented (what cars and trees hid, filled in). The material
 * names an image in `extras.veduta.invented_mask`, where white is invented, or says in
 * `extras.veduta.invented` whether all of them are.
 */
import { ClampToEdgeWrapping, DataTexture, LinearFilter, type Material, type Mesh, type Texture } from "three";
import type { GLTF } from "three/examples/jsm/loaders/GLTFLoader.js";

export type Masks = ReadonlyMap<Material, Texture>;

/** One white pixel. */
const ALL = new DataTexture(new Uint8Array([255, 255, 255, 255]), 1, 1);
ALL.needsUpdate = true;

export async function loadMasks(gltf: GLTF, meshes: readonly Mesh[]): Promise<Masks> {
  const masks = new Map<Material, Texture>();
  for (const material of new Set(meshes.flatMap((mesh) => [mesh.material].flat()))) {
    const extras = material.userData as { veduta?: { invented_mask?: unknown; invented?: unknown } };
    const image = extras.veduta?.invented_mask;
    if (extras.veduta?.invented === true) masks.set(material, ALL);
    if (typeof image !== "number" || !("map" in material) || material.map === null) continue;
    const { parser } = gltf;
    const mask = await parser.loadImageSource(image, parser.textureLoader);
    // As glTF has it: the first row is the upper one. A mask is data, not colour.
    mask.flipY = false;
    mask.generateMipmaps = false;
    mask.minFilter = LinearFilter;
    mask.wrapS = ClampToEdgeWrapping;
    mask.wrapT = ClampToEdgeWrapping;
    masks.set(material, mask);
  }
  return masks;
}
