/** A short flight of the camera from one pose to another. */
import { type PerspectiveCamera, Quaternion, Vector3 } from "three";

export interface Pose {
  readonly position: Vector3;
  readonly quaternion: Quaternion;
  readonly fov: number;
}

const DURATION_S = 0.9;

export function poseOf(camera: PerspectiveCamera): Pose {
  return {
    position: camera.position.clone(),
    quaternion: camera.quaternion.clone(),
    fov: camera.fov,
  };
}

export function setPose(camera: PerspectiveCamera, pose: Pose): void {
  camera.position.copy(pose.position);
  camera.quaternion.copy(pose.quaternion);
  camera.fov = pose.fov;
  camera.updateProjectionMatrix();
}

export class Flight {
  readonly #from: Pose;
  readonly #to: Pose;
  #elapsed = 0;

  constructor(from: Pose, to: Pose) {
    this.#from = from;
    this.#to = to;
    if (matchMedia("(prefers-reduced-motion: reduce)").matches) this.#elapsed = DURATION_S;
  }

  /** Moves the camera on; true once it has arrived. */
  advance(camera: PerspectiveCamera, seconds: number): boolean {
    this.#elapsed += seconds;
    const t = Math.min(1, this.#elapsed / DURATION_S);
    const eased = t * t * t * (t * (6 * t - 15) + 10);
    setPose(camera, {
      position: new Vector3().lerpVectors(this.#from.position, this.#to.position, eased),
      quaternion: new Quaternion().slerpQuaternions(this.#from.quaternion, this.#to.quaternion, eased),
      fov: this.#from.fov + (this.#to.fov - this.#from.fov) * eased,
    });
    return t === 1;
  }
}
