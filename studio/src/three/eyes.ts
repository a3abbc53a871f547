/** The eyes of a headset on a walk: cameras about the place where one is on it. */
import { Euler, Matrix4, PerspectiveCamera, Quaternion, Vector3 } from "three";

/** head: where the eye is and how it is turned, from where the person began; projection: WebGL's. Column-major. */
export interface Eye {
  readonly head: Float32Array;
  readonly projection: Float32Array;
  readonly viewport: { readonly x: number; readonly y: number; readonly width: number; readonly height: number };
}

/** A level frame at a camera, ahead where it looks: the headset knows best what is up. */
export function levelAt(eye: Vector3, turn: Quaternion): Matrix4 {
  const ahead = new Vector3(0, 0, -1).applyQuaternion(turn);
  const level = new Quaternion().setFromEuler(new Euler(0, Math.atan2(-ahead.x, -ahead.z), 0));
  return new Matrix4().compose(eye, level, new Vector3(1, 1, 1));
}

/** The camera of an eye, in the frame in which `base` is. */
export function eyeCamera(base: Matrix4, { head, projection }: Eye): PerspectiveCamera {
  const camera = new PerspectiveCamera();
  camera.matrixAutoUpdate = false;
  camera.matrixWorldAutoUpdate = false;
  camera.matrixWorld.copy(base).multiply(new Matrix4().fromArray(head));
  camera.matrixWorldInverse.copy(camera.matrixWorld).invert();
  camera.projectionMatrix.fromArray(projection);
  camera.projectionMatrixInverse.copy(camera.projectionMatrix).invert();
  return camera;
}
