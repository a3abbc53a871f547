import { describe, expect, it } from "vitest";
import { INITIAL_STATE, type StudioState } from "../../src/core/state.ts";
import { readView, writeView } from "../../src/core/view-link.ts";

const PLACE = { photos: 3, tours: 1 };
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
      tour: { which: 0, time_s: 12.5, playing: false },
    });
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
      doors: "approach", lights: "auto", shot: null, projected: null,
    });
  });

  it("looks nowhere from where it looks to", () => {
    expect(readView("mode=walk&eye=1,2,3&to=1,2,3", PLACE)?.look).toBeNull();
    expect(readView("mode=walk&eye=1,2,1e9&to=1,2,3", PLACE)?.look).toBeNull();
  });
});
