/** Textures of photos, which lie on surfaces or fill the picture. */
import { type ColorSpace, LinearMipmapLinearFilter, Texture } from "three";

const ANISOTROPY = 8;

/** It lets go of the bitmap when it is disposed of. */
export function bitmapTexture(bitmap: ImageBitmap, colorSpace: ColorSpace): Texture<ImageBitmap> {
  const texture = new Texture(bitmap);
  // A bitmap is turned over when it is made, not when it is sent.
  texture.flipY = false;
  texture.colorSpace = colorSpace;
  texture.anisotropy = ANISOTROPY;
  texture.minFilter = LinearMipmapLinearFilter;
  texture.needsUpdate = true;
  texture.addEventListener("dispose", () => bitmap.close());
  return texture;
}
