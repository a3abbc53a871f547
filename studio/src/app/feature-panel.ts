/** What is known about the selected surface. */
import { css, html, LitElement, nothing, type TemplateResult } from "lit";
import { CLASS_LOOKS, PROVENANCE_LOOKS } from "../core/classes.ts";
import { countCarried, type Feature, type FeatureTable } from "../core/features.ts";
import { areaText, countText, scoreText, seenText, sizeText } from "../core/wording.ts";
import { icons } from "./icons.ts";
import "./photo-region.ts";
import { theme } from "./theme.ts";

export interface ShownFeature {
  readonly feature: Feature;
  readonly row: number;
  readonly table: FeatureTable;
  readonly partName: string;
  readonly severalParts: boolean;
  /** Whether lengths are metres: else none are told. */
  readonly scaleKnown: boolean;
  readonly arrangementInvented: boolean;
  readonly photoAddress: string | null;
}

export class FeaturePanel extends LitElement {
  static override properties = { shown: { attribute: false } };
  declare shown: ShownFeature | null;

  static override styles = [
    theme,
    css`
      :host {
        display: block;
        overflow: auto;
        padding: 18px 20px 20px;
        scrollbar-width: thin;
      }
      .head {
        display: flex;
        gap: 10px;
        align-items: start;
        justify-content: space-between;
        margin-bottom: 14px;
      }
      .kind {
        display: flex;
        align-items: center;
        gap: 8px;
      }
      h2 {
        font-size: 19px;
        line-height: 1.3;
        font-weight: 620;
        letter-spacing: -0.012em;
        margin-top: 4px;
        overflow-wrap: anywhere;
      }
      h2::first-letter,
      .parent span::first-letter {
        text-transform: uppercase;
      }
      .icon-button {
        margin: -6px -8px 0 0;
        flex: none;
      }
      .sizes {
        display: grid;
        grid-template-columns: 3fr 2fr;
        gap: 1px;
        border-radius: 10px;
        overflow: hidden;
        background: var(--line);
        border: 1px solid var(--line);
        margin-bottom: 16px;
      }
      .sizes > div {
        background: #fff;
        padding: 10px 12px;
      }
      .sizes dd {
        font-size: 16px;
        font-weight: 560;
        font-variant-numeric: tabular-nums;
        white-space: nowrap;
      }
      .sizes .seen {
        font-size: 12.5px;
        font-weight: 400;
        color: var(--ink-soft);
        white-space: normal;
      }
      dt {
        font-size: 12px;
        color: var(--ink-faint);
      }
      section {
        margin-top: 16px;
      }
      h3 {
        margin-bottom: 6px;
      }
      .provenance {
        display: grid;
        grid-template-columns: auto 1fr;
        gap: 2px 9px;
        align-items: center;
      }
      .provenance strong {
        font-weight: 580;
      }
      .provenance p {
        grid-column: 2;
        color: var(--ink-soft);
        font-size: 13px;
      }
      .parent {
        display: flex;
        align-items: center;
        gap: 8px;
        width: 100%;
        padding: 8px 10px;
        border: 1px solid var(--line);
        border-radius: 10px;
        background: #fff;
        text-align: left;
      }
      .parent:hover {
        background: #f5f5f2;
      }
      .parent span:nth-child(2) {
        display: block;
        flex: 1;
      }
      .parent svg {
        width: 16px;
        height: 16px;
        color: var(--ink-faint);
      }
      .note {
        font-size: 12.5px;
        color: var(--ink-soft);
      }
    `,
  ];

  constructor() {
    super();
    this.shown = null;
  }

