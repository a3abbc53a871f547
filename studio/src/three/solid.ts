/**
 * The place as one solid in the world frame (z up): what a walker bumps into and a click hits.
 * Hidden layers can be walked into as before; a click goes through them.
 */
import { Box3, BufferAttribute, BufferGeometry, DoubleSide, Line3, Ray, Vector3 } from "three";
import { type ExtendedTriangle, MeshBVH } from "three-mesh-bvh";
import { drawnFromWorld, worldFromDrawn } from "../core/frames.ts";
import type { Box } from "../core/framing.ts";
import type { FeatureRef } from "../core/state.ts";
import type { Vec3 } from "../core/vector.ts";
import type { Body, Obstacles } from "../core/walking.ts";
import { boxOf, type InstancedFeatures, placeOf } from "./instanced-mesh.ts";
import type { LoadedPart } from "./load.ts";

export interface Hit {
  readonly feature: FeatureRef;
  readonly point: Vec3;
  readonly distance_m: number;
}

export interface Soup {
  /** Nine coordinates per triangle, world frame. */
  readonly positions: Float32Array;
  readonly partOfFace: Uint32Array;
  readonly rowOfFace: Uint32Array;
  /** From this face on, twelve faces are the box of an instance: a walker bumps into the box. */
  readonly firstBoxFace: number;
  /** What stands in the boxes, in their order: a click hits it and not its box. */
  readonly instances: readonly Standing[];
}

/** An instance of a mesh, in the drawn frame. */
export interface Standing {
  readonly target: InstancedFeatures;
  readonly index: number;
}

export class Solid implements Obstacles {
  readonly bounds: Box;
  readonly faceCount: number;
  readonly #soup: Soup;
  readonly #bvh: MeshBVH;
  readonly #trees = new WeakMap<BufferGeometry, MeshBVH>();
  readonly #ground: Solid | null;

  /** `ground` is what of it one walks on and cannot fall through. */
  constructor(soup: Soup, ground: Solid | null = null) {
    this.#soup = soup;
    this.#ground = ground;
    this.faceCount = soup.rowOfFace.length;
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(soup.positions, 3));
    // `indirect` leaves the triangles in the order of the soup.
    this.#bvh = new MeshBVH(geometry, { indirect: true });
    const box = this.#bvh.getBoundingBox(new Box3());
    this.bounds = { min: box.min.toArray(), max: box.max.toArray() };
  }

  pushOut(feet: Vec3, body: Body): Vec3 | null {
    const { radius_m: radius, height_m: height } = body;
    const axis = new Line3(
      new Vector3(feet[0], feet[1], feet[2] + radius),
      new Vector3(feet[0], feet[1], feet[2] + height - radius),
    );
    const start = axis.start.clone();
    const reach = new Box3().setFromPoints([axis.start, axis.end]).expandByScalar(radius);
    const onTriangle = new Vector3();
    const onAxis = new Vector3();
    this.#bvh.shapecast({
      intersectsBounds: (box) => box.intersectsBox(reach),
      // The types mark it deprecated unless the tree is a MeshBVH, which it is.
      // eslint-disable-next-line @typescript-eslint/no-deprecated
      intersectsTriangle: (triangle: ExtendedTriangle) => {
        const distance = triangle.closestPointToSegment(axis, onTriangle, onAxis);
        if (distance >= radius) return false;
        const away = onAxis.clone().sub(onTriangle);
        if (distance === 0) triangle.getNormal(away);
        away.setLength(radius - distance);
        axis.start.add(away);
        axis.end.add(away);
        return false;
      },
    });
    const push = axis.start.sub(start);
    return push.lengthSq() === 0 ? null : push.toArray();
  }

  groundAt(x: number, y: number): number | null {
    return this.#ground?.topAt(x, y) ?? null;
  }

  /** The highest face over or under a place; null where there is none. */
  topAt(x: number, y: number): number | null {
    const from = new Vector3(x, y, this.bounds.max[2] + 1);
    return this.#bvh.raycastFirst(new Ray(from, new Vector3(0, 0, -1)), DoubleSide)?.point.z ?? null;
  }

  /** The first visible surface on the ray; `direction` is a unit vector. */
  firstHit(origin: Vec3, direction: Vec3, isVisible: (feature: FeatureRef) => boolean): Hit | null {
    const ray = new Ray(new Vector3(...origin), new Vector3(...direction));
    const hits = this.#bvh.raycast(ray, DoubleSide).sort((a, b) => a.distance - b.distance);
    const looked = new Set<number>();
    let nearest: Hit | null = null;
    for (const hit of hits) {
      if (nearest !== null && hit.distance >= nearest.distance_m) break;
      const face = hit.faceIndex ?? 0;
      const feature = {
        part: this.#soup.partOfFace[face] ?? 0,
        row: this.#soup.rowOfFace[face] ?? 0,
      };
      if (!isVisible(feature)) continue;
      const box = Math.floor((face - this.#soup.firstBoxFace) / BOX_FACES);
      let distance_m = hit.distance;
      if (box >= 0) {
        if (looked.has(box)) continue;
        looked.add(box);
        const standing = this.#soup.instances[box];
        distance_m = standing === undefined ? Infinity : this.#within(standing, ray);
      }
      if (distance_m < (nearest?.distance_m ?? Infinity)) {
        nearest = { feature, point: ray.at(distance_m, new Vector3()).toArray(), distance_m };
      }
    }
    return nearest;
  }

  /** How far along the ray an instance itself is hit (m); infinite where the ray passes it. */
  #within({ target, index }: Standing, ray: Ray): number {
    const { geometry } = target.mesh;
    let tree = this.#trees.get(geometry);
    if (tree === undefined) {
      tree = new MeshBVH(geometry, { indirect: true });
      this.#trees.set(geometry, tree);
    }
    const place = placeOf(target, index);
    const start = new Vector3(...drawnFromWorld(ray.origin.toArray()));
    const end = new Vector3(...drawnFromWorld(ray.at(1, new Vector3()).toArray()));
    const back = place.clone().invert();
    const local = new Ray(start.clone().applyMatrix4(back), end.applyMatrix4(back));
    local.direction.sub(local.origin).normalize();
    const hit = tree.raycastFirst(local, DoubleSide) as { point: Vector3 } | null;
    return hit === null ? Infinity : hit.point.clone().applyMatrix4(place).distanceTo(start);
  }
}

