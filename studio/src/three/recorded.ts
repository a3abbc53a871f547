/** What was recorded, beside the model that was made of it: it is fetched when it is first wanted. */
import { type Object3D, Vector2 } from "three";
import type { Missing } from "../core/asking.ts";
import type { Part } from "../core/place.ts";
import type { Sight } from "../core/sight.ts";
import { Arrivals } from "./arrivals.ts";
import type { PartSlot } from "./part-slot.ts";

/** What draws: its size is in CSS pixels, from the left and from below. */
export interface Wiped {
  getSize(size: Vector2): Vector2;
  setScissor(x: number, y: number, width: number, height: number): void;
  setScissorTest(isOn: boolean): void;
}

/** The arrivals of parts: those of the page, or those of a test. */
export type Bringing = (parts: readonly Part[], fetch: (index: number) => Promise<void>, onChange: () => void) => Arrivals;

/** What is seen first, and of it the nearest. */
export function bringingBy(sight: () => Sight): Bringing {
  return (parts, fetch, onChange) => new Arrivals(parts, sight, fetch, onChange);
}

export class Recorded {
  /** Parts that have a record, and what has come of it. */
  readonly #kept: readonly { readonly slot: PartSlot; readonly raw: string; nodes: readonly Object3D[] }[];
  readonly #load: (part: Part) => Promise<readonly Object3D[]>;
  readonly #onChange: () => void;
  readonly #bringing: Bringing;
  #arrivals: Arrivals | null = null;

  /** `onChange` is called when a record has come, or has not. */
  constructor(
    slots: readonly PartSlot[],
    load: (part: Part) => Promise<readonly Object3D[]>,
    onChange: () => void,
    bringing: Bringing,
  ) {
    this.#kept = slots.flatMap((slot) => (slot.part.raw === null ? [] : [{ slot, raw: slot.part.raw, nodes: [] }]));
    this.#load = load;
    this.#onChange = onChange;
    this.#bringing = bringing;
  }

  /** Asks for what has not been asked for; what does not come is asked for again. */
  fetch(): void {
    const parts = this.#kept.map(({ slot, raw }) => ({ ...slot.part, model: raw }));
    this.#arrivals ??= this.#bringing(parts, async (index) => await this.#bring(index), this.#onChange);
    this.#arrivals.start();
  }

  /** Records that are asked for and have not come yet. */
  get waiting(): number {
    return this.#arrivals?.waiting ?? 0;
  }

  get missing(): readonly Missing[] {
    return this.#arrivals?.missing ?? [];
  }

  /** Does not wait for the end of a pause. */
  askNow(): void {
    this.#arrivals?.askNow();
  }

  dispose(): void {
    this.#arrivals?.dispose();
  }

  /** What was recorded, or the models. What was made is never shown as recorded: where a record has not come there is nothing. */
  show(isRecord: boolean): void {
    if (this.#arrivals === null) return;
    for (const { slot, nodes } of this.#kept) {
      for (const child of slot.group.children) child.visible = nodes.includes(child) === isRecord;
    }
  }

  /** Draws what was recorded up to a share of the width, and the models beyond it. */
  draw(renderer: Wiped, share: number, render: () => void): void {
    // Of most places nothing was recorded: they are not to be drawn twice.
    if (this.#kept.length === 0) {
      render();
      return;
    }
    const { x: width, y: height } = renderer.getSize(new Vector2());
    const edge = Math.round(share * width);
    renderer.setScissorTest(true);
    for (const [isRecord, left, right] of [[true, 0, edge], [false, edge, width]] as const) {
      if (right <= left) continue;
      this.show(isRecord);
      renderer.setScissor(left, 0, right - left, height);
      render();
    }
    this.show(false);
    renderer.setScissorTest(false);
  }

  async #bring(index: number): Promise<void> {
    const kept = this.#kept[index];
    if (kept === undefined) return;
    const { slot, raw } = kept;
    const nodes = [...(await this.#load({ ...slot.part, model: raw }))];
    for (const node of nodes) node.visible = false;
    slot.group.add(...nodes);
    slot.group.updateMatrixWorld(true);
    kept.nodes = nodes;
  }
}
