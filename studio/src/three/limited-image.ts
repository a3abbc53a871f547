/** Pictures no larger than a machine is asked to hold. */
import type { Texture } from "three";

/** What the browser can draw of: it has a size. */
export type Picture = ImageBitmap | HTMLImageElement;

/** The size of a picture whose longest side is at most `most_px`, in its own proportions. */
export function sizeWithin(width: number, height: number, most_px: number): { readonly width: number; readonly height: number } {
  const share = Math.min(1, most_px / Math.max(width, height, 1));
  return { width: Math.max(1, Math.round(share * width)), height: Math.max(1, Math.round(share * height)) };
}

/** The picture itself where it is small enough; else a smaller one in its place. */
export async function within<P extends Picture>(picture: P, most_px: number): Promise<P | ImageBitmap> {
  const { width, height } = sizeWithin(picture.width, picture.height, most_px);
  if (width === picture.width && height === picture.height) return picture;
  const smaller = await createImageBitmap(picture, {
    resizeWidth: width,
    resizeHeight: height,
    resizeQuality: "high",
    premultiplyAlpha: "none",
    colorSpaceConversion: "none",
  });
  if ("close" in picture) picture.close();
  return smaller;
}

/** The texture, before it is on the card, with a picture that is small enough. */
export async function limited<T extends Texture>(texture: T, most_px: number): Promise<T> {
  if (Number.isFinite(most_px)) texture.image = await within(texture.image as Picture, most_px);
  return texture;
}
