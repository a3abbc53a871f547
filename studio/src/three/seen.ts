/** What a camera sees, in the world frame. */
import { type PerspectiveCamera, Vector3 } from "three";
import { worldFromDrawn } from "../core/frames.ts";
import { type Sight, sightOf } from "../core/sight.ts";
import type { Vec3 } from "../core/vector.ts";

export interface Seen {
  readonly eye: Vec3;
  readonly direction: Vec3;
  readonly fov_deg: number;
}

export function seenBy(camera: PerspectiveCamera): Seen {
  const direction = camera.getWorldDirection(new Vector3());
  return { eye: worldFromDrawn(camera.position.toArray()), direction: worldFromDrawn(direction.toArray()), fov_deg: camera.fov };
}

export function sightBy(camera: PerspectiveCamera): Sight {
  const { eye, direction, fov_deg } = seenBy(camera);
  return sightOf(eye, direction, (fov_deg * Math.PI) / 180, camera.aspect);
}
