/** A stick for the thumb; says where it is as `stick` events, x right and y forward, -1..1. */
import { css, html, LitElement, type TemplateResult } from "lit";
import { theme } from "./theme.ts";

const RADIUS_PX = 44;

export class Joystick extends LitElement {
  static override styles = [
    theme,
    css`
      :host {
        display: block;
        width: 112px;
        height: 112px;
        touch-action: none;
      }
      .base {
        width: 100%;
        height: 100%;
        border-radius: 50%;
        display: grid;
        place-items: center;
        background: rgb(252 252 250 / 0.55);
        border: 1px solid rgb(255 255 255 / 0.8);
        box-shadow: var(--shadow);
      }
      .knob {
        width: 48px;
        height: 48px;
        border-radius: 50%;
        background: var(--deep);
        opacity: 0.86;
      }
    `,
  ];

  override render(): TemplateResult {
    return html`<div class="base" role="application" aria-label="Walk: drag in the direction to go"
      @pointerdown=${(event: PointerEvent) => this.#grab(event)}
      @pointermove=${(event: PointerEvent) => this.#drag(event)}
      @pointerup=${() => this.#put(0, 0)}
      @pointercancel=${() => this.#put(0, 0)}>
      <div class="knob"></div>
    </div>`;
  }

  #grab(event: PointerEvent): void {
    (event.currentTarget as HTMLElement).setPointerCapture(event.pointerId);
    this.#drag(event);
  }

  #drag(event: PointerEvent): void {
    const base = event.currentTarget as HTMLElement;
    if (!base.hasPointerCapture(event.pointerId)) return;
    const box = base.getBoundingClientRect();
    const x = (event.clientX - box.left - box.width / 2) / RADIUS_PX;
    const y = (box.top + box.height / 2 - event.clientY) / RADIUS_PX;
    const over = Math.max(1, Math.hypot(x, y));
    this.#put(x / over, y / over);
  }

  #put(x: number, y: number): void {
    const knob = this.renderRoot.querySelector<HTMLElement>(".knob");
    if (knob !== null) knob.style.translate = `${x * RADIUS_PX * 0.72}px ${-y * RADIUS_PX * 0.72}px`;
    this.dispatchEvent(new CustomEvent("stick", { detail: [x, y] as const }));
  }
}

customElements.define("veduta-joystick", Joystick);
