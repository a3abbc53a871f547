/** The canvas as pixels: as many as its size asks for, or fewer while the picture moves too slowly. */
import type { WebGLRenderer } from "three";
import { Fault } from "../core/fault.ts";

const MOST_PIXELS_PER_CSS_PX = 2;

export class Screen {
  readonly #canvas: HTMLCanvasElement;
  readonly #renderer: WebGLRenderer;
  #sharpness = 1;

  constructor(canvas: HTMLCanvasElement, renderer: WebGLRenderer) {
    this.#canvas = canvas;
    this.#renderer = renderer;
  }

  /** A share of the pixels that the screen has, along each side. */
  sharpen(share: number): void {
    if (share === this.#sharpness) return;
    this.#sharpness = share;
    this.#renderer.setPixelRatio(this.#ratio);
  }

  /** Takes the canvas's size, CSS pixels; null while it has none. */
  resize(): { width: number; height: number } | null {
    const { clientWidth: width, clientHeight: height } = this.#canvas;
    if (width === 0 || height === 0) return null;
    this.#renderer.setPixelRatio(this.#ratio);
    this.#renderer.setSize(width, height, false);
    return { width, height };
  }

  /** What was drawn just now. */
  async picture(): Promise<Blob> {
    return await new Promise((resolve, reject) => {
      this.#canvas.toBlob((blob) => {
        if (blob !== null) resolve(blob);
        else reject(new Fault("Picture", "the browser made no image", "Try a smaller window."));
      }, "image/png");
    });
  }

  get #ratio(): number {
    return this.#sharpness * Math.min(devicePixelRatio, MOST_PIXELS_PER_CSS_PX);
  }
}
