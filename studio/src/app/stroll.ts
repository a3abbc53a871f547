/** Being on a walk from view to view: its panel, and what keys and the wheel do there. */
import { html, nothing, type TemplateResult } from "lit";
import { type MorphState, NEXT_LOOK, walkedOn } from "../core/morph-walk.ts";
import type { StudioState } from "../core/state.ts";
import type { Store } from "../core/store.ts";
import type { Commands } from "./commands.ts";
import "./morph-panel.ts";
import { type Session, strollFrom } from "./session.ts";

/** How far a notch of the wheel goes is what it says in CSS pixels over this (m). */
const WHEEL_PX_M = 400;

type Shown = Store<StudioState>;

/** Changes the walk that one is on, or begins it. */
export function changeStroll(store: Shown, change: Partial<MorphState>): void {
  store.update({ shot: null, selected: null, morph: { ...(store.value.morph ?? strollFrom(0)), ...change } });
}

/** Onto the walk, or off it. */
export function toggleStroll({ place }: Session, store: Shown): void {
  if (store.value.morph !== null) store.update({ morph: null });
  else if (place.walks.length > 0) changeStroll(store, {});
}

/** Walks on by itself, or stands; after the end from the beginning. */
export function playStroll({ place }: Session, store: Shown): void {
  const { morph } = store.value;
  const walk = place.walks[morph?.which ?? 0];
  if (walk === undefined) return;
  const at = morph === null || morph.at >= walk.transitions.length ? 0 : morph.at;
  changeStroll(store, { at, playing: !(morph?.playing ?? false) });
}

export function nextLook(store: Shown): void {
  const { morph } = store.value;
  if (morph !== null) changeStroll(store, { look: NEXT_LOOK[morph.look] });
}

export function wheelOn(event: WheelEvent, session: Session | null, morph: MorphState | null, commands: Commands | null): void {
  const walk = session?.place.walks[morph?.which ?? 0];
  if (morph === null || walk === undefined) return;
  event.preventDefault();
  commands?.do("seek-walk", { at: walkedOn(walk, morph.at, -event.deltaY / WHEEL_PX_M), playing: false });
}

export function strollPanel({ place: { walks } }: Session, morph: MorphState | null, commands: Commands | null): TemplateResult | typeof nothing {
  if (walks.length === 0) return nothing;
  return html`<veduta-morph-panel class="sheet" role="group" aria-label="The walk" .walk=${walks[morph?.which ?? 0] ?? null} .at=${morph}
    @play-walk=${() => commands?.do("play-walk")}
    @seek-walk=${(event: CustomEvent<number>) => commands?.do("seek-walk", { at: event.detail, playing: false })}
    @headset-walk=${() => commands?.do("headset")}
    @look-walk=${() => commands?.do("morph-look")}
    @instant-walk=${() => commands?.do("seek-walk", { instant: !(morph?.instant ?? false) })}></veduta-morph-panel>`;
}
