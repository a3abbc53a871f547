/**
 * A view of a place as text, for the address after `#`: `mode=walk&eye=1.2,3,1.7&to=...`. It may come
 * from anywhere: what is not understood is left out, and the rest is shown.
 */
import { STANDING } from "./animal.ts";
import { isSemanticClass } from "./classes.ts";
import type { MorphState } from "./morph-walk.ts";
import type { StudioState } from "./state.ts";
import { NOT_BEGUN } from "./tour.ts";
import type { Vec3 } from "./vector.ts";

/** Where one stands and looks to; world frame. */
export interface Look {
  readonly eye: Vec3;
  readonly target: Vec3;
}

/** What of the state is part of a view. */
export type ViewState = Partial<
  Pick<StudioState, "mode" | "colouring" | "hidden" | "off" | "wipe" | "shot" | "projected" | "cover" | "hour" | "tour" | "doors" | "lights" | "morph" | "animal">
>;

export interface View {
  readonly look: Look | null;
  readonly state: ViewState;
  /** The surface that is chosen: its part or building, a slash, and its id; or the id alone. */
  readonly picked: string | null;
}

const LAYERS = ["points", "distances", "cameras", "walls", "model", "backdrop", "raw"] as const;
const LOOKS = ["picture", "geometry", "psi"] as const;
const COLOURINGS = ["photo", "class", "provenance"] as const;
/** Nobody writes a longer one. */
const MOST_LETTERS = 4000;
const FARTHEST_M = 1e7;

export function writeView(state: StudioState, look: Look | null, picked: string | null): string {
  const fields = new URLSearchParams();
  fields.set("mode", state.mode);
  if (look !== null && state.shot === null) {
    fields.set("eye", written(look.eye));
    fields.set("to", written(look.target));
  }
  if (state.colouring !== "photo") fields.set("colours", state.colouring);
  if (state.hidden.size > 0) fields.set("hide", [...state.hidden].toSorted().join(","));
  // Said even where it is nothing: a place may begin with layers that are off.
  fields.set("off", [...state.off].toSorted().join(","));
  if (!state.off.has("raw") && state.wipe !== 0.5) fields.set("wipe", round(state.wipe, 2));
  fields.set("hour", round(state.hour, 2));
  if (state.doors !== "approach") fields.set("doors", state.doors);
  if (state.lights !== "auto") fields.set("lights", state.lights);
  if (state.shot !== null) fields.set("photo", String(state.shot));
  if (state.projected !== null) fields.set("thrown", `${state.projected},${round(state.cover, 2)}`);
  if (state.tour !== null) fields.set("tour", `${state.tour.which},${round(state.tour.time_s, 1)}`);
  if (state.morph !== null) {
    const { which, at, look: shown, instant } = state.morph;
    fields.set("walk", [which, round(at, 3), shown, ...(instant ? ["instant"] : [])].join(","));
  }
  const { which, clip, following } = state.animal;
  if (which !== 0 || clip !== 0 || following) fields.set("animal", [which, clip, ...(following ? ["follow"] : [])].join(","));
  if (picked !== null) fields.set("pick", picked);
  return fields.toString().replaceAll("%2C", ",").replaceAll("%2F", "/");
}

/** How many of each the place has. */
export interface Counts {
  readonly photos: number;
  readonly tours: number;
  /** The transitions of each walk. */
  readonly walks: readonly number[];
  /** The clips of each animal. */
  readonly animals: readonly number[];
}

/** Null where the text says nothing of a view. */
export function readView(text: string, { photos, tours, walks, animals }: Counts): View | null {
  if (text.length > MOST_LETTERS) return null;
  const fields = new URLSearchParams(text.replace(/^#/, ""));
  const mode = oneOf(fields.get("mode"), ["orbit", "walk"] as const);
  if (mode === null) return null;
  const [eye, target] = [point(fields.get("eye")), point(fields.get("to"))];
  const hour = number(fields.get("hour"), 0, 24);
  const wipe = number(fields.get("wipe"), 0, 1);
  const shot = index(fields.get("photo"), photos);
  const off = fields.get("off");
  return {
    look: eye === null || target === null || eye.every((at, axis) => at === target[axis]) ? null : { eye, target },
    picked: fields.get("pick"),
    state: {
      mode,
      colouring: oneOf(fields.get("colours"), COLOURINGS) ?? "photo",
      hidden: new Set((fields.get("hide") ?? "").split(",").filter(isSemanticClass)),
      ...(off === null ? {} : { off: new Set(LAYERS.filter((layer) => off.split(",").includes(layer))) }),
      ...(wipe === null ? {} : { wipe }),
      ...(hour === null ? {} : { hour }),
      doors: oneOf(fields.get("doors"), ["approach", "open"] as const) ?? "approach",
      lights: oneOf(fields.get("lights"), ["auto", "on", "off"] as const) ?? "auto",
      shot,
      ...thrown(fields.get("thrown"), photos),
      ...momentOf(fields.get("tour"), tours),
      morph: strollOf(fields.get("walk"), walks),
      ...animalOf(fields.get("animal"), animals),
    },
  };
}

function thrown(text: string | null, photos: number): Pick<ViewState, "projected" | "cover"> {
  const [which = "", cover = ""] = (text ?? "").split(",");
  const projected = index(which, photos);
  return projected === null ? { projected } : { projected, cover: number(cover, 0, 1) ?? 1 };
}

function momentOf(text: string | null, tours: number): Pick<ViewState, "tour"> {
  const [which = "", time = ""] = (text ?? "").split(",");
  const at = index(which, tours);
  return at === null ? {} : { tour: { ...NOT_BEGUN, which: at, time_s: number(time, 0, 1e6) ?? 0 } };
}

function strollOf(text: string | null, walks: readonly number[]): MorphState | null {
  const [which = "", at = "", look = "", instant = ""] = (text ?? "").split(",");
  const walk = index(which, walks.length);
  if (walk === null) return null;
  return {
    which: walk,
    at: number(at, 0, walks[walk] ?? 0) ?? 0,
    playing: false,
    look: oneOf(look, LOOKS) ?? "picture",
    instant: instant === "instant",
  };
}

function animalOf(text: string | null, animals: readonly number[]): Pick<ViewState, "animal"> {
  const [which = "", clip = "", follow = ""] = (text ?? "").split(",");
  const animal = index(which, animals.length);
  if (animal === null) return {};
  return { animal: { ...STANDING, which: animal, clip: index(clip, animals[animal] ?? 0) ?? 0, following: follow === "follow" } };
}

function oneOf<T extends string>(text: string | null, known: readonly T[]): T | null {
  return known.find((one) => one === text) ?? null;
}

function number(text: string | null, least: number, most: number): number | null {
  if (text === null || text.trim() === "") return null;
  const value = Number(text);
  return Number.isFinite(value) && value >= least && value <= most ? value : null;
}

function index(text: string | null, count: number): number | null {
  const value = number(text, 0, count - 1);
  return value !== null && Number.isInteger(value) ? value : null;
}

function point(text: string | null): Vec3 | null {
  const values = (text ?? "").split(",").map((one) => number(one, -FARTHEST_M, FARTHEST_M));
  const [x = null, y = null, z = null] = values;
  return values.length === 3 && x !== null && y !== null && z !== null ? [x, y, z] : null;
}

function written(at: Vec3): string {
  return at.map((value) => round(value, 3)).join(",");
}

function round(value: number, digits: number): string {
  return String(Number(value.toFixed(digits)));
}
