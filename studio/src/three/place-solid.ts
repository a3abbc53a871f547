/**
 * What one bumps into and clicks on in a place of parts: each part as a solid of its own, its doors, and
 * the box of a part that has not come yet, so that nobody walks through a house that is on its way.
 */
import { type Box, boxOfPoints, cornersOf } from "../core/framing.ts";
import { worldPoint } from "../core/frames.ts";
import type { Part } from "../core/place.ts";
import type { FeatureRef } from "../core/state.ts";
import { add, type Vec3 } from "../core/vector.ts";
import type { Body, Obstacles } from "../core/walking.ts";
import { Doors } from "./doors.ts";
import type { PartSlot } from "./part-slot.ts";
import { type Hit, Solid } from "./solid.ts";

export class PlaceSolid implements Obstacles {
  readonly #slots: readonly PartSlot[];
  readonly #solids: (Solid | null)[];
  readonly #boxes: (Solid | null)[];
  readonly #doors = new Doors();
  readonly #alive: ReadonlySet<number>;

  /** `alive` are the numbers of parts that nobody bumps into. */
  constructor(slots: readonly PartSlot[], alive: ReadonlySet<number>) {
    this.#slots = slots;
    this.#alive = alive;
    this.#solids = slots.map(() => null);
    this.#boxes = slots.map(({ part }, index) => (alive.has(index) ? null : boxSolidOf(part)));
    for (const [index, { isThere }] of slots.entries()) if (isThere) this.take(index);
  }

  /** The model of a part has come. */
  take(index: number): void {
    const slot = this.#slots[index];
    if (slot === undefined) return;
    this.#boxes[index] = null;
    if (slot.part.isBackdrop || this.#alive.has(index)) return;
    this.#solids[index] = slot.solid;
    this.#doors.take(this.#slots, index);
  }

  /** Null where nothing opens. */
  get doors(): Doors | null {
    return this.#doors.states.length === 0 ? null : this.#doors;
  }

  /** Around all parts, those on their way too; world frame. */
  get bounds(): Box {
    const boxes = [...this.#solids, ...this.#boxes].flatMap((solid) => (solid === null ? [] : [solid.bounds]));
    if (boxes.length === 0) return { min: [-1, -1, 0], max: [1, 1, 1] };
    return boxOfPoints(boxes.flatMap(({ min, max }) => [min, max]));
  }

  get faceCount(): number {
    return this.#solids.reduce((count, solid) => count + (solid?.faceCount ?? 0), this.#doors.faceCount);
  }

  pushOut(feet: Vec3, body: Body): Vec3 | null {
    let push: Vec3 | null = null;
    for (const obstacle of [...this.#solids, ...this.#boxes, this.#doors]) {
      if (obstacle === null || (obstacle instanceof Solid && !reaches(obstacle.bounds, feet, body))) continue;
      const more: Vec3 | null = obstacle.pushOut(push === null ? feet : add(feet, push), body);
      if (more !== null) push = push === null ? more : add(push, more);
    }
    return push;
  }

  /** The highest face over or under a place; null where there is none. */
  topAt(x: number, y: number): number | null {
    let highest: number | null = null;
    for (const solid of this.#solids) {
      const height = solid?.topAt(x, y) ?? null;
      if (height !== null) highest = Math.max(highest ?? height, height);
    }
    return highest;
  }

  groundAt(x: number, y: number): number | null {
    let highest: number | null = null;
    for (const [index, { part }] of this.#slots.entries()) {
      const solid = this.#solids[index] ?? null;
      if (!part.isGround || solid === null) continue;
      const height = solid.topAt(x, y);
      if (height !== null) highest = Math.max(highest ?? height, height);
    }
    return highest;
  }

  /** The first visible surface on the ray; `direction` is a unit vector. */
  firstHit(origin: Vec3, direction: Vec3, isVisible: (feature: FeatureRef) => boolean): Hit | null {
    let nearest: Hit | null = null;
    for (const target of [...this.#solids, this.#doors]) {
      const hit = target?.firstHit(origin, direction, isVisible) ?? null;
      if (hit !== null && hit.distance_m < (nearest?.distance_m ?? Infinity)) nearest = hit;
    }
    return nearest;
  }
}

/** How far beside a box a body may stand that still touches what is in it, after a few pushes (m). */
const BESIDE_M = 1;

function reaches({ min, max }: Box, feet: Vec3, { radius_m, height_m }: Body): boolean {
  const beside = radius_m + BESIDE_M;
  return (
    feet[0] > min[0] - beside && feet[0] < max[0] + beside &&
    feet[1] > min[1] - beside && feet[1] < max[1] + beside &&
    feet[2] < max[2] + BESIDE_M && feet[2] + height_m > min[2] - BESIDE_M
  );
}

/** Two triangles for each side; corners by the bits of their numbers, as `cornersOf` has them. */
const SIDES = [0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1, 2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3];

/** Where a part will stand; null where nobody knows, and of what nobody bumps into. */
function boxSolidOf({ bounds, isGround, isBackdrop, worldFromPart }: Part): Solid | null {
  if (bounds === null || isGround || isBackdrop) return null;
  const corners = cornersOf(bounds).map((corner) => worldPoint(worldFromPart, corner));
  const positions = new Float32Array(SIDES.flatMap((corner) => corners[corner] ?? [0, 0, 0]));
  const faces = SIDES.length / 3;
  return new Solid({
    positions,
    partOfFace: new Uint32Array(faces),
    rowOfFace: new Uint32Array(faces),
    firstBoxFace: faces,
    instances: [],
  });
}
