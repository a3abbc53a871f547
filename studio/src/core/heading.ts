/** Looking directions as two angles. */
import { length, type Vec3 } from "./vector.ts";

/** `yaw` 0 looks north (+y) and grows anticlockwise; `pitch` 0 is level, up is positive; radians. */
export interface Heading {
  readonly yaw: number;
  readonly pitch: number;
}

/** Straight up or down leaves no sense of left and right, so the look stops short of it. */
const PITCH_LIMIT = (85 * Math.PI) / 180;

export function directionOf(heading: Heading): Vec3 {
  const level = Math.cos(heading.pitch);
  return [
    -Math.sin(heading.yaw) * level,
    Math.cos(heading.yaw) * level,
    Math.sin(heading.pitch),
  ];
}

export function headingOf(direction: Vec3): Heading {
  const size = length(direction);
  if (size === 0) return { yaw: 0, pitch: 0 };
  return turned(
    { yaw: Math.atan2(-direction[0], direction[1]), pitch: 0 },
    0,
    Math.asin(direction[2] / size),
  );
}

/** The heading after turning left by `left` and up by `up` radians. */
export function turned(heading: Heading, left: number, up: number): Heading {
  const yaw = heading.yaw + left;
  return {
    yaw: Math.atan2(Math.sin(yaw), Math.cos(yaw)),
    pitch: Math.min(PITCH_LIMIT, Math.max(-PITCH_LIMIT, heading.pitch + up)),
  };
}
