/** The doors of a place: they open for the visitor and close behind him, and stop him while closed. */
import { BufferAttribute, Matrix4, Vector3 } from "three";
import { type Doorway, doorwayOf, eased, isWanted, PASSABLE, swung, type Visitor } from "../core/doors.ts";
import { drawnFromWorld, worldFromDrawn } from "../core/frames.ts";
import type { FeatureRef } from "../core/state.ts";
import { add, length, scale, subtract, type Vec3 } from "../core/vector.ts";
import type { Body, Obstacles } from "../core/walking.ts";
import type { LoadedPart } from "./load.ts";
import type { Mover } from "./movers.ts";
import { type Hit, Solid } from "./solid.ts";
import { soupOf } from "./soup.ts";

interface Leaf {
  readonly mover: Mover;
  /** As it stands closed. */
  readonly solid: Solid;
  readonly closed: Matrix4;
}

interface Door {
  readonly feature: FeatureRef;
  readonly id: string;
  readonly doorway: Doorway;
  readonly leaves: readonly Leaf[];
  share: number;
}

export interface DoorState {
  readonly feature: FeatureRef;
  readonly foot: Vec3;
  /** From 0 (closed) to 1 (open). */
  readonly share: number;
}

export class Doors implements Obstacles {
  readonly #doors: Door[] = [];

  /** Takes over those of a part that has come. They are closed at first. */
  take(parts: readonly LoadedPart[], part: number): void {
    const { movers = [], table } = parts[part] ?? {};
    const rows = new Set(movers.map(({ row }) => row));
    for (const row of rows) this.#doors.push(doorOf(movers, part, row, table?.rows[row]?.id ?? ""));
  }

  get faceCount(): number {
    return this.#leaves.reduce((count, { solid }) => count + solid.faceCount, 0);
  }

  get states(): DoorState[] {
    return this.#doors.map(({ feature, doorway, share }) => ({ feature, foot: doorway.foot, share }));
  }

  /**
   * Opens those that should be open and closes the others; true while one of them moves. Those whose ids are
   * in `shut` stay closed, whoever comes.
   */
  advance(visitor: Visitor | null, areHeldOpen: boolean, seconds: number, shut: ReadonlySet<string>): boolean {
    let moves = false;
    for (const door of this.#doors) {
      const comes = visitor !== null && isWanted(door.doorway, visitor, door.share > 0);
      const wanted = !shut.has(door.id) && (areHeldOpen || comes);
      const share = swung(door.share, wanted, seconds);
      if (share === door.share) continue;
      door.share = share;
      for (const { mover } of door.leaves) mover.pose(eased(share));
      moves = true;
    }
    return moves;
  }

  pushOut(feet: Vec3, body: Body): Vec3 | null {
    let push: Vec3 | null = null;
    for (const door of this.#doors) {
      if (door.share >= PASSABLE || !isNear(door.doorway, feet)) continue;
      for (const { solid } of door.leaves) {
        const more: Vec3 | null = solid.pushOut(push === null ? feet : add(feet, push), body);
        if (more !== null) push = push === null ? more : add(push, more);
      }
    }
    return push;
  }

  /** The nearest leaf on the ray, where it stands now. */
  firstHit(origin: Vec3, direction: Vec3, isVisible: (feature: FeatureRef) => boolean): Hit | null {
    let nearest: Hit | null = null;
    for (const leaf of this.#leaves) {
      const hit = hitOf(leaf, origin, direction, isVisible);
      if (hit !== null && hit.distance_m < (nearest?.distance_m ?? Infinity)) nearest = hit;
    }
    return nearest;
  }

  get #leaves(): Leaf[] {
    return this.#doors.flatMap(({ leaves }) => leaves);
  }
}

function doorOf(all: readonly Mover[], part: number, row: number, id: string): Door {
  const movers = all.filter((mover) => mover.row === row);
  for (const mover of movers) mover.pose(0);
  const leaves = movers.map((mover): Leaf => {
    const alone = { meshes: mover.meshes, instanced: [] };
    return { mover, solid: new Solid(soupOf([alone], part)), closed: mover.place.clone() };
  });
  const doorway = doorwayOf(movers.flatMap(cornersOf));
  return { feature: { part, row }, id, doorway, leaves, share: 0 };
}

function cornersOf({ meshes }: Mover): Vec3[] {
  return meshes.flatMap(({ mesh }) => {
    const position = mesh.geometry.getAttribute("position") as BufferAttribute;
    const corner = new Vector3();
    return Array.from({ length: position.count }, (_, vertex) =>
      worldFromDrawn(corner.fromBufferAttribute(position, vertex).applyMatrix4(mesh.matrixWorld).toArray()),
    );
  });
}

function isNear({ foot, halfWidth_m }: Doorway, feet: Vec3): boolean {
  return Math.hypot(foot[0] - feet[0], foot[1] - feet[1]) < halfWidth_m + 1;
}

/** The ray goes to where the leaf was when it was closed, and the hit comes back from there. */
function hitOf(
  { mover, solid, closed }: Leaf,
  origin: Vec3,
  direction: Vec3,
  isVisible: (feature: FeatureRef) => boolean,
): Hit | null {
  const closedFromNow = closed.clone().multiply(mover.place.clone().invert());
  const back = (point: Vec3): Vec3 => moved(point, closedFromNow);
  const from = back(origin);
  const way = subtract(back(add(origin, direction)), from);
  const hit = solid.firstHit(from, scale(way, 1 / length(way)), isVisible);
  return hit === null ? null : { ...hit, point: moved(hit.point, closedFromNow.invert()) };
}

/** A point of the world by a motion of the drawn frame. */
function moved(point: Vec3, motion: Matrix4): Vec3 {
  return worldFromDrawn(new Vector3(...drawnFromWorld(point)).applyMatrix4(motion).toArray());
}
