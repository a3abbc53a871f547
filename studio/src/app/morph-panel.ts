/** The walk from view to view: play and pause, how far one is, how one sees it, and how good the transition is. */
import { css, html, LitElement, nothing, type TemplateResult } from "lit";
import { headsetIsThere } from "../core/headset.ts";
import { goneOf, type MorphState, type MorphWalk, NO_SCALE, placeOn } from "../core/morph-walk.ts";
import { icons } from "./icons.ts";
import { lineStyles } from "./line-styles.ts";
import { theme } from "./theme.ts";

const KINDS = { morph: "morphs", fade: "cross-fades", cut: "is cut" } as const;

export class MorphPanel extends LitElement {
  static override properties = { walk: { attribute: false }, at: { attribute: false }, headset: { state: true } };
  declare walk: MorphWalk | null;
  /** Null while one is not on the walk. */
  declare at: MorphState | null;
  /** Whether there is one to walk in. */
  declare headset: boolean;

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
      .where {
        flex: 0 0 128px;
        min-width: 0;
        line-height: 1.25;
      }
      button.word {
        flex: none;
        padding: 5px 8px;
        border: none;
        border-radius: 8px;
        background: var(--hover);
        font: inherit;
        color: inherit;
      }
      button.word[aria-pressed="true"] {
        outline: 1.5px solid currentColor;
      }
      @media (max-width: 640px) {
        .where {
          flex-basis: 84px;
        }
      }
    `,
  ];

  constructor() {
    super();
    this.walk = null;
    this.at = null;
    this.headset = false;
  }

  override connectedCallback(): void {
    super.connectedCallback();
    void headsetIsThere().then((there) => (this.headset = there));
  }

  override render(): TemplateResult | typeof nothing {
    const { walk, at } = this;
    if (walk === null) return nothing;
    const playing = at?.playing ?? false;
    const label = playing ? "Pause the walk (G)" : "Walk on (G)";
    const now = at?.at ?? 0;
    const { transition } = placeOn(walk, now);
    const way = walk.transitions[transition];
    const how = way === undefined ? "one position" : `${transition + 1} of ${walk.transitions.length} ${KINDS[way.kind]}`;
    const gone = goneOf(walk, now);
    return html`<button class="icon-button" aria-label=${label} title=${label} aria-pressed=${playing} data-field="play"
        @click=${() => this.#emit("play-walk")}>${playing ? icons.pause : icons.play}</button>
      <div class="where"><strong data-field="metres" title=${walk.inMetres ? nothing : NO_SCALE}>${gone}</strong><span data-field="way" title=${how}>${how}</span></div>
      <input type="range" aria-label="How far the walk is" min="0" max=${walk.transitions.length} step="0.01" aria-valuetext=${gone}
        .value=${String(now)} @input=${(event: Event) => this.#emit("seek-walk", Number((event.target as HTMLInputElement).value))} />
      <button class="word" title="Picture, geometry, counterparts (J)" data-field="look" @click=${() => this.#emit("look-walk")}>${at?.look ?? "picture"}</button>
      <button class="word" title="From position to position without anything between" data-field="instant"
        aria-pressed=${at?.instant ?? false} @click=${() => this.#emit("instant-walk")}>instant</button>
      ${this.headset
        ? html`<button class="word" title="Walk in the headset" data-field="headset" @click=${() => this.#emit("headset-walk")}>headset</button>`
        : nothing}`;
  }

  #emit(name: "play-walk" | "seek-walk" | "look-walk" | "instant-walk" | "headset-walk", detail = 0): void {
    this.dispatchEvent(new CustomEvent(name, { detail, bubbles: true, composed: true }));
  }
}

customElements.define("veduta-morph-panel", MorphPanel);
