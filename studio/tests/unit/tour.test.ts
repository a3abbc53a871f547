import { describe, expect, it } from "vitest";
import { Fault } from "../../src/core/fault.ts";
import { INITIAL_STATE, type StudioState } from "../../src/core/state.ts";
import { Store } from "../../src/core/store.ts";
import { durationOf, readTour, stretchAt, type Tour, viewAt } from "../../src/core/tour.ts";
import { length } from "../../src/core/vector.ts";
import { TourGuide } from "../../src/three/tour-guide.ts";

const RECORD = {
  id: "tour",
  name: "Tour",
  times_s: [0, 2, 4, 5],
  eyes: [[0, 0, 1.7], [2, 0, 1.7], [2, 0, 1.7], [2, 3, 2.7]],
  directions: [[1, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0.8, 0.6]],
  stretches: [
    { room: null, name: "Outside", start_s: 0, end_s: 2 },
    { room: "r1", name: "Hall", start_s: 2, end_s: 5 },
  ],
};

const OTHER: Tour = {
  id: "other",
  name: "Other",
  times_s: [0, 4],
  eyes: [[0, 5, 1.7], [0, 9, 1.7]],
  directions: [[0, 1, 0], [0, 1, 0]],
  stretches: [],
  shut: new Set(),
};

function tour(change: Record<string, unknown> = {}): Tour {
  return readTour({ ...RECORD, ...change }, "tour 1", (fault) => new Fault("place.json", fault, ""));
}

describe("reading a tour", () => {
  it("gives its columns and rooms", () => {
    expect(tour().eyes[3]).toEqual([2, 3, 2.7]);
    expect(tour().stretches[1]).toEqual({ room: "r1", name: "Hall", start_s: 2, end_s: 5 });
    expect(durationOf(tour())).toBe(5);
    expect(tour({ stretches: undefined }).stretches).toEqual([]);
    expect([...tour().shut]).toEqual([]);
    expect([...tour({ shut: ["house/robe"] }).shut]).toEqual(["house/robe"]);
  });

  it.each([
    ["times_s", [0, 2, 2, 5]],
    ["times_s", [1, 2, 3, 4]],
    ["times_s", [0]],
    ["times_s", "0"],
    ["eyes", [[0, 0, 1]]],
    ["eyes", [[0, 0, 1], [0, 0], [0, 0, 1], [0, 0, 1]]],
    ["directions", [[1, 0, 0], [2, 0, 0], [0, 1, 0], [0, 1, 0]]],
    ["stretches", [{ name: "Hall", start_s: 0 }]],
    ["shut", "house/robe"],
    ["shut", [3]],
    ["id", 3],
  ])("refuses a tour with a bad %s", (field, value) => {
    expect(() => tour({ [field]: value })).toThrow(`tour 1 has no proper "${field}"`);
  });
});

describe("the view at a time", () => {
  it("goes straight from key to key", () => {
    expect(viewAt(tour(), 0.5).eye).toEqual([0.5, 0, 1.7]);
    expect(viewAt(tour(), 2).eye).toEqual([2, 0, 1.7]);
    expect(viewAt(tour(), 4.5).eye[2]).toBeCloseTo(2.2, 12);
  });

  it("turns evenly on the great circle", () => {
    for (const [time, degrees] of [[2.5, 22.5], [3, 45], [3.5, 67.5]] as const) {
      const { direction } = viewAt(tour(), time);
      expect((Math.atan2(direction[1], direction[0]) * 180) / Math.PI).toBeCloseTo(degrees, 9);
      expect(length(direction)).toBeCloseTo(1, 12);
    }
  });

  it("stays at its ends before and after it", () => {
    expect(viewAt(tour(), -1)).toEqual(viewAt(tour(), 0));
    expect(viewAt(tour(), 9)).toEqual({ eye: [2, 3, 2.7], direction: [0, 0.8, 0.6] });
  });

  it("knows the room", () => {
    expect(stretchAt(tour(), 1.9)?.name).toBe("Outside");
    expect(stretchAt(tour(), 2)?.name).toBe("Hall");
    expect(stretchAt(tour(), 5)?.name).toBe("Hall");
    expect(stretchAt(tour({ stretches: [] }), 1)).toBeNull();
  });
});

describe("the guide", () => {
  function guided(): { guide: TourGuide; store: Store<StudioState> } {
    const store = new Store<StudioState>(INITIAL_STATE);
    return { guide: new TourGuide([tour(), OTHER], store), store };
  }

  it("goes on while it plays and tells the page now and then", () => {
    const { guide, store } = guided();
    store.update({ tour: { which: 0, time_s: 0, playing: true } });
    expect(guide.wished(store.value.tour)?.eye).toEqual([0, 0, 1.7]);
    expect(guide.advance(0.1).eye[0]).toBeCloseTo(0.1, 12);
    expect(store.value.tour?.time_s).toBe(0);
    guide.advance(0.2);
    expect(store.value.tour?.time_s).toBeCloseTo(0.3, 12);
    expect(guide.wished(store.value.tour)).toBeNull();
  });

  it("ends at its end", () => {
    const { guide, store } = guided();
    store.update({ tour: { which: 0, time_s: 4.8, playing: true } });
    guide.wished(store.value.tour);
    guide.advance(0.4);
    expect(store.value.tour).toEqual({ which: 0, time_s: 5, playing: false });
  });

  it("waits where the visitor left it, to the moment", () => {
    const { guide, store } = guided();
    store.update({ tour: { which: 0, time_s: 0, playing: true } });
    guide.wished(store.value.tour);
    guide.advance(0.3);
    guide.advance(0.1);
    guide.stop();
    expect(store.value.tour?.playing).toBe(false);
    expect(store.value.tour?.time_s).toBeCloseTo(0.4, 12);
    store.update({ tour: { which: 0, time_s: store.value.tour?.time_s ?? 0, playing: true } });
    expect(guide.wished(store.value.tour)?.eye[0]).toBeCloseTo(0.4, 12);
  });

  it("goes over to another tour, and goes on in that", () => {
    const { guide, store } = guided();
    store.update({ tour: { which: 0, time_s: 0, playing: true } });
    guide.wished(store.value.tour);
    guide.advance(0.3);
    store.update({ tour: { which: 1, time_s: store.value.tour?.time_s ?? 0, playing: true } });
    expect(guide.wished(store.value.tour)?.eye[1]).toBeCloseTo(5.3, 12);
    guide.advance(0.3);
    expect(store.value.tour?.which).toBe(1);
    expect(guide.wished(store.value.tour)).toBeNull();
  });

  it("follows the slider", () => {
    const { guide, store } = guided();
    store.update({ tour: { which: 0, time_s: 3, playing: false } });
    expect(guide.wished(store.value.tour)?.direction[0]).toBeCloseTo(Math.SQRT1_2, 9);
    expect(guide.isPlaying).toBe(false);
  });
});
