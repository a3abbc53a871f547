/** A mesh whose faces know their features: each feature can be tinted, each class hidden. */
import {
  BufferAttribute,
  DataTexture,
  type Mesh,
  NearestFilter,
  RGBAFormat,
  SRGBColorSpace,
  UnsignedByteType,
} from "three";
import type { FeatureTable } from "../core/features.ts";
import { Fault } from "../core/fault.ts";

/** GLTFLoader writes the names of custom attributes in lower case. */
const FEATURE_ATTRIBUTE = "_feature_id_0";
export const TINT_WIDTH = 256;

export interface FeatureMesh {
  readonly mesh: Mesh;
  /** Three vertices per face, as in the file. */
  readonly faces: Uint32Array;
  /** Row in the feature table of each face. */
  readonly rowOfFace: Uint32Array;
}

export function featureMesh(mesh: Mesh, table: FeatureTable, file: string): FeatureMesh {
  const geometry = mesh.geometry;
  const ids = geometry.getAttribute(FEATURE_ATTRIBUTE) as BufferAttribute | undefined;
  if (ids === undefined) {
    throw new Fault(
      file,
      "the faces of the model have no feature ids",
      "Write the model again with this version of Veduta.",
    );
  }
  const rows = new Float32Array(ids.count);
  for (let i = 0; i < ids.count; i += 1) {
    const row = Math.round(ids.getX(i));
    if (table.rows[row] === undefined) {
      throw new Fault(
        file,
        `a face has the feature id ${row}, which is not in the table`,
        "Write the model again with this version of Veduta.",
      );
    }
    rows[i] = row;
  }
  geometry.deleteAttribute(FEATURE_ATTRIBUTE);
  geometry.setAttribute("featureRow", new BufferAttribute(rows, 1));
  const faces = facesOf(mesh);
  geometry.setIndex(new BufferAttribute(faces.slice(), 1));
  const rowOfFace = Uint32Array.from({ length: faces.length / 3 }, (_, face) => rows[faces[3 * face] ?? 0] ?? 0);
  mesh.castShadow = true;
  mesh.receiveShadow = true;
  return { mesh, faces, rowOfFace };
}

function facesOf(mesh: Mesh): Uint32Array {
  const index = mesh.geometry.getIndex();
  const count = mesh.geometry.getAttribute("position").count;
  return index === null
    ? Uint32Array.from({ length: count - (count % 3) }, (_, i) => i)
    : Uint32Array.from(index.array);
}

/** Leaves out the faces of hidden features, from the picture and from the shadows. */
export function showRows(target: FeatureMesh, isVisible: (row: number) => boolean): void {
  const index = target.mesh.geometry.getIndex();
  if (index === null) return;
  let shown = 0;
  for (let face = 0; face < target.rowOfFace.length; face += 1) {
    if (!isVisible(target.rowOfFace[face] ?? 0)) continue;
    for (let k = 0; k < 3; k += 1) {
      index.array[shown] = target.faces[3 * face + k] ?? 0;
      shown += 1;
    }
  }
  index.needsUpdate = true;
  target.mesh.geometry.setDrawRange(0, shown);
  target.mesh.visible = shown > 0;
}

/** One colour (sRGB) and strength (alpha) per feature, read by the patched materials. */
export function tintTexture(rows: number): DataTexture {
  const height = Math.max(1, Math.ceil(rows / TINT_WIDTH));
  const data = new Uint8Array(TINT_WIDTH * height * 4);
  const texture = new DataTexture(data, TINT_WIDTH, height, RGBAFormat, UnsignedByteType);
  texture.colorSpace = SRGBColorSpace;
  texture.minFilter = NearestFilter;
  texture.magFilter = NearestFilter;
  texture.needsUpdate = true;
  return texture;
}

/** `colour` is `#rrggbb`, `strength` 0..1. */
export function setTint(texture: DataTexture, row: number, colour: string, strength: number): void {
  const data = texture.image.data;
  if (data === null) return;
  const value = Number.parseInt(colour.slice(1), 16);
  data[4 * row] = (value >> 16) & 255;
  data[4 * row + 1] = (value >> 8) & 255;
  data[4 * row + 2] = value & 255;
  data[4 * row + 3] = Math.round(255 * strength);
  texture.needsUpdate = true;
}
