/** The region of the rectified photo in which a feature was seen, with some of its surroundings. */
import { css, html, LitElement, type PropertyValues, type TemplateResult } from "lit";
import type { PhotoRectangle } from "../core/features.ts";
import { photoWindow, windowAspect } from "../core/photo-window.ts";
import { theme } from "./theme.ts";

/** Twice what the panel is wide, for sharp screens. */
const WIDTH_PX = 600;

const photos = new Map<string, Promise<HTMLImageElement>>();

function photoAt(address: string): Promise<HTMLImageElement> {
  const known = photos.get(address);
  if (known !== undefined) return known;
  const image = new Image();
  image.src = address;
  const wanted = image.decode().then(() => image);
  photos.set(address, wanted);
  return wanted;
}

export class PhotoRegion extends LitElement {
  static override properties = {
    address: { type: String },
    rectangle: { attribute: false },
    missing: { state: true },
  };
  declare address: string | null;
  declare rectangle: PhotoRectangle | null;
  declare missing: boolean;

  static override styles = [
    theme,
    css`
      :host {
        display: block;
      }
      canvas {
        display: block;
        width: 100%;
        border-radius: 10px;
        background: #e8e8e4;
      }
      p {
        color: var(--ink-faint);
        font-size: 12.5px;
        margin-top: 6px;
        font-variant-numeric: tabular-nums;
      }
    `,
  ];

  constructor() {
    super();
    this.address = null;
    this.rectangle = null;
    this.missing = false;
  }

  override render(): TemplateResult {
    if (this.rectangle === null) return html`<p>No part of the photo shows this surface.</p>`;
    if (this.missing || this.address === null) {
      return html`<p>The photo (${this.address ?? "not named in the place"}) could not be loaded.</p>`;
    }
    const [x, y, w, h] = this.rectangle.map((v) => Math.round(v));
    const height_px = Math.round(WIDTH_PX / windowAspect(this.rectangle));
    return html`<canvas width=${WIDTH_PX} height=${height_px} role="img"
        aria-label="Part of the photo with the surface framed"></canvas>
      <p>${w} × ${h} px at (${x}, ${y}) of the rectified photo</p>`;
  }

  override willUpdate(changed: PropertyValues<this>): void {
    if (changed.has("address")) this.missing = false;
  }

  override updated(): void {
    void this.#draw();
  }

  async #draw(): Promise<void> {
    const { address, rectangle } = this;
    if (address === null || rectangle === null || this.missing) return;
    const image = await photoAt(address).catch(() => null);
    // The person may have clicked on while the photo arrived.
    if (address !== this.address || rectangle !== this.rectangle) return;
    if (image === null) {
      this.missing = true;
      return;
    }
    const canvas = this.renderRoot.querySelector("canvas");
    const context = canvas?.getContext("2d");
    if (canvas === null || context === null || context === undefined) return;
    paint(context, image, rectangle);
  }
}

function paint(context: CanvasRenderingContext2D, image: HTMLImageElement, rectangle: PhotoRectangle): void {
  const { width, height } = context.canvas;
  const view = photoWindow(rectangle, image.naturalWidth, image.naturalHeight, width / height);
  const zoom = width / view.width;
  const [x, y, w, h] = rectangle;
  const frame = [(x - view.x) * zoom, (y - view.y) * zoom, w * zoom, h * zoom] as const;
  context.imageSmoothingQuality = "high";
  context.clearRect(0, 0, width, height);
  context.drawImage(image, -view.x * zoom, -view.y * zoom, image.naturalWidth * zoom, image.naturalHeight * zoom);
  context.beginPath();
  context.rect(0, 0, width, height);
  context.rect(...frame);
  context.fillStyle = "rgb(20 30 40 / 0.42)";
  context.fill("evenodd");
  context.strokeStyle = "#ff9e2c";
  context.lineWidth = 5;
  context.strokeRect(...frame);
}

customElements.define("veduta-photo-region", PhotoRegion);
