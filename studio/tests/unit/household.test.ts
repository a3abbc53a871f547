import {
  AnimationClip,
  AnimationMixer,
  BoxGeometry,
  Group,
  Mesh,
  QuaternionKeyframeTrack,
} from "three";
import { describe, expect, it } from "vitest";
import { headingOf } from "../../src/core/heading.ts";
import { INITIAL_STATE, type StudioState } from "../../src/core/state.ts";
import type { Tour, TourState } from "../../src/core/tour.ts";
import { DEFAULT_WALK, standing, type Walker } from "../../src/core/walking.ts";
import { Doors } from "../../src/three/doors.ts";
import { Household } from "../../src/three/household.ts";
import type { LoadedPart } from "../../src/three/load.ts";
import { Mover } from "../../src/three/movers.ts";

/** Two leaves a hand's breadth apart, rows 0 and 1: whoever stands at one stands at the other. */
const IDS = ["house/hall", "house/robe"];
const TOUR: Tour = {
  id: "tour",
  name: "Tour",
  times_s: [0, 9],
  eyes: [[0, -1, 1.7], [0, -1, 1.7]],
  directions: [[0, 1, 0], [0, 1, 0]],
  stretches: [],
  shut: new Set(["house/robe"]),
};
const OTHER: Tour = { ...TOUR, id: "other", shut: new Set() };
const WALKER: Walker = standing([0, -1, 0], headingOf([0, 1, 0]), DEFAULT_WALK);

function leaf(row: number, group: Group): Mover {
  // Drawn frame: y up, z to the south.
  const geometry = new BoxGeometry(0.9, 2, 0.04).translate(0, 1, -0.1 * row);
  const mesh = new Mesh(geometry);
  mesh.name = `leaf${row}`;
  const clip = new AnimationClip("opens", 1, [
    new QuaternionKeyframeTrack(`${mesh.name}.quaternion`, [0, 1], [0, 0, 0, 1, 0, 1, 0, 0]),
  ]);
  group.add(mesh);
  const mixer = new AnimationMixer(group);
  const action = mixer.clipAction(clip);
  action.play().paused = true;
  const faces = Uint32Array.from(geometry.getIndex()?.array ?? []);
  return new Mover(mesh, [{ mesh, faces, rowOfFace: new Uint32Array(faces.length / 3).fill(row) }], mixer, action);
}

/** How far each door is open after `seconds` of what `change` says. */
function home(): (change: Partial<StudioState>, seconds?: number) => Record<string, number> {
  const group = new Group();
  const movers = IDS.map((_, row) => leaf(row, group));
  const part = { movers, table: { rows: IDS.map((id) => ({ id })) } };
  const doors = new Doors();
  doors.take([part as unknown as LoadedPart], 0);
  const household = new Household([], () => doors, [TOUR, OTHER]);
  return (change, seconds = 2) => {
    const state: StudioState = { ...INITIAL_STATE, mode: "walk", ...change };
    household.advance(state, WALKER, [0, -1, 1.7], seconds);
    return Object.fromEntries(doors.states.map(({ feature, share }): [string, number] => [IDS[feature.row] ?? "", share]));
  };
}

const on = (which: number, playing = true): { tour: TourState } => ({ tour: { which, time_s: 1, playing } });

describe("a door that a tour keeps closed", () => {
  it("opens for who walks by himself, and for who has paused the tour", () => {
    expect(home()({})).toEqual({ "house/hall": 1, "house/robe": 1 });
    expect(home()(on(0, false))).toEqual({ "house/hall": 1, "house/robe": 1 });
  });

  it("stays closed while the tour plays, where all doors stand open too", () => {
    expect(home()(on(0))).toEqual({ "house/hall": 1, "house/robe": 0 });
    expect(home()({ ...on(0), doors: "open" })).toEqual({ "house/hall": 1, "house/robe": 0 });
  });

  it("closes when the tour begins, as slowly as others, and is let open afterwards", () => {
    const after = home();
    after({ doors: "open" });
    const halfway = after({ ...on(0), doors: "open" }, 0.4);
    expect(halfway["house/robe"]).toBeCloseTo(0.5, 9);
    expect(after({ ...on(0), doors: "open" })).toEqual({ "house/hall": 1, "house/robe": 0 });
    expect(after({ doors: "open" })["house/robe"]).toBe(1);
  });

  it("opens on another tour", () => {
    expect(home()(on(1))).toEqual({ "house/hall": 1, "house/robe": 1 });
  });
});
