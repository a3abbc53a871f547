/** Looking at the place from outside. */
import { MathUtils, type PerspectiveCamera, Spherical, Vector3 } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { drawnFromWorld, worldFromDrawn } from "../core/frames.ts";
import { type Box, boxOfPoints, framePoints, homeDirection, type Insets, shiftOf } from "../core/framing.ts";
import type { Mode } from "../core/state.ts";
import { length, subtract, type Vec3 } from "../core/vector.ts";
import { type Pose, setPose } from "./flight.ts";
import type { Stage } from "./stage.ts";

export const ORBIT_FOV_DEG = 28;
/** What is nearer to the camera is not drawn; from outside, a share of the room before it. */
export const NEAR_M = 0.08;
const NEAR_SHARE = 0.2;
const KEY_TURN_RAD_S = 1.1;

export class OrbitRig {
  readonly #controls: OrbitControls;
  readonly #camera: PerspectiveCamera;
  readonly #bounds: Box;
  readonly #corners: readonly Vec3[];
  readonly #direction: Vec3;
  readonly #size: number;
  readonly #stage: Pick<Stage, "firstLook">;

  /**
   * `corners` are those of what is to be `seen`, and that the box around them; `outlook` is where the
   * photos of it look to.
   */
  constructor(
    camera: PerspectiveCamera,
    canvas: HTMLElement,
    stage: Pick<Stage, "corners" | "seen" | "outlook" | "firstLook">,
    onChange: () => void,
  ) {
    const { corners, seen, outlook } = stage;
    this.#stage = stage;
    this.#camera = camera;
    this.#bounds = seen;
    this.#corners = corners;
    this.#direction = homeDirection(seen, outlook);
    this.#controls = new OrbitControls(camera, canvas);
    this.#controls.enableDamping = true;
    this.#controls.dampingFactor = 0.09;
    this.#controls.zoomToCursor = true;
    this.#size = sizeOf(seen);
    const look = stage.firstLook;
    const least = look === null ? Infinity : 0.5 * sizeOf(boxOfPoints(look.corners));
    this.#controls.minDistance = Math.min(1, 0.1 * this.#size, least);
    this.#controls.maxDistance = 12 * this.#size;
    this.#controls.maxPolarAngle = 0.495 * Math.PI;
    this.#controls.addEventListener("change", onChange);
  }

  get target(): Vector3 {
    return this.#controls.target;
  }

  set enabled(enabled: boolean) {
    this.#controls.enabled = enabled;
  }

  /** The pose that shows the whole place, or its animal, in the free part of the picture. */
  home(aspect: number, insets: Insets): { pose: Pose; target: Vector3 } {
    const fov_rad = MathUtils.degToRad(ORBIT_FOV_DEG);
    const { corners, direction } = this.#stage.firstLook ?? { corners: this.#corners, direction: this.#direction };
    const view = framePoints(corners, direction, fov_rad, aspect, insets);
    const target = new Vector3(...drawnFromWorld(view.target));
    const camera = this.#camera.clone();
    camera.position.set(...drawnFromWorld(view.eye));
    camera.position.y = Math.max(Math.min(0.4, 0.1 * this.#size), camera.position.y);
    camera.lookAt(target);
    return {
      pose: {
        position: camera.position,
        quaternion: camera.quaternion,
        fov: ORBIT_FOV_DEG,
        shift: shiftOf(insets),
      },
      target,
    };
  }

  /** At once; the middle of the picture's free part is what is looked at. */
  lookFrom(eye: Vec3, target: Vec3, insets: Insets): void {
    this.#controls.target.set(...drawnFromWorld(target));
    this.#camera.position.set(...drawnFromWorld(eye));
    this.#camera.lookAt(this.target);
    const { position, quaternion } = this.#camera;
    setPose(this.#camera, { position, quaternion, fov: ORBIT_FOV_DEG, shift: shiftOf(insets) });
    this.#controls.update();
  }

  aimAt(target: Vector3): void {
    this.#controls.target.copy(target);
  }

  /** The camera and what it looks at move by so much (drawn frame). */
  shift(by: Vector3): void {
    this.#camera.position.add(by);
    this.#controls.target.add(by);
  }

  /** How far the camera is from what it looks at (m). */
  get arm_m(): number {
    return this.#camera.position.distanceTo(this.target);
  }

  /** Comes as near to what it looks at as this (m), if it is farther away. */
  approach(distance_m: number): void {
    const arm = this.#camera.position.clone().sub(this.target);
    if (arm.length() > distance_m) this.#camera.position.copy(this.target).add(arm.setLength(distance_m));
  }

  /** How near to the camera nothing is to be seen (m), outside of the place and above the ground. */
  get free_m(): number {
    const { min, max } = this.#bounds;
    const [x, y, z] = worldFromDrawn(this.#camera.position.toArray());
    const off = (at: number, low: number, high: number): number => Math.max(low - at, 0, at - high);
    const away = Math.hypot(off(x, min[0], max[0]), off(y, min[1], max[1]), off(z, min[2], max[2]));
    return Math.min(away, z - min[2]);
  }

  /** Depth is told apart best where nothing is drawn near: the ground lies close over the plane. */
  keepDepth(mode: Mode): void {
    const near = Math.max(NEAR_M, NEAR_SHARE * (mode === "orbit" ? this.free_m : 0));
    if (Math.abs(near - this.#camera.near) < 0.1 * this.#camera.near) return;
    this.#camera.near = near;
    this.#camera.updateProjectionMatrix();
  }

  /** Damping; true while the camera still moves. */
  advance(): boolean {
    this.#controls.target.y = Math.max(0, this.#controls.target.y);
    const moved = this.#controls.update();
    this.#camera.position.y = Math.max(Math.min(0.1, 0.02 * this.#size), this.#camera.position.y);
    return moved;
  }

  /** Turning and zooming by keys; the wishes are in -1..1. */
  steer(left: number, up: number, nearer: number, seconds: number): void {
    const arm = new Spherical().setFromVector3(this.#camera.position.clone().sub(this.target));
    arm.theta += left * KEY_TURN_RAD_S * seconds;
    arm.phi = MathUtils.clamp(arm.phi - up * KEY_TURN_RAD_S * seconds, 0.05, 0.495 * Math.PI);
    arm.radius = MathUtils.clamp(
      arm.radius * Math.exp(-nearer * seconds),
      this.#controls.minDistance,
      this.#controls.maxDistance,
    );
    this.#camera.position.setFromSpherical(arm).add(this.target);
    this.#controls.update();
  }

  dispose(): void {
    this.#controls.dispose();
  }
}

function sizeOf({ min, max }: Box): number {
  return length(subtract(max, min));
}
