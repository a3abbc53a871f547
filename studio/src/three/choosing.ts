/** What a click on the place chooses: a photo, a surface, or where an animal is to go. */
import { type StudioState, throughPhoto } from "../core/state.ts";
import type { Store } from "../core/store.ts";
import type { Animals } from "./animals.ts";
import type { Picker } from "./picker.ts";

/** `x` and `y` in CSS pixels of the canvas. */
export function chooseAt(x: number, y: number, picker: Picker, animals: Animals, store: Store<StudioState>): void {
  if (store.value.morph !== null) return;
  const { which, leading } = store.value.animal;
  const led = leading ? animals.placeOf(which) : null;
  if (led !== null) {
    const goal = picker.groundAt(x, y, led[2]);
    if (goal !== null) animals.lead(which, goal);
    return;
  }
  const shot = picker.shotAt(x, y);
  if (shot !== null) store.update(throughPhoto(store.value, shot));
  else store.update({ selected: picker.hitAt(x, y)?.feature ?? null });
}
