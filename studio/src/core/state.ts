/** What the person has chosen to see. */
import { type AnimalState, STANDING } from "./animal.ts";
import type { SemanticClass } from "./classes.ts";
import { DAY_HOUR } from "./daylight.ts";
import type { MorphState } from "./morph-walk.ts";
import type { TourState } from "./tour.ts";

export type Mode = "orbit" | "walk";
/** What of a place is shown beside its classes: the records that it was made from, and the parts. */
export type Layer = "points" | "distances" | "cameras" | "walls" | "model" | "backdrop" | "raw";
/** Doors open for whoever comes and close behind him, or all stand open. */
export type DoorHabit = "approach" | "open";
/** Lamps go on in the room that one comes into, or all are on, or off. */
export type LightHabit = "auto" | "on" | "off";
export type Colouring = "photo" | "class" | "provenance";

/** In the order in which a key goes through them. */
export const NEXT_COLOURING: Readonly<Record<Colouring, Colouring>> = {
  photo: "class",
  class: "provenance",
  provenance: "photo",
};

/** A feature of the place: which part, and which row of the part's table. */
export interface FeatureRef {
  readonly part: number;
  readonly row: number;
}

export interface StudioState {
  readonly mode: Mode;
  readonly colouring: Colouring;
  readonly hidden: ReadonlySet<SemanticClass>;
  readonly selected: FeatureRef | null;
  /** The photo that is looked through, by its number in the place. */
  readonly shot: number | null;
  /** The photo that lies on the surfaces, and how much of them it covers (0..1). */
  readonly projected: number | null;
  readonly cover: number;
  /** Whether photos fade in as one walks past. */
  readonly fading: boolean;
  readonly off: ReadonlySet<Layer>;
  /** Up to this share of the picture's width, from the left, what was recorded is shown while it is on. */
  readonly wipe: number;
  /** Size of a point, CSS pixels. */
  readonly point_px: number;
  readonly mouseLook: boolean;
  readonly doors: DoorHabit;
  readonly lights: LightHabit;
  /** Time of the day by the sun, 0 to 24. */
  readonly hour: number;
  readonly map: boolean;
  /** Null before the tour was begun. */
  readonly tour: TourState | null;
  readonly animal: AnimalState;
  /** Null where one is not on a walk from view to view. */
  readonly morph: MorphState | null;
}

export const INITIAL_STATE: StudioState = {
  mode: "orbit",
  colouring: "photo",
  hidden: new Set(),
  selected: null,
  shot: null,
  projected: null,
  cover: 1,
  fading: true,
  off: new Set(),
  wipe: 0.5,
  point_px: 2.5,
  mouseLook: false,
  doors: "approach",
  lights: "auto",
  hour: DAY_HOUR,
  map: true,
  tour: null,
  animal: STANDING,
  morph: null,
};

/** Looking through a photo; one that lies on the surfaces gives way to it. */
export function throughPhoto(state: StudioState, shot: number | null): Partial<StudioState> {
  const projected = state.projected === null || shot === null ? state.projected : shot;
  return { shot, projected, selected: null };
}

export function withLayer<Kind extends SemanticClass | Layer>(
  hidden: ReadonlySet<Kind>,
  kind: Kind,
  visible: boolean,
): ReadonlySet<Kind> {
  const next = new Set(hidden);
  if (visible) next.delete(kind);
  else next.add(kind);
  return next;
}
