/** Day and night, lamps, doors and the map of a house. */
import { css, html, LitElement, type TemplateResult } from "lit";
import { hourText } from "../core/daylight.ts";
import { type Layer, type LightHabit, type StudioState, withLayer } from "../core/state.ts";
import { rowStyles } from "./row-styles.ts";
import { theme } from "./theme.ts";

const HABITS: readonly { readonly value: LightHabit; readonly label: string; readonly title: string }[] = [
  { value: "auto", label: "Auto", title: "Lamps go on in the room that you come into; from outside, by night, in all" },
  { value: "on", label: "On", title: "All lamps are on" },
  { value: "off", label: "Off", title: "All lamps are off" },
];

const NOTHING_OFF: ReadonlySet<Layer> = new Set();

export class HousePanel extends LitElement {
  static override properties = {
    state: { attribute: false },
    hasLamps: { type: Boolean },
    hasDoors: { type: Boolean },
    hasBackdrop: { type: Boolean },
    sunWords: { type: String },
  };
  declare state: Pick<StudioState, "hour" | "lights" | "doors" | "map" | "off"> | null;
  declare hasLamps: boolean;
  declare hasDoors: boolean;
  declare hasBackdrop: boolean;
  /** Of which day and place the sun is. */
  declare sunWords: string;

  static override styles = [
    theme,
    rowStyles,
    css`
      :host {
        display: block;
        padding: 16px 12px 0;
      }
      :host([hidden]) {
        display: none;
      }
      .eyebrow {
        padding: 0 8px;
        margin-bottom: 4px;
      }
      output {
        min-width: 38px;
        text-align: right;
        font-variant-numeric: tabular-nums;
        color: var(--ink);
      }
      .sun {
        margin: -2px 8px 6px;
        font-size: 12.5px;
        line-height: 1.35;
        color: var(--ink-soft);
      }
      .lamps {
        color: var(--ink-soft);
      }
      .segments {
        flex: 1;
        margin: 0 -4px 0 0;
      }
    `,
  ];

  constructor() {
    super();
    this.state = null;
    this.hasLamps = false;
    this.hasDoors = false;
    this.hasBackdrop = false;
    this.sunWords = "";
  }

  override render(): TemplateResult {
    const { hour = 0, lights = "auto", doors = "approach", map = true, off = NOTHING_OFF } = this.state ?? {};
    return html`
      <h2 class="eyebrow" id="house">House</h2>
      <label class="row">Time <input type="range" aria-label="Time of the day" min="0" max="23.75" step="0.25"
        .value=${String(hour)} @input=${(event: Event) => this.#change({ hour: Number((event.target as HTMLInputElement).value) })} />
        <output>${hourText(hour)}</output></label>
      <p class="sun">${this.sunWords}</p>
      ${this.hasLamps
        ? html`<div class="row"><span class="lamps">Lamps</span>
            <div class="segments" role="radiogroup" aria-label="Lamps">${HABITS.map(
              ({ value, label, title }) => html`<button role="radio" aria-checked=${lights === value} title="${title} (I)"
                @click=${() => this.#change({ lights: value })}>${label}</button>`,
            )}</div>
          </div>`
        : ""}
      ${this.hasDoors
        ? this.#switch("Doors stand open", "All doors stand open; else they open as you come (O)", doors === "open", {
            doors: doors === "open" ? "approach" : "open",
          })
        : ""}
      ${this.hasBackdrop
        ? this.#switch("Panorama", "The picture around the garden", !off.has("backdrop"), {
            off: withLayer(off, "backdrop", off.has("backdrop")),
          })
        : ""}
      ${this.#switch("Map while walking", "A map of the storey on which you walk (K)", map, { map: !map })}
    `;
  }

  #switch(label: string, title: string, isOn: boolean, change: Partial<StudioState>): TemplateResult {
    return html`<button class="row" role="switch" aria-checked=${isOn} title=${title} @click=${() => this.#change(change)}>
      <span class="name">${label}</span><i class="knob"></i></button>`;
  }

  #change(change: Partial<StudioState>): void {
    this.dispatchEvent(new CustomEvent("change-state", { detail: change }));
  }
}

customElements.define("veduta-house", HousePanel);
