/** The photos as textures: fetched when they are wanted, and a bounded number of bytes of them kept. */
import { SRGBColorSpace, type Texture } from "three";
import { BoundedCache } from "../core/bounded-cache.ts";
import { Fault } from "../core/fault.ts";
import { fileAddress, type Shot } from "../core/place.ts";
import type { Wish, Wishes } from "../core/wishes.ts";
import { bitmapTexture } from "./bitmap-texture.ts";
import { fetchBytes } from "./fetch.ts";
import { sizeWithin } from "./limited-image.ts";

/** Longest sides: photos that come and go while one walks, and the one that is chosen. */
export const PASSING_PX = 1536;
export const CHOSEN_PX = 4096;

/** Four bytes a pixel and a third more for the smaller copies: about 20 photos in passing. */
const MOST_BYTES = 256e6;
const BYTES_PER_PIXEL = 4 * (4 / 3);

export class PhotoTextures {
  readonly #shots: readonly Shot[];
  readonly #manifest: URL;
  readonly #most_px: number;
  readonly #wishes: Wishes;
  readonly #cache: BoundedCache<string, Texture<ImageBitmap>>;
  /** Photos that have not come. */
  readonly #open = new Map<string, { readonly wish: Wish; readonly giveUp: () => void }>();

  /** No photo is larger than `most_px`. `wishes` names the photos that do not come, and asks for them again: the place is there without them. */
  constructor(shots: readonly Shot[], manifest: URL, most_px: number, wishes: Wishes) {
    this.#shots = shots;
    this.#manifest = manifest;
    this.#most_px = most_px;
    this.#wishes = wishes;
    this.#cache = new BoundedCache(MOST_BYTES, {
      load: (key) => this.#load(key),
      cancel: (key) => this.#cancel(key),
      cost: ({ image }) => BYTES_PER_PIXEL * image.width * image.height,
      dispose: (texture) => texture.dispose(),
    });
  }

  /** Null where there is no such photo; of one that does not come nothing is heard. Each call wants one of `release`. */
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
    const most_px = Math.min(side_px, this.#most_px);
    const load = async (): Promise<ImageBitmap> => await bitmapOf(shot, this.#manifest, most_px, "flipY");
    return await new Promise((resolve) => {
      let isWanted = true;
      const wish = this.#wishes.bring(shot.picture, load, (bitmap) => {
        if (!isWanted) {
          bitmap.close();
          return;
        }
        this.#open.delete(key);
        resolve(bitmapTexture(bitmap, SRGBColorSpace));
      });
      const giveUp = (): void => {
        isWanted = false;
        resolve(null);
      };
      this.#open.set(key, { wish, giveUp });
    });
  }

  /** Photos that one has walked past are not asked for until they come. */
  #cancel(key: string): boolean {
    const open = this.#open.get(key);
    this.#open.delete(key);
    open?.wish.drop();
    open?.giveUp();
    return open !== undefined;
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
  const { width, height } = sizeWithin(shot.width_px, shot.height_px, side_px);
  try {
    return await createImageBitmap(new Blob([bytes]), {
      imageOrientation,
      resizeWidth: width,
      resizeHeight: height,
      resizeQuality: "medium",
    });
  } catch {
    throw new Fault(shot.picture, "the photo cannot be read", "Write the place again.");
  }
}

function keyOf(index: number, side_px: number): string {
  return `${index} ${side_px}`;
}
