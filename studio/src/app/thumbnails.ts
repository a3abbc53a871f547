/** Small pictures of the photos, made one after the other, of those first that are seen. */

const SIDE_PX = 160;
/** Kept; the others are made anew when they are seen again. */
const MOST = 240;

export class Thumbnails {
  readonly #known = new Map<number, ImageBitmap | null>();
  readonly #make: (index: number, side_px: number) => Promise<ImageBitmap>;
  readonly #onMade: () => void;
  #wanted: readonly number[] = [];
  #isBusy = false;

  constructor(make: (index: number, side_px: number) => Promise<ImageBitmap>, onMade: () => void) {
    this.#make = make;
    this.#onMade = onMade;
  }

  /** Null while it is not there, and where it cannot be had. */
  get(index: number): ImageBitmap | null {
    return this.#known.get(index) ?? null;
  }

  /** What is seen now; what was asked for before and has not begun is forgotten. */
  want(indices: readonly number[]): void {
    this.#wanted = indices;
    if (!this.#isBusy) void this.#work();
  }

  async #work(): Promise<void> {
    this.#isBusy = true;
    for (;;) {
      const next = this.#wanted.find((index) => !this.#known.has(index));
      if (next === undefined) break;
      // The row without a picture says enough: the photo's own panel tells what is wrong with it.
      this.#known.set(next, await this.#make(next, SIDE_PX).catch(() => null));
      this.#forget();
      this.#onMade();
    }
    this.#isBusy = false;
  }

  #forget(): void {
    const seen = new Set(this.#wanted);
    for (const [index, bitmap] of this.#known) {
      if (this.#known.size <= MOST) return;
      if (seen.has(index)) continue;
      bitmap?.close();
      this.#known.delete(index);
    }
  }
}