  override render(): TemplateResult | typeof nothing {
    const { shown } = this;
    if (shown === null) return nothing;
    const { feature } = shown;
    const look = CLASS_LOOKS[feature.class];
    return html`
      <div class="head">
        <div>
          <div class="kind">
            <span class="swatch" .style=${`background:${look.colour}`}></span>
            <span class="eyebrow" data-field="class">${look.label}</span>
          </div>
          <h2 data-field="name">${feature.name === "" ? look.label : feature.name}</h2>
        </div>
        <button class="icon-button" aria-label="Close this panel (Esc)" title="Close (Esc)"
          @click=${() => this.#emit("close-panel", null)}>${icons.close}</button>
      </div>
      ${shown.scaleKnown ? sizes(feature) : html`<p class="note" data-field="scale">How large it is, nothing tells: the scale of the place is unknown.</p>`}
      ${provenance(feature)} ${this.#relations(shown)}
      ${shown.photoAddress === null && feature.photo_px === null
        ? nothing
        : html`<section>
            <h3 class="eyebrow">In the photo</h3>
            <veduta-photo-region .address=${shown.photoAddress} .rectangle=${feature.photo_px}></veduta-photo-region>
          </section>`}
      ${shown.severalParts ? building(shown) : nothing}
    `;
  }

  #relations(shown: ShownFeature): TemplateResult | typeof nothing {
    const { feature, table } = shown;
    const parent = feature.parent === null ? undefined : table.rows[feature.parent];
    const children = countCarried(table, shown.row);
    if (parent === undefined && children.size === 0) return nothing;
    return html`<section>
      ${parent === undefined
        ? nothing
        : html`<h3 class="eyebrow">Part of</h3>
            <button class="parent" data-field="parent" @click=${() => this.#emit("select-row", feature.parent)}>
              <span class="swatch" .style=${`background:${CLASS_LOOKS[parent.class].colour}`}></span>
              <span>${parent.name === "" ? CLASS_LOOKS[parent.class].label : parent.name}</span>
              ${icons.chevron}
            </button>`}
      ${children.size === 0
        ? nothing
        : html`<h3 class="eyebrow">Carries</h3>
            <p data-field="children">${[...children].map(([kind, count]) => countText(kind, count)).join(", ")}</p>`}
    </section>`;
  }

  #emit(name: "close-panel" | "select-row", detail: number | null): void {
    this.dispatchEvent(new CustomEvent(name, { detail, bubbles: true, composed: true }));
  }
}

/** What inferred means where the upper part is in the photo. */
const PARTLY_SEEN =
  "The photo shows its upper part. That it goes on further down follows, by a rule.";

function sizes(feature: Feature): TemplateResult {
  return html`<dl class="sizes">
    <div><dt>Width × height</dt><dd data-field="size">${sizeText(feature.width_m, feature.height_m)}</dd>${seen(feature)}</div>
    <div><dt>Area</dt><dd data-field="area">${areaText(feature.area_m2)}</dd></div>
  </dl>`;
}

function seen(feature: Feature): TemplateResult | typeof nothing {
  const text = seenText(feature.seen_height_m);
  return text === "" ? nothing : html`<dd class="seen" data-field="seen">${text}</dd>`;
}

function provenance(feature: Feature): TemplateResult {
  const look = PROVENANCE_LOOKS[feature.provenance];
  const partly = feature.provenance === "inferred" && feature.seen_height_m !== null;
  return html`<section>
    <h3 class="eyebrow">How it is known</h3>
    <div class="provenance">
      <span class="swatch" .style=${`background:${look.colour}`}></span>
      <strong data-field="provenance">${look.label}</strong>
      <p>${partly ? PARTLY_SEEN : look.meaning}</p>
      ${score(feature)}
    </div>
  </section>`;
}

function score(feature: Feature): TemplateResult | typeof nothing {
  const text = scoreText(feature.score);
  return text === "" ? nothing : html`<p data-field="score">${text}</p>`;
}

function building(shown: ShownFeature): TemplateResult {
  return html`<section>
    <h3 class="eyebrow">Building</h3>
    <p>${shown.partName}</p>
    ${shown.arrangementInvented
      ? html`<p class="note">Where it stands beside the others is invented: no record says so.</p>`
      : nothing}
  </section>`;
}

customElements.define("veduta-feature-panel", FeaturePanel);
