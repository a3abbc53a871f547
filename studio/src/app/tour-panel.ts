/** The guided tours: which one, play and pause, how far one is, and the room that one is in. */
import { css, html, LitElement, nothing, type TemplateResult } from "lit";
import { durationOf, stretchAt, type Tour, type TourState } from "../core/tour.ts";
import { icons } from "./icons.ts";
import { lineStyles } from "./line-styles.ts";
import { theme } from "./theme.ts";

/** Of the slider (s). */
const STEP_S = 0.1;

export class TourPanel extends LitElement {
  static override properties = {
    tours: { attribute: false },
    at: { attribute: false },
  };
  declare tours: readonly Tour[];
  /** Null before it was begun. */
  declare at: TourState | null;

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
        flex: 0 0 96px;
        min-width: 0;
        line-height: 1.25;
      }
      select {
        flex: 0 1 150px;
        min-width: 60px;
        padding: 5px 6px;
        border: none;
        border-radius: 8px;
        background: var(--hover);
        font: inherit;
        color: inherit;
        text-overflow: ellipsis;
      }
    `,
  ];

  constructor() {
    super();
    this.tours = [];
    this.at = null;
  }

  override render(): TemplateResult | typeof nothing {
    const { tours, at } = this;
    const tour = tours[at?.which ?? 0];
    if (tour === undefined) return nothing;
    const playing = at?.playing ?? false;
    const time_s = at?.time_s ?? 0;
    const label = playing ? "Pause the tour (G)" : "Play the tour (G)";
    const name = at === null ? "Tour" : (stretchAt(tour, time_s)?.name ?? "Tour");
    return html`<button class="icon-button" aria-label=${label} title=${label} aria-pressed=${playing} data-field="play"
        @click=${() => this.#emit("play-tour", 0)}>${playing ? icons.pause : icons.play}</button>
      ${tours.length > 1 ? this.#choice(at?.which ?? 0) : nothing}
      <div class="where"><strong data-field="room" title=${name}>${name}</strong>
        <span data-field="time">${clock(time_s)} of ${clock(durationOf(tour))}</span></div>
      <input type="range" aria-label="How far the tour is" min="0" max=${durationOf(tour)} step=${STEP_S}
        aria-valuetext="${clock(time_s)}, ${name}" .value=${String(time_s)}
        @input=${(event: Event) => this.#emit("seek-tour", Number((event.target as HTMLInputElement).value))} />`;
  }

  #choice(which: number): TemplateResult {
    return html`<select aria-label="Which tour" data-field="which"
      @change=${(event: Event) => this.#emit("choose-tour", (event.target as HTMLSelectElement).selectedIndex)}>
      ${this.tours.map((tour, index) => html`<option .selected=${index === which}>${tour.name}</option>`)}
    </select>`;
  }

  #emit(name: "choose-tour" | "play-tour" | "seek-tour", detail: number): void {
    this.dispatchEvent(new CustomEvent(name, { detail, bubbles: true, composed: true }));
  }
}

/** Minutes and seconds. */
function clock(seconds: number): string {
  const whole = Math.floor(seconds);
  return `${Math.floor(whole / 60)}:${String(whole % 60).padStart(2, "0")}`;
}

customElements.define("veduta-tour-panel", TourPanel);
