/** The line between what was recorded, to its left, and the place. */
import { css, html, LitElement, type TemplateResult } from "lit";

export class WipeLine extends LitElement {
  static override properties = { share: { type: Number } };
  /** Where it stands, as a share of the picture's width. */
  declare share: number;

  static override styles = css`
    :host {
      position: absolute;
      top: 0;
      bottom: 0;
      width: 2px;
      margin-left: -1px;
      background: #fff;
      box-shadow: 0 0 0 1px rgb(0 0 0 / 0.35);
      pointer-events: none;
    }
  `;

  constructor() {
    super();
    this.share = 0;
  }

  /** The policy of the page forbids styles in its text. */
  override updated(): void {
    this.style.left = `${String(100 * this.share)}%`;
  }

  override render(): TemplateResult {
    return html``;
  }
}

customElements.define("veduta-wipe-line", WipeLine);
