/** What is seen while the place arrives. */
import { css, html, LitElement, type TemplateResult } from "lit";
import { theme } from "./theme.ts";

export class LoadingScreen extends LitElement {
  static override properties = { share: { type: Number }, file: { type: String } };
  /** 0..1 */
  declare share: number;
  declare file: string;

  static override styles = [
    theme,
    css`
      :host {
        position: absolute;
        inset: 0;
        display: grid;
        place-content: center;
        justify-items: center;
        gap: 20px;
        background: linear-gradient(#d5e1ea, #f1efe9);
      }
      svg {
        width: 92px;
        height: 92px;
        color: var(--deep);
      }
      path {
        stroke-dasharray: 1;
        stroke-dashoffset: 0;
        animation: draw 2.2s ease-in-out infinite alternate;
      }
      @keyframes draw {
        from {
          stroke-dashoffset: 0.82;
        }
      }
      .bar {
        width: min(280px, 70vw);
        height: 4px;
        border-radius: 2px;
        background: rgb(31 58 77 / 0.15);
        overflow: hidden;
      }
      .bar > div {
        height: 100%;
        border-radius: inherit;
        background: var(--deep);
        transition: width 0.2s;
      }
      p {
        color: var(--ink-soft);
        font-variant-numeric: tabular-nums;
        min-height: 1.5em;
      }
    `,
  ];

  constructor() {
    super();
    this.share = 0;
    this.file = "";
  }

  override render(): TemplateResult {
    const percent = Math.round(100 * this.share);
    return html`
      <svg viewBox="0 0 92 92" fill="none" stroke="currentColor" stroke-width="2.2" stroke-linecap="round"
        stroke-linejoin="round" aria-hidden="true">
        <path pathLength="1" d="M14 74V36l32-20 32 20v38" />
        <path pathLength="1" d="M28 74V46h12v28M52 74V46h12v28M8 74h76" />
      </svg>
      <div class="bar" role="progressbar" aria-label="Loading the place" aria-valuemin="0"
        aria-valuemax="100" aria-valuenow=${percent}>
        <div .style=${`width:${percent}%`}></div>
      </div>
      <p aria-live="polite">${this.file === "" ? "Looking for the place" : `${this.file} · ${percent} %`}</p>
    `;
  }
}

customElements.define("veduta-loading", LoadingScreen);
