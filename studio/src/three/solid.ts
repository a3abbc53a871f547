/**
 * The place as one solid in the world frame (z up): what a walker bumps into and a click hits.
 * Hidden layers can be walked into as before; a click goes through them.
 */
import { Box3, BufferAttribute, BufferGeometry, DoubleSide, Line3, Ray, Vector3 } from "three";
import { type ExtendedTriangle, MeshBVH } from "three-mesh-bvh";
import { worldFromDrawn } from "../core/frames.ts";
import type { Box } from "../core/framing.ts";
import type { FeatureRef } from "../core/state.ts";
import type { Vec3 } from "../core/vector.ts";
import type { Body, Obstacles } from "../core/walking.ts";
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
}

export class Solid implements Obstacles {
  readonly bounds: Box;
  readonly faceCount: number;
  readonly #soup: Soup;
  readonly #bvh: MeshBVH;

  constructor(soup: Soup) {
    this.#soup = soup;
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

  /** The first visible surface on the ray; `direction` is a unit vector. */
  firstHit(origin: Vec3, direction: Vec3, isVisible: (feature: FeatureRef) => boolean): Hit | null {
    const ray = new Ray(new Vector3(...origin), new Vector3(...direction));
    const hits = this.#bvh.raycast(ray, DoubleSide).sort((a, b) => a.distance - b.distance);
    for (const hit of hits) {
      const face = hit.faceIndex ?? 0;
      const feature = {
        part: this.#soup.partOfFace[face] ?? 0,
        row: this.#soup.rowOfFace[face] ?? 0,
      };
      if (isVisible(feature)) {
        return { feature, point: hit.point.toArray(), distance_m: hit.distance };
      }
    }
    return null;
  }
}

export function soupOf(parts: readonly LoadedPart[]): Soup {
  const count = parts.reduce(
    (sum, { meshes }) => sum + meshes.reduce((faces, mesh) => faces + mesh.rowOfFace.length, 0),
    0,
  );
  const soup: Soup = {
    positions: new Float32Array(9 * count),
    partOfFace: new Uint32Array(count),
    rowOfFace: new Uint32Array(count),
  };
  const corner = new Vector3();
  let face = 0;
  for (const [part, { meshes }] of parts.entries()) {
    for (const { mesh, faces, rowOfFace } of meshes) {
      const position = mesh.geometry.getAttribute("position");
      soup.rowOfFace.set(rowOfFace, face);
      soup.partOfFace.fill(part, face, face + rowOfFace.length);
      for (const [k, vertex] of faces.entries()) {
        corner.fromBufferAttribute(position, vertex).applyMatrix4(mesh.matrixWorld);
        soup.positions.set(worldFromDrawn(corner.toArray()), 9 * face + 3 * k);
      }
      face += rowOfFace.length;
    }
  }
  return soup;
}
