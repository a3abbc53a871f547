/** The first picture of a place in which an animal would be but a dot, or hidden: one begins beside the animal. */
import { Course } from "./course.ts";
import { type Box, boxOfPoints, cornersOf } from "./framing.ts";
import { cornersOfPlace, type Place } from "./place.ts";
import { add, length, scale, subtract, type Vec3 } from "./vector.ts";

/** An animal is seen well in a view of all that is no larger than so many of its lengths. */
const SEEN_LENGTHS = 6;
/** What is shown around its middle: so many lengths to each side, and so high. */
const BESIDE_LENGTHS = 1.5;
const HIGH_LENGTHS = 0.8;
/** It must be seen from so far away (lengths), its head and its tail too. */
const FREE_LENGTHS = 6;
/** Its low parts must be seen too: so high over its path (lengths). */
const LOW_LENGTHS = 0.06;
/** Directions are tried in steps around the animal, each from above, then from higher (rise over run). */
const STEPS = 12;
const [LEAST_RISE, MOST_RISE] = [0.32, 0.9];

/** What one looks at first: world frame; `direction` is a unit vector into the picture. */
export interface FirstLook {
  readonly corners: readonly Vec3[];
  readonly direction: Vec3;
}

/** How far one sees from a point along a unit vector (m); infinite where nothing is in the way. */
export type Sight = (from: Vec3, along: Vec3) => number;

/** Whether a view of the whole place shows its first animal as a dot. A town of tiles has none that live. */
export function beginsWithAnimal(place: Place): boolean {
  const [animal] = place.animals;
  if (animal === undefined || place.tileset !== null) return false;
  const { min, max } = boxOfPoints(cornersOfPlace(place));
  return length(subtract(max, min)) > SEEN_LENGTHS * animal.length_m;
}

/**
 * The look at an animal of a length that stands at `at` and goes `ahead`: as the place's start looks, or as little
 * beside that as it takes for nothing to be in the way. Where it is hidden from everywhere, as the start looks.
 */
export function lookAtAnimal(
  { at, ahead, length_m }: { readonly at: Vec3; readonly ahead: Vec3; readonly length_m: number },
  start: Place["start"],
  sight: Sight,
): FirstLook {
  const middle = add(at, [0, 0, LOW_LENGTHS * length_m]);
  const points = [middle, add(middle, scale(ahead, 0.4 * length_m)), add(middle, scale(ahead, -0.4 * length_m))];
  const isFree = (direction: Vec3): boolean =>
    points.every((point) => sight(point, scale(direction, -1)) > FREE_LENGTHS * length_m);
  const directions = directionsFrom(subtract(start.target, start.eye));
  const direction = directions.find(isFree) ?? directions[0] ?? [0, 1, 0];
  return { corners: cornersOf(around(at, length_m)), direction };
}

/** The first animal where the place has it at the beginning. */
export function firstStand({ animals }: Pick<Place, "animals">): { at: Vec3; ahead: Vec3; length_m: number } | null {
  const [animal] = animals;
  if (animal === undefined) return null;
  const { point, ahead } = new Course(animal, () => null).at(0);
  return { at: point, ahead, length_m: animal.length_m };
}

function around([x, y, z]: Vec3, length_m: number): Box {
  const [beside, high] = [BESIDE_LENGTHS * length_m, HIGH_LENGTHS * length_m];
  return { min: [x - beside, y - beside, z], max: [x + beside, y + beside, z + high] };
}

/** Unit vectors that look down, the nearest to a way first: 0, 1, -1, 2, -2, ... steps beside it. */
function directionsFrom([east, north, up]: Vec3): Vec3[] {
  const rise = Math.max(LEAST_RISE, Math.min(MOST_RISE, -up / Math.max(Math.hypot(east, north), 1e-9)));
  const first = east === 0 && north === 0 ? Math.PI / 2 : Math.atan2(north, east);
  return [rise, MOST_RISE].flatMap((down) =>
    Array.from({ length: STEPS }, (_, step): Vec3 => {
      const beside = Math.ceil(step / 2) * (step % 2 === 1 ? 1 : -1);
      const angle = first + (2 * Math.PI * beside) / STEPS;
      return scale([Math.cos(angle), Math.sin(angle), -down], 1 / Math.hypot(1, down));
    }),
  );
}