/** Triangles of a box. */
const BOX_FACES = 12;
/** The corners of a box by the bits of their numbers: x, y, z. */
const BOX_CORNERS = [
  0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5,
];

/** What a soup takes of a part. */
export type Soupable = Pick<LoadedPart, "meshes" | "instanced">;

/** `first` is the number of the first part in the place. */
export function soupOf(parts: readonly Soupable[], first = 0): Soup {
  const own = parts.flatMap(({ meshes }) => meshes);
  const firstBoxFace = own.reduce((faces, mesh) => faces + mesh.rowOfFace.length, 0);
  const instances = parts.flatMap(({ instanced }) =>
    instanced.flatMap((target) => Array.from(target.rows, (_, index) => ({ target, index }))),
  );
  const count = firstBoxFace + BOX_FACES * instances.length;
  const soup: Soup = {
    positions: new Float32Array(9 * count),
    partOfFace: new Uint32Array(count),
    rowOfFace: new Uint32Array(count),
    firstBoxFace,
    instances,
  };
  const corner = new Vector3();
  let face = 0;
  for (const [part, { meshes }] of parts.entries()) {
    for (const { mesh, faces, rowOfFace } of meshes) {
      const position = mesh.geometry.getAttribute("position");
      soup.rowOfFace.set(rowOfFace, face);
      soup.partOfFace.fill(first + part, face, face + rowOfFace.length);
      for (const [k, vertex] of faces.entries()) {
        corner.fromBufferAttribute(position, vertex).applyMatrix4(mesh.matrixWorld);
        soup.positions.set(worldFromDrawn(corner.toArray()), 9 * face + 3 * k);
      }
      face += rowOfFace.length;
    }
  }
  addBoxes(soup, parts, first);
  return soup;
}

/** Twelve triangles for each instance: the box of its mesh where it stands. */
function addBoxes(soup: Soup, parts: readonly Soupable[], first: number): void {
  const corner = new Vector3();
  let face = soup.firstBoxFace;
  for (const [part, { instanced }] of parts.entries()) {
    for (const target of instanced) {
      const { min, max } = boxOf(target.mesh);
      for (const [index, row] of target.rows.entries()) {
        const place = placeOf(target, index);
        soup.rowOfFace.fill(row, face, face + BOX_FACES);
        soup.partOfFace.fill(first + part, face, face + BOX_FACES);
        for (const [k, bits] of BOX_CORNERS.entries()) {
          corner.set(bits & 1 ? max.x : min.x, bits & 2 ? max.y : min.y, bits & 4 ? max.z : min.z);
          soup.positions.set(worldFromDrawn(corner.applyMatrix4(place).toArray()), 9 * face + 3 * k);
        }
        face += BOX_FACES;
      }
    }
  }
}
