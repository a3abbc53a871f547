import { Matrix4, Object3D, type Vector2 } from "three";
import { describe, expect, it } from "vitest";
import type { Surroundings } from "../../src/core/asking.ts";
import { Absent, Fault } from "../../src/core/fault.ts";
import type { Part } from "../../src/core/place.ts";
import { Arrivals } from "../../src/three/arrivals.ts";
import type { PartSlot } from "../../src/three/part-slot.ts";
import { type Bringing, Recorded, type Wiped } from "../../src/three/recorded.ts";
import { Fake } from "./surroundings.ts";

function slot(raw: string | null): { slot: PartSlot; model: Object3D } {
  const [group, model] = [new Object3D(), new Object3D()];
  group.add(model);
  const worldFromPart = new Matrix4().toArray();
  const part = { model: "a.glb", raw, worldFromPart, bounds: null, isGround: false, isBackdrop: false };
  return { slot: { part, group } as unknown as PartSlot, model };
}

const during =
  (pauses: Surroundings): Bringing =>
  (parts, fetch, onChange) =>
    new Arrivals(parts, () => ({ eye: [0, 0, 0], direction: null, half_rad: 0 }), fetch, onChange, pauses);

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
  it("costs no second picture where there is none", () => {
    const recorded = new Recorded([slot(null).slot], async () => await Promise.resolve([]), () => undefined, during(new Fake()));
    const canvas = new Canvas();
    let drawn = 0;
    recorded.draw(canvas, 0.5, () => (drawn += 1));
    expect([drawn, canvas.isOn]).toEqual([1, false]);
  });

  it("is fetched when it is first wanted, and drawn to the left of the model", async () => {
    const { slot: one, model } = slot("raw/a.glb");
    const record = new Object3D();
    const asked: string[] = [];
    const load = async ({ model: file }: Part): Promise<Object3D[]> => {
      asked.push(file);
      return await Promise.resolve([record]);
    };
    let changes = 0;
    const recorded = new Recorded([one], load, () => (changes += 1), during(new Fake()));
    recorded.show(false);
    expect(asked).toEqual([]);
    recorded.fetch();
    recorded.show(true);
    expect([model.visible, recorded.waiting]).toEqual([false, 1]); // what was made is not shown as recorded
    recorded.show(false);
    expect(model.visible).toBe(true);
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

  it("is not asked for where there is none: what has no record stays as it is", async () => {
    const without = slot(null);
    let asked = 0;
    const load = async (): Promise<Object3D[]> => await Promise.resolve(Array.from({ length: (asked += 1) }, () => new Object3D()));
    const recorded = new Recorded([without.slot], load, () => undefined, during(new Fake()));
    recorded.fetch();
    await later();
    recorded.show(true);
    expect([asked, recorded.waiting, without.model.visible]).toEqual([0, 0, true]);
  });

  it("is named while it does not come, not shown by the model, and asked for again", async () => {
    const lost = slot("raw/b.glb");
    const record = new Object3D();
    let isThere = false;
    const load = async (): Promise<Object3D[]> => {
      if (!isThere) throw new Absent("raw/b.glb", "not there", "");
      return await Promise.resolve([record]);
    };
    const pauses = new Fake();
    const recorded = new Recorded([lost.slot], load, () => undefined, during(pauses));
    recorded.fetch();
    await later();
    recorded.show(true);
    expect(recorded.missing.map(({ file }) => file)).toEqual(["raw/b.glb"]);
    expect(lost.model.visible).toBe(false);
    isThere = true;
    pauses.wait();
    await later();
    recorded.show(true);
    expect([recorded.missing.length, record.visible, lost.model.visible]).toEqual([0, true, false]);
    recorded.show(false);
    expect([record.visible, lost.model.visible]).toEqual([false, true]);
  });

  it("is not asked for again where it is broken", async () => {
    let asked = 0;
    const load = async (): Promise<Object3D[]> => {
      asked += 1;
      return await Promise.reject(new Fault("raw/c.glb", "it is cut short", ""));
    };
    const pauses = new Fake();
    const recorded = new Recorded([slot("raw/c.glb").slot], load, () => undefined, during(pauses));
    recorded.fetch();
    await later();
    pauses.wait();
    recorded.askNow();
    recorded.fetch();
    await later();
    expect([asked, recorded.missing.length]).toEqual([1, 1]);
  });
});
