import { Object3D, type Vector2 } from "three";
import { describe, expect, it } from "vitest";
import { Fault } from "../../src/core/fault.ts";
import type { Part } from "../../src/core/place.ts";
import type { PartSlot } from "../../src/three/part-slot.ts";
import { Recorded, type Wiped } from "../../src/three/recorded.ts";

function slot(raw: string | null): { slot: PartSlot; model: Object3D } {
  const [group, model] = [new Object3D(), new Object3D()];
  group.add(model);
  return { slot: { part: { model: "a.glb", raw }, group } as unknown as PartSlot, model };
}

const later = async (): Promise<void> => await new Promise((resolve) => setTimeout(resolve));

/** Remembers the last part of its picture that may be drawn on. */
class Canvas implements Wiped {
  part: readonly number[] = [];
  isOn = false;
  getSize(size: Vector2): Vector2 {
    return size.set(200, 100);
  }
  setScissor(...part: readonly number[]): void {
    this.part = part;
  }
  setScissorTest(isOn: boolean): void {
    this.isOn = isOn;
  }
}

describe("what was recorded", () => {
  it("is fetched when it is first wanted, and drawn to the left of the model", async () => {
    const { slot: one, model } = slot("raw/a.glb");
    const record = new Object3D();
    const asked: string[] = [];
    const load = async ({ model: file }: Part): Promise<Object3D[]> => {
      asked.push(file);
      return await Promise.resolve([record]);
    };
    let changes = 0;
    const recorded = new Recorded([one], load, () => (changes += 1), () => undefined);
    recorded.show(false);
    expect(asked).toEqual([]);
    recorded.fetch();
    recorded.show(true);
    expect(model.visible).toBe(true); // nothing is hidden before the other is there
    await later();
    expect([asked, changes, model.visible, record.visible]).toEqual([["raw/a.glb"], 1, true, false]);
    recorded.fetch();
    expect(asked.length).toBe(1);

    const canvas = new Canvas();
    const drawn: unknown[] = [];
    const render = (): void => void drawn.push([canvas.isOn, canvas.part, record.visible, model.visible]);
    recorded.draw(canvas, 0.25, render);
    expect(drawn).toEqual([[true, [0, 0, 50, 100], true, false], [true, [50, 0, 150, 100], false, true]]);
    expect([canvas.isOn, model.visible, record.visible]).toEqual([false, true, false]);
    drawn.length = 0;
    recorded.draw(canvas, 0, render);
    recorded.draw(canvas, 1, render);
    expect(drawn).toEqual([[true, [0, 0, 200, 100], false, true], [true, [0, 0, 200, 100], true, false]]);
  });

  it("is not asked for where there is none, and a model stays where its record is missing", async () => {
    const [without, lost] = [slot(null), slot("raw/b.glb")];
    const faults: Fault[] = [];
    const load = async (): Promise<Object3D[]> => await Promise.reject(new Fault("raw/b.glb", "not there", ""));
    const recorded = new Recorded([without.slot, lost.slot], load, () => undefined, (fault) => faults.push(fault));
    recorded.fetch();
    await later();
    recorded.show(true);
    expect(faults.map(({ subject }) => subject)).toEqual(["raw/b.glb"]);
    expect([without.model.visible, lost.model.visible]).toEqual([true, true]);
  });
});
