/** When pictures are drawn: one after the other while something moves, and none while nothing does. */
import { FramePace } from "./frame-pace.ts";

export class DrawLoop {
  readonly #move: (seconds: number) => boolean;
  readonly #draw: (sharpness: number) => void;
  readonly #pace = new FramePace();
  #request = 0;

  /** `move` brings everything so many seconds on, and tells whether more is to come. */
  constructor(move: (seconds: number) => boolean, draw: (sharpness: number) => void) {
    this.#move = move;
    this.#draw = draw;
  }

  get framesPerSecond(): number {
    return this.#pace.perSecond;
  }

  ask(): void {
    if (this.#request === 0) this.#request = requestAnimationFrame((now) => this.#frame(now));
  }

  stop(): void {
    cancelAnimationFrame(this.#request);
  }

  #frame(now_ms: number): void {
    this.#request = 0;
    const goesOn = this.#move(this.#pace.begin(now_ms));
    this.#draw(goesOn ? this.#pace.sharpness : 1);
    this.#pace.end(now_ms, goesOn);
    if (goesOn) this.ask();
  }
}
