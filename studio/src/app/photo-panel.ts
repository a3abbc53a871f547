/** The photo that is looked through or lies on the place: its name, and the ways on from it. */
import { css, html, LitElement, nothing, type TemplateResult } from "lit";
import type { Shot } from "../core/place.ts";
import { icons } from "./icons.ts";
import { lineStyles } from "./line-styles.ts";
import { theme } from "./theme.ts";

export class PhotoPanel extends LitElement {
  static override properties = {
    shot: { attribute: false },
    number: { type: Number },
    count: { type: Number },
    through: { type: Boolean },
    projected: { type: Boolean },
    cover: { type: Number },
  };
  declare shot: Shot | null;
  declare number: number;
  declare count: number;
  /** It is looked through. */
  declare through: boolean;
  /** It lies on the place, and covers this share of it (0..1). */
  declare projected: boolean;
  declare cover: number;

  static override styles = [
    theme,
    lineStyles,
    css`
      :host {
        display: block;
        padding: 8px 10px;
      }
      :host([hidden]) {
        display: none;
      }
      .line {
        display: flex;
        align-items: center;
        gap: 6px;
      }
      .name {
        flex: 1;
        min-width: 0;
        padding: 0 8px;
        text-align: left;
        border-radius: 8px;
      }
      button.name:hover {
        background: var(--hover);
      }
      .back svg {
        transform: scaleX(-1);
      }
      label {
        display: flex;
        align-items: center;
        gap: 10px;
        padding: 4px 10px 2px;
        font-size: 13px;
        color: var(--ink-soft);
      }
    `,
  ];

  constructor() {
    super();
    this.shot = null;
    this.number = 0;
    this.count = 0;
    this.through = false;
    this.projected = false;
    this.cover = 1;
  }

  override render(): TemplateResult | typeof nothing {
    const { shot, projected, through } = this;
    if (shot === null) return nothing;
    const name = html`<strong data-field="name">${shot.name}</strong>
      <span data-field="number">Photo ${this.number} of ${this.count}</span>`;
    const [throwing, leaving] = [
      projected ? "Take the photo off the place (T)" : "Throw the photo onto the place (T)",
      through ? "Leave the photo (Esc)" : "Take the photo off the place (Esc)",
    ];
    return html`<div class="line">
        <button class="icon-button back" aria-label="The photo before (B)" title="The photo before (B)"
          @click=${() => this.#emit("step-photo", -1)}>${icons.chevron}</button>
        ${through
          ? html`<div class="name">${name}</div>`
          : html`<button class="name" title="Look through this photo" @click=${() => this.#emit("look-through", 0)}>${name}</button>`}
        <button class="icon-button" aria-label="The next photo (N)" title="The next photo (N)"
          @click=${() => this.#emit("step-photo", 1)}>${icons.chevron}</button>
        <button class="icon-button" aria-label=${throwing} title=${throwing} aria-pressed=${projected} data-field="project"
          @click=${() => this.#emit("project-photo", 0)}>${icons.projector}</button>
        <button class="icon-button" aria-label=${leaving} title=${leaving}
          @click=${() => this.#emit("close-photo", 0)}>${icons.close}</button>
      </div>
      ${projected
        ? html`<label>Photo <input type="range" aria-label="How much the photo covers the place" min="0" max="1" step="0.02"
              .value=${String(this.cover)}
              @input=${(event: Event) => this.#emit("cover", Number((event.target as HTMLInputElement).value))} /></label>`
        : nothing}`;
  }

  #emit(name: "close-photo" | "cover" | "look-through" | "project-photo" | "step-photo", detail: number): void {
    this.dispatchEvent(new CustomEvent(name, { detail, bubbles: true, composed: true }));
  }
}

customElements.define("veduta-photo-panel", PhotoPanel);
