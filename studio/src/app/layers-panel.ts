/** Which classes are shown, and what the colours mean. */
import { css, html, LitElement, type TemplateResult } from "lit";
import {
  CLASS_LOOKS,
  CLASSES,
  PROVENANCE_LOOKS,
  PROVENANCES,
  type Provenance,
  type SemanticClass,
} from "../core/classes.ts";
import { countClasses, countProvenances, type FeatureTable } from "../core/features.ts";
import type { Colouring } from "../core/state.ts";
import { icons } from "./icons.ts";
import { rowStyles } from "./row-styles.ts";
import { theme } from "./theme.ts";

const COLOURINGS: readonly { readonly value: Colouring; readonly label: string }[] = [
  { value: "photo", label: "Look" },
  { value: "class", label: "Class" },
  { value: "provenance", label: "Provenance" },
];

export interface Counted {
  readonly classes: ReadonlyMap<SemanticClass, number>;
  readonly provenances: ReadonlyMap<Provenance, number>;
}

export class LayersPanel extends LitElement {
  static override properties = {
    tables: { attribute: false },
    counted: { attribute: false },
    hidden_: { attribute: false },
    colouring: { type: String },
  };
  declare tables: readonly FeatureTable[];
  /** Surfaces where they are counted elsewhere: in the tiles that are drawn. */
  declare counted: Counted | null;
  declare hidden_: ReadonlySet<SemanticClass>;
  declare colouring: Colouring;

  static override styles = [
    theme,
    rowStyles,
    css`
      :host {
        display: block;
        padding: 16px 12px 12px;
      }
      :host([hidden]) {
        display: none;
      }
      .eyebrow {
        padding: 0 8px;
        margin-bottom: 6px;
      }
      .segments {
        margin: 0 4px 16px;
      }
      .count {
        color: var(--ink-faint);
        font-variant-numeric: tabular-nums;
      }
      .row[aria-checked="false"] .swatch {
        background: transparent !important;
      }
      .legend {
        margin-bottom: 12px;
      }
      .legend li {
        align-items: start;
        min-height: 0;
      }
      .legend .swatch {
        margin-top: 4px;
      }
      .legend small {
        display: block;
        font-size: 12.5px;
        line-height: 1.4;
        color: var(--ink-soft);
      }
    `,
  ];

  constructor() {
    super();
    this.tables = [];
    this.counted = null;
    this.hidden_ = new Set();
    this.colouring = "photo";
  }

  override render(): TemplateResult {
    const counts = this.counted?.classes ?? countClasses(this.tables);
    return html`
      <h2 class="eyebrow" id="colours">Colours</h2>
      <div class="segments" role="radiogroup" aria-labelledby="colours">
        ${COLOURINGS.map(
          ({ value, label }) => html`<button role="radio" aria-checked=${this.colouring === value}
            @click=${() => this.#emit("colouring", value)}>${label}</button>`,
        )}
      </div>
      ${this.colouring === "provenance" ? this.#legend() : ""}
      <h2 class="eyebrow">Layers</h2>
      <ul>
        ${CLASSES.filter((kind) => counts.has(kind)).map((kind) => this.#layer(kind, counts.get(kind) ?? 0))}
      </ul>
    `;
  }

  #layer(kind: SemanticClass, count: number): TemplateResult {
    const visible = !this.hidden_.has(kind);
    const { plural, colour } = CLASS_LOOKS[kind];
    return html`<li>
      <button class="row" role="switch" aria-checked=${visible} data-class=${kind}
        title=${visible ? `Hide: ${plural}` : `Show: ${plural}`}
        @click=${() => this.#emit("layer", { kind, visible: !visible })}>
        <span class="swatch" .style=${`background:${colour}`}></span>
        <span class="name hides">${plural}</span>
        <span class="count">${count}</span>
        ${visible ? icons.eye : icons.eyeOff}
      </button>
    </li>`;
  }

  #legend(): TemplateResult {
    const counts = this.counted?.provenances ?? countProvenances(this.tables);
    return html`<ul class="legend">
      ${PROVENANCES.map((kind) => {
        const { label, meaning, colour } = PROVENANCE_LOOKS[kind];
        return html`<li class="row">
          <span class="swatch" .style=${`background:${colour}`}></span>
          <span class="name">${label}<small>${meaning}</small></span>
          <span class="count">${counts.get(kind) ?? 0}</span>
        </li>`;
      })}
    </ul>`;
  }

  #emit(name: "colouring" | "layer", detail: unknown): void {
    this.dispatchEvent(new CustomEvent(name, { detail }));
  }
}

customElements.define("veduta-layers", LayersPanel);
