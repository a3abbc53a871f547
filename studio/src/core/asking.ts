/** Asking again for what did not come: after growing pauses, and at once when the network is back. */

import type { Fault } from "./fault.ts";

/** A file that did not come, and why. */
export interface Missing {
  readonly file: string;
  readonly fault: Fault;
}

/** A browser holds six connections to a server of HTTP/1.1. */
export const AT_ONCE = 6;
const FIRST_PAUSE_MS = 2000;
const LONGEST_PAUSE_MS = 60_000;

/** The pause after so many failures in a row, 1 the first. */
export function pauseAfter_ms(failures: number): number {
  return Math.min(LONGEST_PAUSE_MS, FIRST_PAUSE_MS * 2 ** (failures - 1));
}

/** A clock and a network; those of the page, or those of a test. */
export interface Surroundings {
  /** Calls once after a time; the result cancels it. */
  after(pause_ms: number, then: () => void): () => void;
  /** Calls each time when the network has come back; the result ends that. */
  onNetwork(then: () => void): () => void;
}

export const PAGE: Surroundings = {
  after: (pause_ms, then) => {
    const timer = setTimeout(then, pause_ms);
    return () => clearTimeout(timer);
  },
  onNetwork: (then) => {
    globalThis.addEventListener("online", then);
    return () => globalThis.removeEventListener("online", then);
  },
};

export class Asking {
  readonly #ask: () => void;
  readonly #around: Surroundings;
  readonly #endNetwork: () => void;
  #failures = 0;
  #cancel: (() => void) | null = null;
  #isOver = false;

  constructor(ask: () => void, around: Surroundings = PAGE) {
    this.#ask = ask;
    this.#around = around;
    this.#endNetwork = around.onNetwork(() => this.now());
  }

  /** Something did not come: it is asked for again after a while. */
  failed(): void {
    if (this.#cancel !== null || this.#isOver) return;
    this.#failures += 1;
    this.#cancel = this.#around.after(pauseAfter_ms(this.#failures), () => {
      this.#cancel = null;
      this.#ask();
    });
  }

  /** Something came: the next pause is a short one. */
  succeeded(): void {
    this.#failures = 0;
  }

  /** Does not wait any longer, if something is waited for. */
  now(): void {
    if (this.#cancel === null) return;
    this.#cancel();
    this.#cancel = null;
    this.#ask();
  }

  dispose(): void {
    this.#isOver = true;
    this.#cancel?.();
    this.#cancel = null;
    this.#endNetwork();
  }
}
