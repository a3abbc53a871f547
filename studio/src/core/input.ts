/** Which key does what. One table: the page obeys it and the help shows it. */
import type { WalkWish } from "./walking.ts";

export type Command =
  | "orbit"
  | "walk"
  | "reset"
  | "layers"
  | "colouring"
  | "screenshot"
  | "fullscreen"
  | "mouse-look"
  | "next-photo"
  | "previous-photo"
  | "project"
  | "fading"
  | "daylight"
  | "lights"
  | "doors"
  | "map"
  | "tour"
  | "stroll"
  | "morph-look"
  | "help"
  | "palette"
  | "close";

/** Keys that act while they are held. */
export type Hold =
  | "forward"
  | "back"
  | "left"
  | "right"
  | "turn-left"
  | "turn-right"
  | "look-up"
  | "look-down"
  | "run";

export interface Binding<Action> {
  /** `KeyboardEvent.code`: the place on the keyboard, the same for every layout. */
  readonly codes: readonly string[];
  readonly action: Action;
  readonly shown: string;
  readonly text: string;
}

export const COMMAND_BINDINGS: readonly Binding<Command>[] = [
  { codes: ["Digit1"], action: "orbit", shown: "1", text: "Look at the place from outside" },
  { codes: ["Digit2"], action: "walk", shown: "2", text: "Walk in it" },
  { codes: ["KeyR", "Home"], action: "reset", shown: "R", text: "Reset the view" },
  { codes: ["KeyL"], action: "layers", shown: "L", text: "Show or hide the layers" },
  { codes: ["KeyP"], action: "colouring", shown: "P", text: "Change the colours: photo, class, provenance" },
  { codes: ["KeyC"], action: "screenshot", shown: "C", text: "Save a picture" },
  { codes: ["KeyF"], action: "fullscreen", shown: "F", text: "Full screen" },
  { codes: ["KeyM"], action: "mouse-look", shown: "M", text: "Look around with the mouse while walking" },
  { codes: ["KeyN"], action: "next-photo", shown: "N", text: "Look through the next photo" },
  { codes: ["KeyB"], action: "previous-photo", shown: "B", text: "Look through the photo before" },
  { codes: ["KeyT"], action: "project", shown: "T", text: "Throw the photo onto the place, take it off" },
  { codes: ["KeyV"], action: "fading", shown: "V", text: "Photos fade in as one walks past, or do not" },
  { codes: ["KeyX"], action: "daylight", shown: "X", text: "In a house: day or night" },
  { codes: ["KeyI"], action: "lights", shown: "I", text: "In a house: lamps go on where you come in, all on, all off" },
  { codes: ["KeyO"], action: "doors", shown: "O", text: "In a house: doors open as you come, or all stand open" },
  { codes: ["KeyK"], action: "map", shown: "K", text: "In a house: the map, while walking" },
  { codes: ["KeyG"], action: "tour", shown: "G", text: "Play or pause the guided tour" },
  { codes: ["Digit3"], action: "stroll", shown: "3", text: "On a walk from view to view: go on it, or leave it" },
  { codes: ["KeyJ"], action: "morph-look", shown: "J", text: "On a walk from view to view: picture, geometry, counterparts" },
  { codes: ["KeyH", "F1"], action: "help", shown: "?", text: "This help" },
  { codes: [], action: "palette", shown: "Ctrl K", text: "All commands, by their names" },
  { codes: ["Escape"], action: "close", shown: "Esc", text: "Close what is open, let go of the surface" },
];

export const HOLD_BINDINGS: readonly Binding<Hold>[] = [
  { codes: ["KeyW", "ArrowUp"], action: "forward", shown: "W ↑", text: "Forward" },
  { codes: ["KeyS", "ArrowDown"], action: "back", shown: "S ↓", text: "Back" },
  { codes: ["KeyA"], action: "left", shown: "A", text: "Step to the left" },
  { codes: ["KeyD"], action: "right", shown: "D", text: "Step to the right" },
  { codes: ["KeyQ", "ArrowLeft"], action: "turn-left", shown: "Q ←", text: "Turn left" },
  { codes: ["KeyE", "ArrowRight"], action: "turn-right", shown: "E →", text: "Turn right" },
  { codes: ["PageUp"], action: "look-up", shown: "Page ↑", text: "Look up" },
  { codes: ["PageDown"], action: "look-down", shown: "Page ↓", text: "Look down" },
  { codes: ["ShiftLeft", "ShiftRight"], action: "run", shown: "Shift", text: "Run" },
];

interface KeyPress {
  readonly code: string;
  readonly key: string;
  readonly ctrlKey: boolean;
  readonly altKey: boolean;
  readonly metaKey: boolean;
}

/** The command of a key press; keys with Ctrl, Alt or Meta belong to the browser, but for the one of the commands. */
export function commandOf(press: KeyPress): Command | null {
  if (press.code === "KeyK" && (press.ctrlKey || press.metaKey) && !press.altKey) return "palette";
  if (press.ctrlKey || press.altKey || press.metaKey) return null;
  if (press.key === "?") return "help";
  return actionOf(COMMAND_BINDINGS, press.code);
}

export function holdOf(press: KeyPress): Hold | null {
  if (press.ctrlKey || press.altKey || press.metaKey) return null;
  return actionOf(HOLD_BINDINGS, press.code);
}

/** A key that is let go is held no longer, whatever else is pressed. */
export function letGo(code: string): Hold | null {
  return actionOf(HOLD_BINDINGS, code);
}

function actionOf<A>(bindings: readonly Binding<A>[], code: string): A | null {
  return bindings.find((binding) => binding.codes.includes(code))?.action ?? null;
}

/** What the held keys and the stick (x right, y forward, -1..1) ask the walker to do. */
export function wishOf(held: ReadonlySet<Hold>, stick: readonly [number, number]): WalkWish {
  const axis = (plus: Hold, minus: Hold): number =>
    Number(held.has(plus)) - Number(held.has(minus));
  return {
    forward: clamp(axis("forward", "back") + stick[1]),
    right: clamp(axis("right", "left") + stick[0]),
    run: held.has("run"),
  };
}

/** Turning by keys: left and up in -1..1. */
export function turnOf(held: ReadonlySet<Hold>): { left: number; up: number } {
  return {
    left: Number(held.has("turn-left")) - Number(held.has("turn-right")),
    up: Number(held.has("look-up")) - Number(held.has("look-down")),
  };
}

function clamp(value: number): number {
  return Math.min(1, Math.max(-1, value));
}
