/** The sun through a day, and how light it is. World frame, y north. */
import type { Place } from "./place.ts";
import { sunVector } from "./sun.ts";
import { dot, length, scale, type Vec3 } from "./vector.ts";

/** To the sun on a spring afternoon, from the street's side (facades look south): the usual light. */
const AFTERNOON: Vec3 = [-0.72, -0.62, 0.66];
/** The latitude at which the sun comes by there at the equinox, within two degrees. */
const LATITUDE_RAD = Math.PI / 4;
const POLE: Vec3 = [0, Math.cos(LATITUDE_RAD), Math.sin(LATITUDE_RAD)];

/** When the sun is where the usual light comes from; solar time. */
export const DAY_HOUR = hourOf(AFTERNOON);
export const NIGHT_HOUR = 22;

/** The sun through one day of a place. */
export interface SunPath {
  /** Unit vector to the sun; hours from 0 to 24 by the clock of `zone`. */
  readonly sunAt: (hour: number) => Vec3;
  /** When the place is looked at first, and one hour each of day and night. */
  readonly firstHour: number;
  readonly dayHour: number;
  readonly nightHour: number;
  /** What is known of it, in words. */
  readonly words: string;
}

/** The sun or the moon. */
export interface Shine {
  /** Unit vector. */
  readonly to: Vec3;
  readonly isMoon: boolean;
  /** From 0 (as good as none) to 1. */
  readonly share: number;
}

export interface Daylight {
  /** What throws light and shadows: the moon where the sun is down, and neither on the horizon. */
  readonly light: Shine;
  /** Around what the sky glows: the sun's glow outlasts it. */
  readonly glow: Shine;
  /** From 0 (night) to 1 (day). */
  readonly day: number;
  /** How red the light is: 1 where the sun stands on the horizon. */
  readonly dusk: number;
}

/** It is as light as by day from here on, and dark from there on; sines of the sun's height. */
const DAY_SINE = 0.3;
const NIGHT_SINE = -0.12;
const DUSK_SINE = 0.22;
/** Below this the sun's own light fades. */
const FADE_SINE = 0.03;
/** Here the sky has no glow: that of the sun is gone, and the moon's begins. */
const GLOWLESS_SINE = NIGHT_SINE / 2;
/** Where the moon stands by night: high, and from the side from which facades are seen. */
const TO_MOON: Vec3 = [0.45, -0.55, 0.7];

export function daylightAt(hour: number, path: SunPath = USUAL_PATH): Daylight {
  const toSun = path.sunAt(hour);
  const height = toSun[2];
  const share = (height - NIGHT_SINE) / (DAY_SINE - NIGHT_SINE);
  const day = Math.min(1, Math.max(0, share));
  const shine = (isMoon: boolean, share: number): Shine => {
    return { to: isMoon ? scale(TO_MOON, 1 / length(TO_MOON)) : toSun, isMoon, share: Math.min(1, share) };
  };
  return {
    light: height > 0 ? shine(false, height / FADE_SINE) : shine(true, height / NIGHT_SINE),
    glow: shine(height < GLOWLESS_SINE, Math.abs(height / GLOWLESS_SINE - 1)),
    day: day * day * (3 - 2 * day),
    dusk: Math.max(0, 1 - Math.abs(height) / DUSK_SINE),
  };
}

/** Unit vector to the sun: the usual one, turned about the axis of the heavens. */
export function sunAt(hour: number): Vec3 {
  const turn = ((DAY_HOUR - hour) / 24) * 2 * Math.PI;
  const sun = scale(AFTERNOON, 1 / length(AFTERNOON));
  const [c, s] = [Math.cos(turn), Math.sin(turn)];
  const side = cross(POLE, sun);
  const rest = dot(POLE, sun) * (1 - c);
  return [0, 1, 2].map((k) => c * (sun[k] ?? 0) + s * (side[k] ?? 0) + rest * (POLE[k] ?? 0)) as unknown as Vec3;
}

/** By the angle from the meridian: 15 degrees an hour, noon in the south. */
function hourOf(toSun: Vec3): number {
  const south: Vec3 = [0, -Math.sin(LATITUDE_RAD), Math.cos(LATITUDE_RAD)];
  return 12 + (Math.atan2(-toSun[0], dot(toSun, south)) * 24) / (2 * Math.PI);
}

function cross(a: Vec3, b: Vec3): Vec3 {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

const ASSUMED_NORTH = "north is taken to be up on the plan";

/** Where nothing is known of a place. */
export const USUAL_PATH: SunPath = {
  sunAt,
  firstHour: DAY_HOUR,
  dayHour: DAY_HOUR,
  nightHour: NIGHT_HOUR,
  words: `The sun of a spring day at 45° north; ${ASSUMED_NORTH}`,
};

const STEP_HOURS = 0.25;

/** The sun over a place on the day on which it is looked at; the usual one where nobody knows where it is. */
export function sunPathOf(sun: Place["sun"]): SunPath {
  if (sun === null) return USUAL_PATH;
  const north = sun.northKnown ? "" : `; ${ASSUMED_NORTH}`;
  if (sun.day === null) return { ...USUAL_PATH, words: `The sun of a spring day at 45° north${north}` };
  const { latitude_deg, longitude_deg, midnight_ms, hour, date, zone, timeKnown } = sun.day;
  const at = (hour: number): Vec3 => sunVector(latitude_deg, longitude_deg, midnight_ms + hour * 3_600_000);
  const hours = Array.from({ length: 24 / STEP_HOURS }, (_, step) => step * STEP_HOURS);
  const byHeight = hours.toSorted((a, b) => at(a)[2] - at(b)[2]);
  const [lowest, highest] = [byHeight[0] ?? 0, byHeight.at(-1) ?? 12];
  const given = daylightAt(hour, { ...USUAL_PATH, sunAt: at }).day > 0.5;
  const day = timeKnown ? date : `${date} (assumed)`;
  return {
    sunAt: at,
    firstHour: hour,
    dayHour: given && hour !== lowest ? hour : highest,
    nightHour: lowest,
    words: `The sun of ${day} at ${degrees(latitude_deg, "N", "S")} ${degrees(longitude_deg, "E", "W")}, ${zone}${north}`,
  };
}

function degrees(angle_deg: number, positive: string, negative: string): string {
  return `${Math.abs(angle_deg).toFixed(1)}° ${angle_deg < 0 ? negative : positive}`;
}

export function hourText(hour: number): string {
  const minutes = Math.round(hour * 60) % (24 * 60);
  const two = (value: number): string => String(value).padStart(2, "0");
  return `${two(Math.floor(minutes / 60))}:${two(minutes % 60)}`;
}
