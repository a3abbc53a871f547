/** A clock and a network that a test moves. */
import type { Surroundings } from "../../src/core/asking.ts";

export class Fake implements Surroundings {
  pauses: number[] = [];
  #then: (() => void) | null = null;
  network: () => void = () => undefined;

  after(pause_ms: number, then: () => void): () => void {
    this.pauses.push(pause_ms);
    this.#then = then;
    return () => (this.#then = null);
  }

  onNetwork(then: () => void): () => void {
    this.network = then;
    return () => undefined;
  }

  wait(): void {
    const then = this.#then;
    this.#then = null;
    then?.();
  }
}
