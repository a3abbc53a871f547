/** Clicks and drags on the canvas, told apart; and the captured mouse. */

export interface PointerActions {
  /** At CSS pixels of the canvas. */
  onClick(x: number, y: number): void;
  /** CSS pixels since the last call; by mouse capture or by dragging. */
  onLook(dx: number, dy: number, captured: boolean): void;
  onCapture(captured: boolean): void;
}

/** A press that moves less than this is a click. */
const CLICK_PX = 6;

export class CanvasPointer {
  readonly #canvas: HTMLCanvasElement;
  readonly #abort = new AbortController();
  readonly #presses = new Map<number, { x: number; y: number; moved: number }>();

  constructor(canvas: HTMLCanvasElement, actions: PointerActions) {
    this.#canvas = canvas;
    const signal = this.#abort.signal;
    canvas.addEventListener("pointerdown", (event) => this.#press(event), { signal });
    canvas.addEventListener("pointermove", (event) => this.#move(event, actions), { signal });
    canvas.addEventListener("pointerup", (event) => this.#release(event, actions), { signal });
    canvas.addEventListener("pointercancel", (event) => this.#presses.delete(event.pointerId), { signal });
    document.addEventListener("pointerlockchange", () => actions.onCapture(this.captured), { signal });
  }

  get captured(): boolean {
    return document.pointerLockElement === this.#canvas;
  }

  /** Asks the browser for the mouse; false where it refuses. */
  async capture(): Promise<boolean> {
    try {
      await this.#canvas.requestPointerLock();
      return true;
    } catch (error) {
      // Refused by the browser or the person; dragging still works, so this is no fault.
      if (error instanceof DOMException) return false;
      throw error;
    }
  }

  release(): void {
    if (this.captured) document.exitPointerLock();
  }

  dispose(): void {
    this.#abort.abort();
    this.release();
  }

  #press(event: PointerEvent): void {
    this.#presses.set(event.pointerId, { x: event.clientX, y: event.clientY, moved: 0 });
  }

  #move(event: PointerEvent, actions: PointerActions): void {
    if (this.captured) {
      actions.onLook(event.movementX, event.movementY, true);
      return;
    }
    const press = this.#presses.get(event.pointerId);
    if (press === undefined) return;
    const dx = event.clientX - press.x;
    const dy = event.clientY - press.y;
    press.x = event.clientX;
    press.y = event.clientY;
    press.moved += Math.hypot(dx, dy);
    if (this.#presses.size === 1) actions.onLook(dx, dy, false);
  }

  #release(event: PointerEvent, actions: PointerActions): void {
    const press = this.#presses.get(event.pointerId);
    this.#presses.delete(event.pointerId);
    if (press === undefined || press.moved > CLICK_PX || event.button !== 0) return;
    const box = this.#canvas.getBoundingClientRect();
    if (this.captured) actions.onClick(box.width / 2, box.height / 2);
    else actions.onClick(event.clientX - box.left, event.clientY - box.top);
  }
}
