/** What was recorded, beside the model that was made of it: it is fetched when it is first wanted. */
import { type Object3D, Vector2 } from "three";
import { Fault } from "../core/fault.ts";
import type { Part } from "../core/place.ts";
import type { PartSlot } from "./part-slot.ts";

/** What draws: its size is in CSS pixels, from the left and from below. */
export interface Wiped {
  getSize(size: Vector2): Vector2;
  setScissor(x: number, y: number, width: number, height: number): void;
  setScissorTest(isOn: boolean): void;
}

export class Recorded {
  readonly #slots: readonly PartSlot[];
  readonly #load: (part: Part) => Promise<readonly Object3D[]>;
  readonly #onChange: () => void;
  readonly #onFault: (fault: Fault) => void;
  /** What has come of each part; null while it is on its way, or where it does not come. */
  readonly #come = new Map<PartSlot, readonly Object3D[] | null>();

  constructor(
    slots: readonly PartSlot[],
    load: (part: Part) => Promise<readonly Object3D[]>,
    onChange: () => void,
    onFault: (fault: Fault) => void,
  ) {
    this.#slots = slots;
    this.#load = load;
    this.#onChange = onChange;
    this.#onFault = onFault;
  }

  /** Asks for what has not been asked for. */
  fetch(): void {
    for (const slot of this.#slots) {
      if (slot.part.raw !== null && !this.#come.has(slot)) void this.#fetch(slot, slot.part.raw);
    }
  }

  /** What was recorded, or the models; a part whose record is not there stays as it is. */
  show(isRecord: boolean): void {
    for (const [slot, nodes] of this.#come) {
      if (nodes === null) continue;
      for (const child of slot.group.children) child.visible = nodes.includes(child) === isRecord;
    }
  }

  /** Draws what was recorded up to a share of the width, and the models beyond it. */
  draw(renderer: Wiped, share: number, render: () => void): void {
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

  async #fetch(slot: PartSlot, model: string): Promise<void> {
    this.#come.set(slot, null);
    try {
      const nodes = [...(await this.#load({ ...slot.part, model }))];
      for (const node of nodes) node.visible = false;
      slot.group.add(...nodes);
      slot.group.updateMatrixWorld(true);
      this.#come.set(slot, nodes);
      this.#onChange();
    } catch (error) {
      if (!(error instanceof Fault)) throw error;
      this.#onFault(error);
    }
  }
}
