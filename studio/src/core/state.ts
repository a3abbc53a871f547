/** What the person has chosen to see. */
import type { SemanticClass } from "./classes.ts";

export type Mode = "orbit" | "walk";
export type Colouring = "photo" | "class" | "provenance";

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
  readonly mouseLook: boolean;
}

export const INITIAL_STATE: StudioState = {
  mode: "orbit",
  colouring: "photo",
  hidden: new Set(),
  selected: null,
  shot: null,
  mouseLook: false,
};

export function withLayer(
  hidden: ReadonlySet<SemanticClass>,
  kind: SemanticClass,
  visible: boolean,
): ReadonlySet<SemanticClass> {
  const next = new Set(hidden);
  if (visible) next.delete(kind);
  else next.add(kind);
  return next;
}
