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
/** Others that stand so near to the first (lengths) are shown with it. */
const TOGETHER_LENGTHS = 8;
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

/** Where an animal is, and which way it goes; world frame. */
export interface Stand {
  readonly at: Vec3;
  readonly ahead: Vec3;
  readonly length_m: number;
}

/**
 * The look at animals that stand where they do: as the place's start looks, or as little
 * beside that as it takes for nothing to be in the way. Where one is hidden from everywhere, the look at the first; where
 * that is, as the start looks.
 */
export function lookAtAnimals(stands: readonly Stand[], start: Place["start"], sight: Sight): FirstLook {
  const [first] = stands;
  const directions = directionsFrom(subtract(start.target, start.eye));
  const groups = first === undefined ? [] : [stands, [first]];
  for (const group of groups) {
    const points = group.flatMap(pointsOf);
    const far = FREE_LENGTHS * Math.max(...group.map(({ length_m }) => length_m));
    const direction = directions.find((one) => points.every((point) => sight(point, scale(one, -1)) > far));
    if (direction !== undefined) return { corners: group.flatMap(cornersAround), direction };
  }
  return { corners: stands.slice(0, 1).flatMap(cornersAround), direction: directions[0] ?? [0, 1, 0] };
}

/** Where the place has its animals at the beginning. */
export function standsOf({ animals }: Pick<Place, "animals">): Stand[] {
  return animals.map((animal): Stand => {
    const { point, ahead } = new Course(animal, () => null).at(0);
    return { at: point, ahead, length_m: animal.length_m };
  });
}

/** The first and those near to it. */
export function together(stands: readonly Stand[]): Stand[] {
  const [first] = stands;
  if (first === undefined) return [];
  return stands.filter(({ at }) => length(subtract(at, first.at)) <= TOGETHER_LENGTHS * first.length_m);
}

/** The middle of an animal, its head and its tail, low over its path. */
function pointsOf({ at, ahead, length_m }: Stand): Vec3[] {
  const middle = add(at, [0, 0, LOW_LENGTHS * length_m]);
  return [middle, add(middle, scale(ahead, 0.4 * length_m)), add(middle, scale(ahead, -0.4 * length_m))];
}

function cornersAround({ at, length_m }: Stand): Vec3[] {
  return cornersOf(around(at, length_m));
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
