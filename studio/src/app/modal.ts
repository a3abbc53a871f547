/** What lies over the page until one is done with it: the help, and the commands. */
import { css, LitElement } from "lit";
import { theme } from "./theme.ts";

/** It draws one `<dialog>`. */
export class Modal extends LitElement {
  static override styles = [
    theme,
    css`
      dialog {
        max-height: calc(100dvh - 32px);
        border: 0;
        background: #fdfdfb;
        color: inherit;
        box-shadow: 0 24px 80px rgb(20 30 40 / 0.35);
      }
    `,
  ];

  protected get dialog(): HTMLDialogElement | null {
    return this.renderRoot.querySelector("dialog");
  }

  get isOpen(): boolean {
    return this.dialog?.open ?? false;
  }

  toggle(): void {
    if (this.isOpen) this.dialog?.close();
    else this.open();
  }

  protected open(): void {
    this.dialog?.showModal();
  }

  /** Beside what is in it: a click there closes it. */
  protected onClick(event: Event): void {
    if (event.target === this.dialog) this.toggle();
  }
}
