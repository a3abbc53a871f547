/** The sun through a day, and how light it is. World frame, y north. */
import { dot, length, scale, type Vec3 } from "./vector.ts";

/** To the sun on a spring afternoon, from the street's side (facades look south): the usual light. */
const AFTERNOON: Vec3 = [-0.72, -0.62, 0.66];
/** The latitude at which the sun comes by there at the equinox, within two degrees. */
const LATITUDE_RAD = Math.PI / 4;
const POLE: Vec3 = [0, Math.cos(LATITUDE_RAD), Math.sin(LATITUDE_RAD)];

/** When the sun is where the usual light comes from; solar time. */
export const DAY_HOUR = hourOf(AFTERNOON);
export const NIGHT_HOUR = 22;

export interface Daylight {
  /** Unit vector to the sun, or to the moon where the sun is down. */
  readonly toLight: Vec3;
  /** From 0 (night) to 1 (day). */
  readonly day: number;
  /** How red the light is: 1 where the sun stands on the horizon. */
  readonly dusk: number;
}

/** It is as light as by day from here on, and dark from there on; sines of the sun's height. */
const DAY_SINE = 0.3;
const NIGHT_SINE = -0.12;
const DUSK_SINE = 0.22;
/** Where the moon stands by night: high, and from the side from which facades are seen. */
const TO_MOON: Vec3 = [0.45, -0.55, 0.7];

export function daylightAt(hour: number): Daylight {
  const toSun = sunAt(hour);
  const height = toSun[2];
  const share = (height - NIGHT_SINE) / (DAY_SINE - NIGHT_SINE);
  const day = Math.min(1, Math.max(0, share));
  return {
    toLight: height > 0 ? toSun : scale(TO_MOON, 1 / length(TO_MOON)),
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

export function hourText(hour: number): string {
  const minutes = Math.round(hour * 60) % (24 * 60);
  const two = (value: number): string => String(value).padStart(2, "0");
  return `${two(Math.floor(minutes / 60))}:${two(minutes % 60)}`;
}
