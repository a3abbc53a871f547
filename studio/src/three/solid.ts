/**
 * The place as one solid in the world frame (z up): what a walker bumps into and a click hits.
 * Hidden layers can be walked into as before; a click goes through them.
 */
import { Box3, BufferAttribute, BufferGeometry, DoubleSide, Line3, Ray, Vector3 } from "three";
import { type ExtendedTriangle, MeshBVH, type SerializedBVH } from "three-mesh-bvh";
import { drawnFromWorld } from "../core/frames.ts";
import type { Box } from "../core/framing.ts";
import type { FeatureRef } from "../core/state.ts";
import type { Vec3 } from "../core/vector.ts";
import type { Body, Obstacles } from "../core/walking.ts";
import { placeOf } from "./instanced-mesh.ts";
import { BOX_FACES, type Soup, type Standing } from "./soup.ts";

export interface Hit {
  readonly feature: FeatureRef;
  readonly point: Vec3;
  readonly distance_m: number;
}

export class Solid implements Obstacles {
  readonly bounds: Box;
  readonly faceCount: number;
  readonly #soup: Soup;
  readonly #bvh: MeshBVH;
  readonly #trees = new WeakMap<BufferGeometry, MeshBVH>();
  readonly #ground: Solid | null;

  /** `grown` is its tree where that was made elsewhere. `ground` is what of it one walks on and cannot fall through. */
  constructor(soup: Soup, ground: Solid | null = null, grown: SerializedBVH | null = null) {
    this.#soup = soup;
    this.#ground = ground;
    this.faceCount = soup.rowOfFace.length;
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(soup.positions, 3));
    // `indirect` leaves the triangles in the order of the soup.
    this.#bvh = grown === null ? new MeshBVH(geometry, { indirect: true }) : MeshBVH.deserialize(grown, geometry, { setIndex: false });
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
