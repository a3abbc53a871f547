/** The animals: which one, go and stand, which clip, the camera with it, and leading it by clicks. */
import { css, html, LitElement, nothing, type TemplateResult } from "lit";
import type { Animal, AnimalState } from "../core/animal.ts";
import { STANDING } from "../core/animal.ts";
import { icons } from "./icons.ts";
import { lineStyles } from "./line-styles.ts";
import { theme } from "./theme.ts";

export class AnimalPanel extends LitElement {
  static override properties = {
    animals: { attribute: false },
    at: { attribute: false },
  };
  declare animals: readonly Animal[];
  declare at: AnimalState;

  static override styles = [
    theme,
    lineStyles,
    css`
      :host {
        display: flex;
        align-items: center;
        gap: 8px;
        padding: 5px 14px 5px 6px;
      }
      .who {
        flex: 1 1 90px;
        min-width: 0;
        line-height: 1.25;
      }
      select {
        flex: 0 1 110px;
        min-width: 60px;
        padding: 5px 6px;
        border: none;
        border-radius: 8px;
        background: var(--hover);
        font: inherit;
        color: inherit;
        text-overflow: ellipsis;
      }
      .toggle {
        padding: 5px 10px;
        border: none;
        border-radius: 8px;
        background: var(--hover);
        font: inherit;
        color: inherit;
        cursor: pointer;
      }
      .toggle[aria-pressed="true"] {
        background: var(--deep);
        color: #fff;
      }
    `,
  ];

  constructor() {
    super();
    this.animals = [];
    this.at = STANDING;
  }

  override render(): TemplateResult | typeof nothing {
    const { animals, at } = this;
    const animal = animals[at.which];
    if (animal === undefined) return nothing;
    const label = at.playing ? `Let ${animal.name} stand` : `Let ${animal.name} go`;
    const size = animal.length_m < 1 ? `${(100 * animal.length_m).toPrecision(3)} cm` : `${animal.length_m.toPrecision(3)} m`;
    return html`<button class="icon-button" aria-label=${label} title=${label} aria-pressed=${at.playing} data-field="go"
        @click=${() => this.#change({ playing: !at.playing })}>${at.playing ? icons.pause : icons.play}</button>
      ${animals.length > 1
        ? this.#choice("Which animal", animals.map(({ name }) => name), at.which, (which) => this.#change({ which, clip: 0 }))
        : html`<div class="who"><strong title=${animal.name}>${animal.name}</strong><span>${size} long</span></div>`}
      ${this.#choice("Which motion", animal.clips.map(({ name }) => name), at.clip, (clip) => this.#change({ clip }))}
      ${this.#toggle("follow", "Follow", "The camera goes with it", at.following, { following: !at.following })}
      ${this.#toggle("lead", "Lead", "It goes where you click", at.leading, { leading: !at.leading })}`;
  }

  #toggle(field: string, words: string, title: string, pressed: boolean, change: Partial<AnimalState>): TemplateResult {
    return html`<button class="toggle" data-field=${field} title=${title} aria-pressed=${pressed}
      @click=${() => this.#change(change)}>${words}</button>`;
  }

  #choice(label: string, names: readonly string[], now: number, choose: (index: number) => void): TemplateResult {
    return html`<select aria-label=${label}
      @change=${(event: Event) => choose((event.target as HTMLSelectElement).selectedIndex)}>
      ${names.map((name, index) => html`<option .selected=${index === now}>${name}</option>`)}
    </select>`;
  }

  #change(change: Partial<AnimalState>): void {
    this.dispatchEvent(new CustomEvent("change-animal", { detail: change, bubbles: true, composed: true }));
  }
}

customElements.define("veduta-animal-panel", AnimalPanel);
