import { describe, expect, it } from "vitest";
import { INITIAL_STATE, type StudioState } from "../../src/core/state.ts";
import { readView, writeView } from "../../src/core/view-link.ts";

const PLACE = { photos: 3, tours: 1, walks: [4, 2], animals: [1, 3] };
const LOOK = { eye: [1.25, -20, 1.7], target: [1.25, 0, 3.5] } as const;

describe("a view in the address", () => {
  it("comes back as it was written", () => {
    const state: StudioState = {
      ...INITIAL_STATE,
      mode: "walk",
      colouring: "class",
      hidden: new Set(["window", "door"]),
      off: new Set(["walls"]),
      projected: 2,
      cover: 0.4,
      hour: 17.25,
      lights: "on",
      tour: { which: 0, time_s: 12.5, playing: true },
    };
    const view = readView(`#${writeView(state, LOOK, "house-1/window-2")}`, PLACE);
    expect(view?.look).toEqual(LOOK);
    expect(view?.picked).toBe("house-1/window-2");
    const { mode, colouring, hidden, off, projected, cover, hour, lights, doors } = state;
    expect(view?.state).toEqual({
      mode, colouring, hidden, off, projected, cover, hour, lights, doors, shot: null,
      tour: { which: 0, time_s: 12.5, playing: false }, morph: null,
    });
  });

  it("keeps the place on a walk and the animal that one follows, standing", () => {
    const morph = { which: 1, at: 1.25, playing: true, look: "psi", instant: true } as const;
    const animal = { which: 1, clip: 2, playing: true, following: true, leading: true };
    const text = writeView({ ...INITIAL_STATE, morph, animal }, LOOK, null);
    expect(text).toContain("walk=1,1.25,psi,instant");
    const state = readView(text, PLACE)?.state;
    expect(state?.morph).toEqual({ ...morph, playing: false });
    expect(state?.animal).toEqual({ ...animal, leading: false });
  });

  it.each([["2,1"], ["-1,0"], ["x"]])("is on no walk that the place does not have: %s", (walk) => {
    expect(readView(`mode=walk&walk=${walk}`, PLACE)?.state.morph).toBeNull();
  });

  it("is at the beginning of a walk where the moment is none of it", () => {
    expect(readView("mode=walk&walk=1,2.5,fog", PLACE)?.state.morph).toMatchObject({ which: 1, at: 0, look: "picture", instant: false });
    expect(readView("mode=walk&animal=0,9", PLACE)?.state.animal).toMatchObject({ which: 0, clip: 0 });
  });

  it("names what a person can read", () => {
    expect(writeView(INITIAL_STATE, LOOK, null)).toMatch(/^mode=orbit&eye=1\.25,-20,1\.7&to=1\.25,0,3\.5&off=&hour=/);
  });

  it("has the photo's own camera while one looks through it", () => {
    const text = writeView({ ...INITIAL_STATE, shot: 1 }, LOOK, null);
    expect(text).not.toContain("eye=");
    expect(readView(text, PLACE)?.state.shot).toBe(1);
  });

  it.each(["", "#", "#top", "mode=fly", `mode=walk&${"a".repeat(5000)}`])("is none in %s", (text) => {
    expect(readView(text, PLACE)).toBeNull();
  });

  it("leaves out what it does not understand, and shows the rest", () => {
    const text = "mode=walk&eye=1,2&to=a,b,c&hide=window,unicorn&off=walls,x&hour=25&photo=3&thrown=-1,7&tour=4,2&x=y";
    const view = readView(text, PLACE);
    expect(view?.look).toBeNull();
    expect(view?.state).toEqual({
      mode: "walk", colouring: "photo", hidden: new Set(["window"]), off: new Set(["walls"]),
      doors: "approach", lights: "auto", shot: null, projected: null, morph: null,
    });
  });

  it("looks nowhere from where it looks to", () => {
    expect(readView("mode=walk&eye=1,2,3&to=1,2,3", PLACE)?.look).toBeNull();
    expect(readView("mode=walk&eye=1,2,1e9&to=1,2,3", PLACE)?.look).toBeNull();
  });
});
