/** What is known of the photo that is looked through, and the way to the next one. */
import { css, html, LitElement, nothing, type TemplateResult } from "lit";
import type { Shot } from "../core/place.ts";
import { icons } from "./icons.ts";
import { theme } from "./theme.ts";

export class PhotoPanel extends LitElement {
  static override properties = {
    shot: { attribute: false },
    number: { type: Number },
    count: { type: Number },
  };
  declare shot: Shot | null;
  declare number: number;
  declare count: number;

  static override styles = [
    theme,
    css`
      :host {
        display: flex;
        align-items: center;
        gap: 14px;
        padding: 8px 10px 8px 16px;
      }
      :host([hidden]) {
        display: none;
      }
      div {
        min-width: 0;
      }
      strong {
        display: block;
        font-weight: 600;
        overflow: hidden;
        text-overflow: ellipsis;
        white-space: nowrap;
      }
      span {
        color: var(--ink-soft);
        font-size: 13px;
        font-variant-numeric: tabular-nums;
      }
      .back svg {
        transform: scaleX(-1);
      }
    `,
  ];

  constructor() {
    super();
    this.shot = null;
    this.number = 0;
    this.count = 0;
  }

  override render(): TemplateResult | typeof nothing {
    const { shot } = this;
    if (shot === null) return nothing;
    return html`
      <button class="icon-button back" aria-label="The photo before (B)" title="The photo before (B)"
        @click=${() => this.#emit("step-photo", -1)}>${icons.chevron}</button>
      <div>
        <strong data-field="name">${shot.name}</strong>
        <span data-field="number">Photo ${this.number} of ${this.count}</span>
      </div>
      <button class="icon-button" aria-label="The next photo (N)" title="The next photo (N)"
        @click=${() => this.#emit("step-photo", 1)}>${icons.chevron}</button>
      <button class="icon-button" aria-label="Leave the photo (Esc)" title="Leave the photo (Esc)"
        @click=${() => this.#emit("close-photo", 0)}>${icons.close}</button>
    `;
  }

  #emit(name: "close-photo" | "step-photo", detail: number): void {
    this.dispatchEvent(new CustomEvent(name, { detail, bubbles: true, composed: true }));
  }
}

customElements.define("veduta-photo-panel", PhotoPanel);
