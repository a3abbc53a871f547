/** Which of the records and the parts of a place are shown, and how. */
import { css, html, LitElement, nothing, type TemplateResult } from "lit";
import type { Layer } from "../core/state.ts";
import { icons } from "./icons.ts";
import { rowStyles } from "./row-styles.ts";
import { theme } from "./theme.ts";

const NAMES: Readonly<Record<Layer, string>> = {
  model: "Model",
  walls: "Walls found",
  points: "Points",
  distances: "Distances from the model",
  cameras: "Cameras",
  backdrop: "Panorama",
  raw: "As recorded",
};
const SMALLEST_PX = 1;
const LARGEST_PX = 8;

export class RecordsPanel extends LitElement {
  static override properties = {
    layers: { attribute: false },
    off: { attribute: false },
    point_px: { type: Number },
    fading: { type: Boolean },
    wipe: { type: Number },
  };
  /** Those that the place has. */
  declare layers: readonly Layer[];
  declare off: ReadonlySet<Layer>;
  declare point_px: number;
  declare fading: boolean;
  /** Up to this share of the picture's width what was recorded is shown. */
  declare wipe: number;

  static override styles = [
    theme,
    rowStyles,
    css`
      :host {
        display: block;
        padding: 6px 12px 4px;
      }
      :host([hidden]) {
        display: none;
      }
      .eyebrow {
        padding: 10px 8px 0;
        margin-bottom: 6px;
      }
    `,
  ];

  constructor() {
    super();
    this.layers = [];
    this.off = new Set();
    this.point_px = 0;
    this.fading = false;
    this.wipe = 0;
  }

  override render(): TemplateResult {
    return html`
      <h2 class="eyebrow">Shown</h2>
      <ul>
        ${this.layers.map((layer) => html`<li>${this.#layer(layer)}${this.#slider(layer)}</li>`)}
      </ul>
      ${this.layers.includes("cameras")
        ? html`<button class="row" role="switch" aria-checked=${this.fading}
            title="While walking, photos that show what you see lie over the place (V)"
            @click=${() => this.#emit("fading", !this.fading)}>
            <span class="name">Photos fade in</span><i class="knob"></i></button>`
        : nothing}
    `;
  }

  #slider(layer: Layer): TemplateResult | typeof nothing {
    if (layer === "points") return this.#size();
    return layer === "raw" && !this.off.has("raw") ? this.#wiped() : nothing;
  }

  #wiped(): TemplateResult {
    return html`<label class="row">Up to <input type="range" aria-label="How far from the left the place is shown as recorded"
      min="0" max="1" step="0.01" .value=${String(this.wipe)}
      @input=${(event: Event) => this.#emit("wipe", Number((event.target as HTMLInputElement).value))} /></label>`;
  }

  #size(): TemplateResult {
    return html`<label class="row">Size <input type="range" aria-label="Size of the points" min=${SMALLEST_PX} max=${LARGEST_PX} step="0.5"
      .value=${String(this.point_px)} ?disabled=${this.off.has("points")}
      @input=${(event: Event) => this.#emit("point-size", Number((event.target as HTMLInputElement).value))} /></label>`;
  }

  #layer(layer: Layer): TemplateResult {
    const visible = !this.off.has(layer);
    return html`<button class="row" role="switch" aria-checked=${visible} data-layer=${layer}
      title=${visible ? `Hide: ${NAMES[layer]}` : `Show: ${NAMES[layer]}`}
      @click=${() => this.#emit("record", { layer, visible: !visible })}>
      <span class="name hides">${NAMES[layer]}</span>${visible ? icons.eye : icons.eyeOff}
    </button>`;
  }

  #emit(name: "record" | "point-size" | "fading" | "wipe", detail: unknown): void {
    this.dispatchEvent(new CustomEvent(name, { detail }));
  }
}

customElements.define("veduta-records", RecordsPanel);
