import { describe, expect, it, vi } from "vitest";
import { COMMAND_BINDINGS, commandOf, HOLD_BINDINGS, holdOf, letGo, turnOf, wishOf } from "../../src/core/input.ts";
import { FULL_PACE, paced, sharpnessOf } from "../../src/core/pace.ts";
import { INITIAL_STATE, withLayer } from "../../src/core/state.ts";
import { Store } from "../../src/core/store.ts";
import { areaText, countText, sizeText } from "../../src/core/wording.ts";

const plain = { ctrlKey: false, altKey: false, metaKey: false };

describe("keys", () => {
  it("are let go of whatever else is pressed", () => {
    expect(holdOf({ ...plain, ctrlKey: true, code: "KeyW", key: "w" })).toBeNull();
    expect([letGo("KeyW"), letGo("ShiftRight"), letGo("KeyK")]).toEqual(["forward", "run", null]);
  });

  it("have one meaning each", () => {
    const codes = [...COMMAND_BINDINGS, ...HOLD_BINDINGS].flatMap((binding) => binding.codes);
    expect(new Set(codes).size).toBe(codes.length);
  });

  it("become commands and holds", () => {
    expect(commandOf({ ...plain, code: "KeyR", key: "r" })).toBe("reset");
    expect(commandOf({ ...plain, code: "Slash", key: "?" })).toBe("help");
    expect(holdOf({ ...plain, code: "ArrowUp", key: "ArrowUp" })).toBe("forward");
  });

  it("leave the browser's shortcuts alone", () => {
    expect(commandOf({ ...plain, ctrlKey: true, code: "KeyR", key: "r" })).toBeNull();
    expect(holdOf({ ...plain, metaKey: true, code: "KeyW", key: "w" })).toBeNull();
  });

  it("add up to a wish, with the stick", () => {
    expect(wishOf(new Set(["forward", "run"]), [0, 0])).toEqual({ forward: 1, right: 0, run: true });
    expect(wishOf(new Set(["forward", "back", "left"]), [0.25, 0])).toEqual({ forward: 0, right: -0.75, run: false });
    expect(wishOf(new Set(["forward"]), [0, 1]).forward).toBe(1);
    expect(turnOf(new Set(["turn-right", "look-up"]))).toEqual({ left: -1, up: 1 });
  });
});

describe("the store", () => {
  it("tells of real changes only", () => {
    const store = new Store(INITIAL_STATE);
    const listener = vi.fn();
    const end = store.subscribe(listener);
    store.update({ mode: "orbit" });
    expect(listener).not.toHaveBeenCalled();
    store.update({ mode: "walk" });
    expect(listener).toHaveBeenCalledOnce();
    end();
    store.update({ mode: "orbit" });
    expect(listener).toHaveBeenCalledOnce();
  });

  it("hides and shows layers without changing the old set", () => {
    const before = new Set<"window">();
    const after = withLayer(before, "window", false);
    expect([before.size, after.has("window"), withLayer(after, "window", true).size]).toEqual([0, true, 0]);
  });
});

describe("the pace", () => {
  const after = (frames: number, seconds: number, from = FULL_PACE): typeof FULL_PACE =>
    Array.from({ length: frames }).reduce<typeof FULL_PACE>((pace) => paced(pace, seconds), from);

  it("keeps every pixel at 60 frames per second", () => {
    expect(sharpnessOf(after(200, 1 / 60))).toBe(1);
  });

  it("gives pixels up on a slow machine and takes them back on a fast one", () => {
    const slow = after(100, 0.2);
    expect(sharpnessOf(slow)).toBe(0.4);
    expect(sharpnessOf(after(200, 1 / 60, slow))).toBe(1);
  });

  it("goes straight to the fewest pixels where there is no graphics card", () => {
    expect(sharpnessOf(after(3, 0.5))).toBe(0.4);
    expect(sharpnessOf(after(3, 0.07))).toBe(0.75);
  });

  it("does not waver in between", () => {
    const settled = after(100, 1 / 30, after(8, 0.2));
    expect(after(100, 1 / 30, settled).level).toBe(settled.level);
  });
});

describe("words", () => {
  it("say sizes and counts", () => {
    expect(sizeText(1.1, 1.846)).toBe("1.10 × 1.85 m");
    expect(sizeText(null, null)).toBe("not flat");
    expect(areaText(1.985)).toBe("1.99 m²");
    expect(areaText(171.4)).toBe("171 m²");
    expect(countText("balcony", 1)).toBe("1 balcony");
    expect(countText("balcony", 3)).toBe("3 balconies");
  });
});
