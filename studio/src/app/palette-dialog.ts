/** All commands by their names: type to find one, Enter does it. */
import { css, html, nothing, type TemplateResult } from "lit";
import { type Entry, matching } from "../core/palette.ts";
import { Modal } from "./modal.ts";

export class PaletteDialog extends Modal {
  static override properties = { entries: { attribute: false }, typed: { state: true }, active: { state: true } };
  declare entries: readonly Entry[];
  declare typed: string;
  /** Which of those that are found Enter does. */
  declare active: number;

  static override styles = [
    ...Modal.styles,
    css`
      dialog {
        width: min(520px, calc(100vw - 32px));
        margin-top: min(12vh, 96px);
        padding: 14px;
        border-radius: 16px;
      }
      dialog::backdrop {
        background: rgb(25 38 50 / 0.28);
      }
      input {
        width: 100%;
        padding: 10px 12px;
        border: 1px solid var(--line);
        border-radius: 10px;
        background: #fff;
        color: inherit;
        font: inherit;
      }
      input:focus-visible {
        outline: 2px solid var(--accent);
        outline-offset: 1px;
      }
      .found {
        max-height: min(52vh, 420px);
        margin-top: 10px;
        overflow: auto;
      }
      .row {
        display: flex;
        justify-content: space-between;
        align-items: center;
        gap: 12px;
        padding: 8px 10px;
        border-radius: 8px;
        font-size: 14px;
        cursor: pointer;
      }
      .row:hover {
        background: var(--hover);
      }
      .row[aria-selected="true"] {
        background: var(--deep);
        color: #fff;
      }
      .row[aria-selected="true"] kbd {
        background: transparent;
        color: inherit;
      }
      @media (forced-colors: active) {
        .row[aria-selected="true"] {
          outline: 2px solid Highlight;
          outline-offset: -2px;
        }
      }
      .none {
        padding: 10px;
        color: var(--ink-soft);
      }
    `,
  ];

  constructor() {
    super();
    this.entries = [];
    this.typed = "";
    this.active = 0;
  }

  protected override open(): void {
    this.typed = "";
    this.active = 0;
    super.open();
    this.renderRoot.querySelector("input")?.select();
  }

  get #found(): readonly Entry[] {
    return matching(this.entries, this.typed);
  }

  override updated(): void {
    this.renderRoot.querySelector('[aria-selected="true"]')?.scrollIntoView({ block: "nearest" });
  }

  override render(): TemplateResult {
    const found = this.#found;
    const isNothing = found.length === 0;
    return html`<dialog aria-label="Commands" @click=${(event: Event) => this.onClick(event)}>
      <input type="text" role="combobox" aria-label="Find a command" placeholder="Find a command" autocomplete="off" spellcheck="false"
        aria-expanded="true" aria-controls="found" aria-autocomplete="list" aria-activedescendant=${isNothing ? nothing : `command-${this.active}`}
        .value=${this.typed} @input=${(event: Event) => this.#onInput(event)} @keydown=${(event: KeyboardEvent) => this.#onKey(event)} />
      <div class="found" id="found" role="listbox" aria-label="Commands">${found.map((entry, index) => this.#row(entry, index))}</div>
      <p class="none" role="status">${isNothing ? "No command of that name" : nothing}</p>
    </dialog>`;
  }

  #row(entry: Entry, index: number): TemplateResult {
    return html`<div class="row" role="option" id=${`command-${index}`} aria-selected=${index === this.active}
      @click=${() => this.#do(entry)}><span>${entry.text}</span>${entry.key === "" ? nothing : html`<kbd>${entry.key}</kbd>`}</div>`;
  }

  #onInput(event: Event): void {
    this.typed = (event.target as HTMLInputElement).value;
    this.active = 0;
  }

  #onKey(event: KeyboardEvent): void {
    const { length } = this.#found;
    // Elsewhere these keys walk and turn.
    event.stopPropagation();
    if (event.key === "ArrowDown") this.active = length === 0 ? 0 : (this.active + 1) % length;
    else if (event.key === "ArrowUp") this.active = length === 0 ? 0 : (this.active + length - 1) % length;
    else if (event.key === "Enter") this.#do(this.#found[this.active]);
    else if (event.code === "KeyK" && (event.ctrlKey || event.metaKey)) this.toggle();
    else return;
    event.preventDefault();
  }

  #do(entry: Entry | undefined): void {
    if (entry === undefined) return;
    this.dialog?.close();
    this.dispatchEvent(new CustomEvent("command", { detail: entry.name }));
  }
}

customElements.define("veduta-palette", PaletteDialog);
