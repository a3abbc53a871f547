/** Keys and gestures, from the same table that the page obeys. */
import { css, html, type TemplateResult } from "lit";
import { COMMAND_BINDINGS, HOLD_BINDINGS } from "../core/input.ts";
import { icons } from "./icons.ts";
import { Modal } from "./modal.ts";

const GESTURES: readonly { readonly shown: string; readonly text: string }[] = [
  { shown: "Click", text: "What is this surface?" },
  { shown: "Drag", text: "Turn the place; while walking, look around" },
  { shown: "Wheel", text: "Nearer and farther" },
  { shown: "Right drag", text: "Move the place sideways" },
];

export class HelpDialog extends Modal {
  static override styles = [
    ...Modal.styles,
    css`
      dialog {
        width: min(760px, calc(100vw - 32px));
        padding: 28px 32px 32px;
        border-radius: 18px;
      }
      dialog::backdrop {
        background: rgb(25 38 50 / 0.42);
        backdrop-filter: blur(3px);
      }
      .head {
        display: flex;
        justify-content: space-between;
        align-items: center;
        margin-bottom: 18px;
      }
      h2 {
        font-size: 20px;
        font-weight: 620;
        letter-spacing: -0.01em;
      }
      .columns {
        display: grid;
        grid-template-columns: repeat(auto-fit, minmax(260px, 1fr));
        gap: 24px 40px;
      }
      h3 {
        margin-bottom: 8px;
      }
      dl {
        display: grid;
        grid-template-columns: auto 1fr;
        align-items: center;
        gap: 7px 14px;
      }
      dt {
        justify-self: start;
        display: flex;
        gap: 4px;
      }
      dd {
        color: var(--ink-soft);
      }
      section + section {
        margin-top: 20px;
      }
    `,
  ];

  override render(): TemplateResult {
    return html`<dialog aria-labelledby="title" @click=${(event: Event) => this.onClick(event)}>
      <div class="head">
        <h2 id="title">Looking and walking</h2>
        <button class="icon-button" aria-label="Close the help" @click=${() => this.toggle()}>${icons.close}</button>
      </div>
      <div class="columns">
        <div>
          ${list("Mouse and touch", GESTURES.map(({ shown, text }) => ({ keys: [shown], text })))}
          ${list("View", COMMAND_BINDINGS.map(({ shown, text }) => ({ keys: [shown], text })))}
        </div>
        <div>
          ${list(
            "Walking",
            HOLD_BINDINGS.map(({ shown, text }) => ({ keys: shown === "Page ↑" || shown === "Page ↓" ? [shown] : shown.split(" "), text })),
          )}
        </div>
      </div>
    </dialog>`;
  }
}

function list(title: string, lines: readonly { keys: readonly string[]; text: string }[]): TemplateResult {
  return html`<section>
    <h3 class="eyebrow">${title}</h3>
    <dl>
      ${lines.map(
        ({ keys, text }) => html`<dt>${keys.map((key) => html`<kbd>${key}</kbd>`)}</dt>
          <dd>${text}</dd>`,
      )}
    </dl>
  </section>`;
}

customElements.define("veduta-help", HelpDialog);
