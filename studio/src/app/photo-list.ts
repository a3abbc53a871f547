/** All photos of the place: a click, or Enter, looks through one. */
import { css, html, LitElement, type PropertyValues, type TemplateResult } from "lit";
import { Fault } from "../core/fault.ts";
import type { Shot } from "../core/place.ts";
import { rowAfter, rowsSeen, scrolledTo } from "../core/rows.ts";
import { theme } from "./theme.ts";
import { Thumbnails } from "./thumbnails.ts";

const ROW_PX = 52;
/** Its title and margins. */
const AROUND_PX = 50;

export class PhotoList extends LitElement {
  static override properties = {
    shots: { attribute: false },
    bitmap: { attribute: false },
    current: { type: Number },
    active: { state: true },
    top_px: { state: true },
    height_px: { state: true },
  };
  declare shots: readonly Shot[];
  /** Makes a small copy of a photo. */
  declare bitmap: ((index: number, side_px: number) => Promise<ImageBitmap>) | null;
  /** The photo that is looked through, or lies on the place. */
  declare current: number | null;
  /** Where the keyboard is. */
  declare active: number;
  declare top_px: number;
  declare height_px: number;
  #thumbnails: Thumbnails | null = null;
  readonly #resizes = new ResizeObserver(() => this.#measure());

  static override styles = [
    theme,
    css`
      :host {
        display: flex;
        flex-direction: column;
        padding: 14px 8px 8px 12px;
      }
      :host([hidden]) {
        display: none;
      }
      h2 {
        display: flex;
        justify-content: space-between;
        padding: 0 12px 0 8px;
        margin-bottom: 6px;
      }
      h2 span {
        letter-spacing: 0;
        font-variant-numeric: tabular-nums;
      }
      .rows {
        flex: 1;
        min-height: 0;
        overflow: auto;
        scrollbar-width: thin;
        border-radius: 8px;
      }
      .row {
        display: flex;
        align-items: center;
        gap: 10px;
        height: ${ROW_PX}px;
        padding: 4px 6px;
        border-radius: 8px;
        cursor: pointer;
      }
      .row:hover {
        background: var(--hover);
      }
      .rows:focus-visible {
        outline: none;
      }
      .rows:focus-visible .active {
        outline: 2px solid var(--accent);
        outline-offset: -2px;
      }
      .row[aria-selected="true"] {
        background: var(--deep);
        color: #fff;
      }
      canvas {
        flex: none;
        width: 60px;
        height: 42px;
        border-radius: 6px;
        background: #e4e4df;
      }
      .row span {
        overflow: hidden;
        text-overflow: ellipsis;
        white-space: nowrap;
        font-size: 13px;
      }
    `,
  ];

  constructor() {
    super();
    this.shots = [];
    this.bitmap = null;
    this.current = null;
    this.active = 0;
    this.top_px = 0;
    this.height_px = 0;
  }

  override render(): TemplateResult {
    const { first, end } = this.#seen;
    const rows = Array.from({ length: end - first }, (_, k) => this.#row(first + k));
    return html`
      <h2 class="eyebrow">Photos <span>${this.shots.length}</span></h2>
      <div class="rows" role="listbox" tabindex="0" aria-label="Photos" aria-activedescendant=${`photo-${this.active}`}
        @scroll=${(event: Event) => (this.top_px = (event.target as HTMLElement).scrollTop)}
        @keydown=${(event: KeyboardEvent) => this.#onKey(event)}>
        <div .style=${`height:${this.shots.length * ROW_PX}px`}>
          <div .style=${`transform:translateY(${first * ROW_PX}px)`}>${rows}</div>
        </div>
      </div>
    `;
  }

  override firstUpdated(): void {
    this.#resizes.observe(this.#rows);
    this.#measure();
  }

  override willUpdate(changed: PropertyValues<this>): void {
    if (changed.has("current") && this.current !== null) this.active = this.current;
    // No taller than its rows, however little room they need.
    if (changed.has("shots")) this.style.maxHeight = `${this.shots.length * ROW_PX + AROUND_PX}px`;
    if (changed.has("bitmap")) {
      this.#thumbnails = this.bitmap === null ? null : new Thumbnails(this.bitmap, () => this.#paint());
    }
  }

  override updated(changed: PropertyValues<this>): void {
    if (changed.has("active")) this.#scrollTo(this.active);
    const { first, end } = this.#seen;
    if (this.height_px > 0) this.#thumbnails?.want(Array.from({ length: end - first }, (_, k) => first + k));
    this.#paint();
  }

  get #rows(): HTMLElement {
    const rows = this.renderRoot.querySelector<HTMLElement>(".rows");
    if (rows === null) throw new Fault("Veduta studio", "its list of photos is gone", "Reload the page.");
    return rows;
  }

  get #seen(): { first: number; end: number } {
    return rowsSeen(this.shots.length, ROW_PX, this.top_px, this.height_px);
  }

  #row(index: number): TemplateResult {
    const name = this.shots[index]?.name ?? "";
    return html`<div class=${`row ${index === this.active ? "active" : ""}`} role="option" id=${`photo-${index}`}
      aria-selected=${index === this.current} title=${name} aria-setsize=${this.shots.length} aria-posinset=${index + 1}
      @click=${() => this.#choose(index)}>
      <canvas width="120" height="84" data-index=${index}></canvas><span>${name}</span>
    </div>`;
  }

  #measure(): void {
    this.height_px = this.#rows.clientHeight;
  }

  #scrollTo(row: number): void {
    const rows = this.#rows;
    rows.scrollTop = scrolledTo(row, ROW_PX, rows.scrollTop, rows.clientHeight);
  }

  #onKey(event: KeyboardEvent): void {
    const page = Math.max(1, Math.floor(this.height_px / ROW_PX) - 1);
    const row = rowAfter(event.key, this.active, this.shots.length, page);
    if (row !== null) this.active = row;
    else if (event.key === "Enter" || event.key === " ") this.#choose(this.active);
    else return;
    // Elsewhere these keys walk and turn.
    event.preventDefault();
    event.stopPropagation();
  }

  #choose(index: number): void {
    this.active = index;
    this.dispatchEvent(new CustomEvent("choose-photo", { detail: index, bubbles: true, composed: true }));
  }

  #paint(): void {
    for (const canvas of this.renderRoot.querySelectorAll("canvas")) {
      const context = canvas.getContext("2d");
      if (context === null) continue;
      const bitmap = this.#thumbnails?.get(Number(canvas.dataset.index)) ?? null;
      context.clearRect(0, 0, canvas.width, canvas.height);
      if (bitmap !== null) cover(context, bitmap);
    }
  }
}

/** The picture's middle, as large as fills the canvas. */
function cover(context: CanvasRenderingContext2D, bitmap: ImageBitmap): void {
  const { width, height } = context.canvas;
  const zoom = Math.max(width / bitmap.width, height / bitmap.height);
  const [w, h] = [zoom * bitmap.width, zoom * bitmap.height];
  context.drawImage(bitmap, (width - w) / 2, (height - h) / 2, w, h);
}

customElements.define("veduta-photo-list", PhotoList);
