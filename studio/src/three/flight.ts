/** A short flight of the camera from one pose to another. */
import { type PerspectiveCamera, Quaternion, Vector3 } from "three";

export interface Pose {
  readonly position: Vector3;
  readonly quaternion: Quaternion;
  readonly fov: number;
  /** How far the view's centre is moved in the picture; shares of its size, y down. */
  readonly shift: readonly [number, number];
}

const DURATION_S = 0.9;

export function poseOf(camera: PerspectiveCamera): Pose {
  return {
    position: camera.position.clone(),
    quaternion: camera.quaternion.clone(),
    fov: camera.fov,
    shift: shiftOfCamera(camera),
  };
}

function shiftOfCamera(camera: PerspectiveCamera): readonly [number, number] {
  const view = camera.view;
  if (view?.enabled !== true) return [0, 0];
  return [-view.offsetX / view.fullWidth, -view.offsetY / view.fullHeight];
}

export function setPose(camera: PerspectiveCamera, pose: Pose): void {
  camera.position.copy(pose.position);
  camera.quaternion.copy(pose.quaternion);
  camera.fov = pose.fov;
  const [x, y] = pose.shift;
  // In units of the picture's height; only ratios matter here.
  camera.setViewOffset(camera.aspect, 1, -x * camera.aspect, -y, camera.aspect, 1);
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
      fov: mix(this.#from.fov, this.#to.fov, eased),
      shift: [
        mix(this.#from.shift[0], this.#to.shift[0], eased),
        mix(this.#from.shift[1], this.#to.shift[1], eased),
      ],
    });
    return t === 1;
  }
}

function mix(from: number, to: number, share: number): number {
  return from + (to - from) * share;
}
