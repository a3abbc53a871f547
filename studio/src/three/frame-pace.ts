/** How fast pictures follow each other, and how sharp they can be because of it. */
import { FULL_PACE, paced, sharpnessOf } from "../core/pace.ts";

/** What is taken for the time since the last picture after a rest. */
const FIRST_S = 1 / 60;

export class FramePace {
  #last_ms: number | null = null;
  #pace = FULL_PACE;
  #streak = { frames: 0, seconds: 0 };

  /** Mean over the pictures that were drawn one after the other; 0 before there were two. */
  get perSecond(): number {
    const { frames, seconds } = this.#streak;
    return seconds > 0 ? frames / seconds : 0;
  }

  /** How sharp a picture of something that moves can be, a share. */
  get sharpness(): number {
    return sharpnessOf(this.#pace);
  }

  /** Seconds since the picture before. */
  begin(now_ms: number): number {
    if (this.#last_ms === null) return FIRST_S;
    const seconds = (now_ms - this.#last_ms) / 1000;
    this.#streak = { frames: this.#streak.frames + 1, seconds: this.#streak.seconds + seconds };
    this.#pace = paced(this.#pace, seconds);
    return seconds;
  }

  /** `goesOn`: whether another picture follows at once. */
  end(now_ms: number, goesOn: boolean): void {
    this.#last_ms = goesOn ? now_ms : null;
  }
}
