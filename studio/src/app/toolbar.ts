/** The bar of tools. It knows no state of its own: it shows what it is given and says what is asked. */
import { css, html, LitElement, nothing, type TemplateResult } from "lit";
import type { Command } from "../core/input.ts";
import type { Mode } from "../core/state.ts";
import { icons } from "./icons.ts";
import { theme } from "./theme.ts";

export class Toolbar extends LitElement {
  static override properties = {
    mode: { type: String },
    layersOpen: { type: Boolean },
    mouseLook: { type: Boolean },
    coarse: { type: Boolean },
    isDay: { attribute: false },
  };
  declare mode: Mode;
  declare layersOpen: boolean;
  declare mouseLook: boolean;
  /** The pointer is a finger. */
  declare coarse: boolean;
  /** Null where the place has no day and night. */
  declare isDay: boolean | null;

  static override styles = [
    theme,
    css`
      :host {
        display: flex;
        align-items: center;
        gap: 2px;
        padding: 6px;
      }
      .modes {
        display: flex;
        gap: 2px;
        padding: 3px;
        border-radius: 11px;
        background: var(--hover);
      }
      .modes button {
        display: flex;
        align-items: center;
        gap: 7px;
        height: 36px;
        padding: 0 13px 0 10px;
        border-radius: 9px;
        font-weight: 540;
        color: var(--ink-soft);
      }
      .modes button[aria-checked="true"] {
        background: var(--deep);
        color: #fff;
      }
      .modes svg {
        width: 19px;
        height: 19px;
      }
      .rule {
        width: 1px;
        height: 24px;
        margin: 0 5px;
        background: var(--line);
      }
      @media (max-width: 480px) {
        .modes button span {
          position: absolute;
          clip-path: inset(50%);
          width: 1px;
          height: 1px;
          overflow: hidden;
        }
        .modes button {
          padding: 0 10px;
        }
        .icon-button {
          width: 38px;
        }
        .rule {
          margin: 0 2px;
        }
      }
      @media (max-width: 350px) {
        .rule {
          display: none;
        }
        .icon-button {
          width: 36px;
        }
      }
    `,
  ];

  constructor() {
    super();
    this.mode = "orbit";
    this.layersOpen = false;
    this.mouseLook = false;
    this.coarse = false;
    this.isDay = null;
  }

  override render(): TemplateResult {
    return html`
      <div class="modes" role="radiogroup" aria-label="How to move">
        <button role="radio" aria-checked=${this.mode === "orbit"} title="Look from outside (1)"
          @click=${() => this.#ask("orbit")}>${icons.orbit}<span>Orbit</span></button>
        <button role="radio" aria-checked=${this.mode === "walk"} title="Walk (2)"
          @click=${() => this.#ask("walk")}>${icons.walk}<span>Walk</span></button>
      </div>
      <div class="rule"></div>
      ${this.#tool("reset", "Reset the view", "R", icons.reset)}
      ${this.mode === "walk" && !this.coarse
        ? this.#tool("mouse-look", "Look around with the mouse", "M", icons.mouse, this.mouseLook)
        : nothing}
      ${this.isDay === null ? nothing : this.#tool("daylight", this.isDay ? "Make it night" : "Make it day", "X", this.isDay ? icons.moon : icons.sun)}
      <button class="icon-button" aria-label="Layers and colours" title="Layers and colours (L)"
        aria-expanded=${this.layersOpen} @click=${() => this.#ask("layers")}>${icons.layers}</button>
      <div class="rule"></div>
      ${this.#tool("screenshot", "Save a picture", "C", icons.camera)}
      ${this.#tool("fullscreen", "Full screen", "F", icons.fullscreen)}
      ${this.#tool("help", "Help", "?", icons.help)}
    `;
  }

  #tool(
    command: Command,
    label: string,
    key: string,
    icon: TemplateResult,
    pressed?: boolean,
  ): TemplateResult {
    return html`<button class="icon-button" aria-label=${label} title="${label} (${key})"
      aria-pressed=${pressed ?? nothing} data-command=${command}
      @click=${() => this.#ask(command)}>${icon}</button>`;
  }

  #ask(command: Command): void {
    this.dispatchEvent(new CustomEvent("command", { detail: command }));
  }
}

customElements.define("veduta-toolbar", Toolbar);
