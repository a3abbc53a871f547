import { describe, expect, it } from "vitest";
import { COMMAND_BINDINGS, commandOf } from "../../src/core/input.ts";
import { entriesOf, matching } from "../../src/core/palette.ts";

const NOTHING = { houses: false, photos: false, tours: false, walks: false, missing: false };
const ALL = { houses: true, photos: true, tours: true, walks: true, missing: true };
const names = (typed: string, has = ALL): string[] => matching(entriesOf(has), typed).map(({ name }) => name);
const press = (code: string, held: Partial<Record<"ctrlKey" | "metaKey" | "altKey", boolean>> = {}) => ({
  code, key: "k", ctrlKey: false, metaKey: false, altKey: false, ...held,
});

describe("the commands by their names", () => {
  it("are all that have a key, and some that have none", () => {
    const known = new Set(names(""));
    for (const { action } of COMMAND_BINDINGS) if (action !== "palette") expect(known).toContain(action);
    expect(known).toContain("headset");
    expect(known).toContain("ask-now");
  });

  it("leave out what the place has nothing for", () => {
    const known = names("", NOTHING);
    expect(known).toContain("orbit");
    for (const name of ["next-photo", "lights", "tour", "stroll", "headset", "ask-now"]) expect(known).not.toContain(name);
    expect(names("", { ...NOTHING, photos: true })).toContain("next-photo");
  });

  it("are found by the beginnings of their words, in any order, and by their key", () => {
    expect(names("pict sav")).toEqual(["screenshot"]);
    expect(names("FULL")).toEqual(["fullscreen"]);
    expect(names("x")).toEqual(["daylight"]);
    expect(names("?")).toEqual(["help"]);
    expect(names("nothing of that kind")).toEqual([]);
  });

  it("are asked for by K with Ctrl or Meta, while K alone is the map", () => {
    expect(commandOf(press("KeyK", { ctrlKey: true }))).toBe("palette");
    expect(commandOf(press("KeyK", { metaKey: true }))).toBe("palette");
    expect(commandOf(press("KeyK", { ctrlKey: true, altKey: true }))).toBeNull();
    expect(commandOf(press("KeyK"))).toBe("map");
    expect(commandOf(press("KeyL", { ctrlKey: true }))).toBeNull();
  });
});
