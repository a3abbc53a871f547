/** The full page that says what is wrong and what to do. */
import { css, html, LitElement, nothing, type TemplateResult } from "lit";
import type { Fault } from "../core/fault.ts";
import { theme } from "./theme.ts";

export class MessageCard extends LitElement {
  static override properties = { fault: { attribute: false } };
  declare fault: Fault | null;

  static override styles = [
    theme,
    css`
      :host {
        position: absolute;
        inset: 0;
        display: grid;
        place-items: center;
        padding: 24px;
        background: linear-gradient(#dfe7ed, #f1efe9);
        overflow: auto;
      }
      .card {
        width: min(560px, 100%);
        padding: 36px 40px 32px;
        background: #fff;
      }
      svg {
        width: 44px;
        height: 44px;
        margin-bottom: 18px;
        color: var(--accent);
      }
      h1 {
        font-size: 22px;
        line-height: 1.3;
        font-weight: 620;
        letter-spacing: -0.012em;
        margin-bottom: 20px;
      }
      dl {
        display: grid;
        grid-template-columns: auto 1fr;
        gap: 10px 20px;
        padding: 16px 0;
        border-block: 1px solid var(--line);
        margin-bottom: 20px;
      }
      dt {
        color: var(--ink-faint);
      }
      dd {
        overflow-wrap: anywhere;
      }
      dd:first-of-type {
        font-weight: 560;
      }
      code {
        font: 500 13px/1.4 ui-monospace, "SFMono-Regular", Menlo, Consolas, monospace;
        padding: 2px 6px;
        border-radius: 5px;
        background: #eef1f3;
      }
      .retry {
        padding: 10px 18px;
        border-radius: 10px;
        background: var(--deep);
        color: #fff;
        font-weight: 560;
      }
      .retry:hover {
        background: #2b4f68;
      }
      @media (max-width: 520px) {
        .card {
          padding: 28px 24px 24px;
        }
        dl {
          grid-template-columns: 1fr;
          gap: 2px;
        }
        dd {
          margin-bottom: 10px;
        }
      }
    `,
  ];

  constructor() {
    super();
    this.fault = null;
  }

  override render(): TemplateResult | typeof nothing {
    const { fault } = this;
    if (fault === null) return nothing;
    return html`<div class="card sheet" role="alert" aria-labelledby="title">
      <svg viewBox="0 0 44 44" fill="none" stroke="currentColor" stroke-width="2.4" aria-hidden="true"
        stroke-linecap="round" stroke-linejoin="round">
        <path d="M6 36V18L22 7l16 11v18" /><path d="M3 36h38" />
        <path d="M22 18v9" /><path d="M22 31.5v.1" stroke-width="3.2" />
      </svg>
      <h1 id="title">This place cannot be shown</h1>
      <dl>
        <dt>About</dt>
        <dd>${fault.subject}</dd>
        <dt>What is wrong</dt>
        <dd>${sentence(fault.fault)}</dd>
        <dt>What to do</dt>
        <dd>${withCode(fault.remedy)}</dd>
      </dl>
      <button class="retry" @click=${() => location.reload()}>Try again</button>
    </div>`;
  }
}

/** What stands between backticks is something to type. */
function withCode(words: string): (string | TemplateResult)[] {
  return words.split("`").map((piece, i) => (i % 2 === 1 ? html`<code>${piece}</code>` : piece));
}

function sentence(words: string): string {
  return `${words.charAt(0).toUpperCase()}${words.slice(1)}.`;
}

customElements.define("veduta-message", MessageCard);
