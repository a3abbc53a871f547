/** The photos as textures: fetched when they are wanted, and a bounded number of bytes of them kept. */
import { LinearFilter, LinearMipmapLinearFilter, SRGBColorSpace, Texture } from "three";
import { BoundedCache } from "../core/bounded-cache.ts";
import { Fault } from "../core/fault.ts";
import { fileAddress, type Shot } from "../core/place.ts";
import { fetchBytes } from "./fetch.ts";

/** Longest sides: photos that come and go while one walks, and the one that is chosen. */
export const PASSING_PX = 1536;
export const CHOSEN_PX = 4096;

/** Four bytes a pixel and a third more for the smaller copies: about 20 photos in passing. */
const MOST_BYTES = 256e6;
const BYTES_PER_PIXEL = 4 * (4 / 3);
const ANISOTROPY = 8;

export class PhotoTextures {
  readonly #shots: readonly Shot[];
  readonly #manifest: URL;
  readonly #onFault: (fault: Fault) => void;
  readonly #cache: BoundedCache<string, Texture<ImageBitmap>>;

  /** `onFault` hears of photos that cannot be loaded: the place is there without them. */
  constructor(shots: readonly Shot[], manifest: URL, onFault: (fault: Fault) => void) {
    this.#shots = shots;
    this.#manifest = manifest;
    this.#onFault = onFault;
    this.#cache = new BoundedCache(MOST_BYTES, {
      load: (key) => this.#load(key),
      cost: ({ image }) => BYTES_PER_PIXEL * image.width * image.height,
      dispose: (texture) => {
        texture.dispose();
        texture.image.close();
      },
    });
  }

  /** Null where it cannot be had. Each call wants one of `release`. */
  async acquire(index: number, side_px: number): Promise<Texture | null> {
    return await this.#cache.acquire(keyOf(index, side_px));
  }

  release(index: number, side_px: number): void {
    this.#cache.release(keyOf(index, side_px));
  }

  get bytes(): number {
    return this.#cache.cost;
  }

  dispose(): void {
    this.#cache.dispose();
  }

  async #load(key: string): Promise<Texture<ImageBitmap> | null> {
    const [index = 0, side_px = PASSING_PX] = key.split(" ").map(Number);
    const shot = this.#shots[index];
    if (shot === undefined) return null;
    try {
      return textureOf(await bitmapOf(shot, this.#manifest, side_px, "flipY"));
    } catch {
      this.#onFault(new Fault(shot.picture, "the photo could not be loaded", "Write the place again."));
      return null;
    }
  }
}

/** The photo, no larger than wanted; decoded beside the page's own work. */
export async function bitmapOf(
  shot: Shot,
  manifest: URL,
  side_px: number,
  imageOrientation: "flipY" | "from-image",
): Promise<ImageBitmap> {
  const bytes = await fetchBytes(fileAddress(shot.picture, manifest), shot.picture, () => undefined);
  const share = Math.min(1, side_px / Math.max(shot.width_px, shot.height_px));
  return await createImageBitmap(new Blob([bytes]), {
    imageOrientation,
    resizeWidth: Math.max(1, Math.round(share * shot.width_px)),
    resizeHeight: Math.max(1, Math.round(share * shot.height_px)),
    resizeQuality: "medium",
  });
}

function keyOf(index: number, side_px: number): string {
  return `${index} ${side_px}`;
}

function textureOf(bitmap: ImageBitmap): Texture<ImageBitmap> {
  const texture = new Texture(bitmap);
  // A bitmap is turned over when it is made, not when it is sent.
  texture.flipY = false;
  texture.colorSpace = SRGBColorSpace;
  texture.anisotropy = ANISOTROPY;
  texture.minFilter = LinearMipmapLinearFilter;
  texture.magFilter = LinearFilter;
  texture.needsUpdate = true;
  return texture;
}
