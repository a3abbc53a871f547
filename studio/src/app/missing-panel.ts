/** What of the place has not come: named, and asked for again. */
import { css, html, LitElement, nothing, type TemplateResult } from "lit";
import type { Missing } from "../core/asking.ts";
import { Absent } from "../core/fault.ts";
import { theme } from "./theme.ts";

/** So many are named; of more the number is told. */
const NAMED = 4;

export class MissingPanel extends LitElement {
  static override properties = { waiting: { type: Number }, missing: { attribute: false } };
  declare waiting: number;
  declare missing: readonly Missing[];

  static override styles = [
    theme,
    css`
      :host {
        position: absolute;
        right: 16px;
        bottom: 16px;
        max-width: min(340px, 60vw);
        padding: 12px 16px;
        font-size: 13px;
        line-height: 1.45;
      }
      :host([hidden]) {
        display: none;
      }
      ul {
        margin: 6px 0 10px;
        color: var(--ink-soft);
      }
      li {
        overflow-wrap: anywhere;
      }
      button {
        padding: 6px 12px;
        border-radius: 8px;
        background: var(--deep);
        color: #fff;
        font-weight: 560;
      }
      @media (max-width: 700px) {
        :host {
          right: 8px;
          bottom: 84px;
        }
      }
    `,
  ];

  constructor() {
    super();
    this.waiting = 0;
    this.missing = [];
  }

  override updated(): void {
    this.hidden = this.waiting === 0 && this.missing.length === 0;
  }

  override render(): TemplateResult {
    const { waiting, missing } = this;
    return html`<div role="status">
      ${waiting === 0 ? nothing : html`<p>${waiting === 1 ? "1 part" : `${waiting} parts`} on the way</p>`}
      ${missing.length === 0 ? nothing : this.#missing(missing)}
    </div>`;
  }

  /** What is asked for again, and what is not, each under its own words. */
  #missing(missing: readonly Missing[]): TemplateResult {
    const asked = missing.filter(({ fault }) => fault instanceof Absent);
    const broken = missing.filter(({ fault }) => !(fault instanceof Absent));
    return html`${listed(asked, "not come: asked for again.")}${listed(broken, "not come whole: left out.")}
      ${asked.length > 0 ? html`<button @click=${() => this.dispatchEvent(new CustomEvent("ask-now"))}>Ask now</button>` : nothing}`;
  }
}

function listed(missing: readonly Missing[], words: string): TemplateResult | typeof nothing {
  if (missing.length === 0) return nothing;
  const more = missing.length - NAMED;
  return html`<p>${missing.length === 1 ? "One file has" : `${missing.length} files have`} ${words}</p>
    <ul>
      ${missing.slice(0, NAMED).map(({ file, fault }) => html`<li>${file}: ${fault.fault}</li>`)}
      ${more > 0 ? html`<li>and ${more} more</li>` : nothing}
    </ul>`;
}

customElements.define("veduta-missing", MissingPanel);
