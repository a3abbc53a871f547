/** What the keys for houses change, and what is said of it. */
import { daylightAt, hourText, type SunPath, USUAL_PATH } from "./daylight.ts";
import type { Command } from "./input.ts";
import type { LightHabit, StudioState } from "./state.ts";

export type HouseCommand = Extract<Command, "daylight" | "lights" | "doors" | "map">;
type Change = Partial<Pick<StudioState, "hour" | "lights" | "doors" | "map">>;

const NEXT_LIGHTS: Readonly<Record<LightHabit, LightHabit>> = { auto: "on", on: "off", off: "auto" };
const LIGHTS_WORDS: Readonly<Record<LightHabit, string>> = {
  auto: "Lamps go on where you come in",
  on: "All lamps are on",
  off: "All lamps are off",
};

export function changeBy(command: HouseCommand, state: StudioState, path: SunPath = USUAL_PATH): { change: Change; words: string } {
  if (command === "daylight") {
    const isDay = (hour: number): boolean => daylightAt(hour, path).day > 0.5;
    // Under a midnight sun the night's hour is by day, and in a polar night the day's by night.
    const hour = state.hour === path.nightHour || (state.hour !== path.dayHour && !isDay(state.hour)) ? path.dayHour : path.nightHour;
    return { change: { hour }, words: `${hourText(hour)}, ${isDay(hour) ? "day" : "night"}` };
  }
  if (command === "lights") {
    const lights = NEXT_LIGHTS[state.lights];
    return { change: { lights }, words: LIGHTS_WORDS[lights] };
  }
  if (command === "doors") {
    const doors = state.doors === "open" ? "approach" : "open";
    return { change: { doors }, words: doors === "open" ? "All doors stand open" : "Doors open as you come" };
  }
  return { change: { map: !state.map }, words: "" };
}
