/** In which storey and room of a house somebody is. */
import type { House, Point, Room, Storey } from "./house.ts";
import type { Vec3 } from "./vector.ts";

export interface Whereabouts {
  readonly house: number;
  readonly storey: number;
  /** Number of the room in its storey; null outside, and within walls. */
  readonly room: number | null;
}

/** On a stair one is still in the storey that one comes from, until nearly at the next floor. */
const BELOW_FLOOR_M = 0.6;

/** The storey whose floor is the highest that is not above the feet; the lowest for those below all. */
export function storeyAt(house: House, feet_m: number): number {
  const above = house.storeys.findIndex(({ floor_m }) => floor_m - BELOW_FLOOR_M > feet_m);
  return Math.max(0, (above < 0 ? house.storeys.length : above) - 1);
}

export function roomAt(storey: Storey, x: number, y: number): number | null {
  const found = storey.rooms.findIndex((room) => isIn(room, x, y));
  return found < 0 ? null : found;
}

/** Even-odd over the outline and the holes. */
export function isIn({ outline, holes }: Room, x: number, y: number): boolean {
  return [outline, ...holes].reduce((inside, ring) => inside !== crosses(ring, x, y), false);
}

function crosses(ring: readonly Point[], x: number, y: number): boolean {
  let odd = false;
  let before = ring[ring.length - 1];
  for (const corner of ring) {
    if (before !== undefined && corner[1] > y !== before[1] > y) {
      const at = corner[0] + ((y - corner[1]) / (before[1] - corner[1])) * (before[0] - corner[0]);
      if (x < at) odd = !odd;
    }
    before = corner;
  }
  return odd;
}

/** Of several houses the one in whose room somebody is, else the one whose rooms are nearest. */
export function whereaboutsOf(houses: readonly House[], feet: Vec3): Whereabouts | null {
  let nearest: { house: number; distance: number } | null = null;
  for (const [house, { storeys }] of houses.entries()) {
    const storey = storeyAt({ storeys }, feet[2]);
    const room = storeys[storey] === undefined ? null : roomAt(storeys[storey], feet[0], feet[1]);
    if (room !== null) return { house, storey, room };
    const distance = Math.min(...storeys.flatMap(({ rooms }) => rooms.map((each) => distanceTo(each, feet))));
    if (nearest === null || distance < nearest.distance) nearest = { house, distance };
  }
  if (nearest === null) return null;
  const { house } = nearest;
  const { storeys } = houses[house] ?? { storeys: [] };
  return { house, storey: storeyAt({ storeys }, feet[2]), room: null };
}

function distanceTo({ outline }: Room, feet: Vec3): number {
  return Math.min(...outline.map(([x, y]) => Math.hypot(x - feet[0], y - feet[1])));
}

/** What a room is called: by what is written on the plan, else by its use. */
export function roomTitle({ name, use }: Room): string {
  const word = name.trim() === "" ? use : name.trim();
  // Abbreviations stay as they are written.
  const isShouted = word === word.toUpperCase() && /\p{L}{4}/u.test(word);
  const text = isShouted ? word.toLowerCase() : word;
  if (word === "unknown") return "Room";
  return text.charAt(0).toUpperCase() + text.slice(1);
}

/** How far from walls one is put, and how finely places to stand are looked for. */
const CLEARANCE_M = 0.35;
const GRID_M = 0.25;
const MOST_PLACES = 4000;

/** Where one can stand in a room, away from its walls, the nearest to a wanted point first. */
export function standingPlaces(room: Room, wanted: Point): Point[] {
  const [xs, ys] = [0, 1].map((axis) => room.outline.map((corner) => corner[axis] ?? 0));
  if (xs === undefined || ys === undefined || xs.length === 0) return [];
  const [x0, x1, y0, y1] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
  const grid = Math.max(GRID_M, Math.sqrt(((x1 - x0) * (y1 - y0)) / MOST_PLACES));
  const places: Point[] = [wanted];
  for (let x = x0 + grid / 2; x < x1; x += grid) for (let y = y0 + grid / 2; y < y1; y += grid) places.push([x, y]);
  const off = ([x, y]: Point): number => Math.hypot(x - wanted[0], y - wanted[1]);
  const sides = [room.outline, ...room.holes].flatMap((ring) =>
    ring.map((corner, i) => [corner, ring[(i + 1) % ring.length] ?? corner] as const),
  );
  return places
    .filter((place) => isIn(room, ...place) && sides.every((side) => distanceToSide(place, side) > CLEARANCE_M))
    .toSorted((a, b) => off(a) - off(b));
}

/** In a doorway one is in no room, and not outside. */
const BESIDE_M = 0.35;

export function isBesideRoom({ rooms }: Storey, point: Point): boolean {
  return rooms.some(({ outline }) =>
    outline.some((corner, i) => distanceToSide(point, [corner, outline[(i + 1) % outline.length] ?? corner]) < BESIDE_M),
  );
}

function distanceToSide([x, y]: Point, [from, to]: readonly [Point, Point]): number {
  const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
  const along = ((x - from[0]) * dx + (y - from[1]) * dy) / Math.max(dx * dx + dy * dy, 1e-12);
  const share = Math.min(1, Math.max(0, along));
  return Math.hypot(x - from[0] - share * dx, y - from[1] - share * dy);
}
