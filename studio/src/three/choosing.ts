/** What a click on the place means: a photo, a surface, or where an animal is to go. */
import type { FeatureRef, StudioState } from "../core/state.ts";
import type { Vec3 } from "../core/vector.ts";
import type { Animals } from "./animals.ts";
import type { Picker } from "./picker.ts";

/** `feature` is null where the click met nothing. */
export type Choice =
  | { readonly kind: "photo"; readonly shot: number }
  | { readonly kind: "surface"; readonly feature: FeatureRef | null }
  | { readonly kind: "goal"; readonly which: number; readonly goal: Vec3 };

/** `x` and `y` in CSS pixels of the canvas; null where a click means nothing. */
export function choiceAt(x: number, y: number, picker: Picker, animals: Animals, state: StudioState): Choice | null {
  if (state.morph !== null) return null;
  const { which, leading } = state.animal;
  const led = leading ? animals.placeOf(which) : null;
  if (led !== null) {
    const goal = picker.groundAt(x, y, led[2]);
    return goal === null ? null : { kind: "goal", which, goal };
  }
  const shot = picker.shotAt(x, y);
  return shot === null ? { kind: "surface", feature: picker.hitAt(x, y)?.feature ?? null } : { kind: "photo", shot };
}
