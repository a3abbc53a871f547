/** Takes the walker along the tour that was chosen, until he goes his own way. */
import type { StudioState } from "../core/state.ts";
import type { Store } from "../core/store.ts";
import { durationOf, type Tour, type TourState, type TourView, viewAt } from "../core/tour.ts";

/** A slow machine sees all of the tour; only a page that slept does not leap. */
const LONGEST_FRAME_S = 0.5;
/** The page is told so often where one is. */
const TELL_S = 0.25;

export class TourGuide {
  readonly #tours: readonly Tour[];
  readonly #store: Store<StudioState>;
  #which = 0;
  #time_s = 0;
  /** What the guide itself told the page last: anything else there is the person's wish. */
  #told: TourState | null = null;

  /** There is one tour at least. */
  constructor(tours: readonly Tour[], store: Store<StudioState>) {
    this.#tours = tours;
    this.#store = store;
  }

  get #tour(): Tour {
    const tour = this.#tours[this.#which];
    if (tour === undefined) throw new RangeError(`no tour ${this.#which}`);
    return tour;
  }

  get isPlaying(): boolean {
    return this.#store.value.tour?.playing ?? false;
  }

  /** The view that the person asked for by the player; null where the page only repeats the guide. */
  wished(asked: TourState | null): TourView | null {
    if (asked === null || asked === this.#told) return null;
    // Play and pause go on from between the times that the page was told.
    if (asked.time_s !== this.#told?.time_s || asked.which !== this.#which) this.#time_s = asked.time_s;
    this.#which = asked.which;
    return viewAt(this.#tour, this.#time_s);
  }

  /** The view after `seconds` more. */
  advance(seconds: number): TourView {
    const end_s = durationOf(this.#tour);
    this.#time_s = Math.min(end_s, this.#time_s + Math.min(seconds, LONGEST_FRAME_S));
    const playing = this.#time_s < end_s;
    const shown_s = this.#store.value.tour?.time_s ?? 0;
    if (!playing || this.#time_s - shown_s >= TELL_S) this.#tell(playing);
    return viewAt(this.#tour, this.#time_s);
  }

  /** The visitor goes on by himself; the tour waits where he left it. */
  stop(): void {
    if (this.isPlaying) this.#tell(false);
  }

  #tell(playing: boolean): void {
    this.#told = { which: this.#which, time_s: this.#time_s, playing };
    this.#store.update({ tour: this.#told });
  }
}
