/**
 * Which pixels of a texture were invented (what cars and trees hid, filled in). The material
 * names an image in `extras.veduta.invented_mask`: white is invented.
 */
import { ClampToEdgeWrapping, LinearFilter, type Material, type Mesh, type Texture } from "three";
import type { GLTF } from "three/examples/jsm/loaders/GLTFLoader.js";

export type Masks = ReadonlyMap<Material, Texture>;

export async function loadMasks(gltf: GLTF, meshes: readonly Mesh[]): Promise<Masks> {
  const masks = new Map<Material, Texture>();
  for (const material of new Set(meshes.flatMap((mesh) => [mesh.material].flat()))) {
    const extras = material.userData as { veduta?: { invented_mask?: unknown } };
    const image = extras.veduta?.invented_mask;
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
