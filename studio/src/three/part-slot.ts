/** The room for a part of the place: empty until its model has come. */
import { type AnimationClip, Group } from "three";
import { areDrawnOnly, type Feature } from "../core/features.ts";
import type { Part } from "../core/place.ts";
import type { FeatureMesh } from "./feature-mesh.ts";
import type { InstancedFeatures } from "./instanced-mesh.ts";
import type { Masks } from "./invented-mask.ts";
import type { LoadedPart } from "./load.ts";
import type { Mover } from "./movers.ts";
import type { Solid } from "./solid.ts";
import type { Soupable } from "./soup.ts";

/** Its group and its table stay the same when the model comes: who has them sees what is in them. */
export class PartSlot implements LoadedPart {
  readonly table: { rows: readonly Feature[] } = { rows: [] };
  readonly group = new Group();
  meshes: readonly FeatureMesh[] = [];
  instanced: readonly InstancedFeatures[] = [];
  masks: Masks = new Map();
  movers: readonly Mover[] = [];
  animations: readonly AnimationClip[] = [];
  /** What of it one bumps into; null where there is nothing. */
  solid: Solid | null = null;
  isThere = false;

  constructor(readonly part: Part) {
    this.group.name = part.id;
    this.group.matrixAutoUpdate = false;
  }

  /** `solid` is of what `stillOf` it. */
  take(loaded: LoadedPart, solid: Solid | null): void {
    this.solid = solid;
    const { table, group } = this;
    Object.assign(this, loaded, { table, group });
    this.table.rows = loaded.table.rows;
    this.group.matrix.copy(loaded.group.matrix);
    this.group.add(...loaded.group.children);
    this.group.updateMatrixWorld(true);
    this.isThere = true;
  }
}

/** What of a part does not move, and is more than drawn: one bumps into it, and points at it. */
export function stillOf({ meshes, instanced, movers, table }: LoadedPart): Soupable {
  const moving = new Set(movers.flatMap((mover) => mover.meshes));
  const stays = (mesh: FeatureMesh): boolean => !moving.has(mesh) && !areDrawnOnly(mesh.rowOfFace, table);
  return { meshes: meshes.filter(stays), instanced };
}
