/** One photo on its way onto the surfaces: where it shines from, and what it sees first. */
import {
  DepthTexture,
  DoubleSide,
  FloatType,
  Matrix4,
  MeshBasicMaterial,
  NearestFilter,
  PerspectiveCamera,
  type Scene,
  type Texture,
  Vector2,
  Vector3,
  WebGLRenderTarget,
  type WebGLRenderer,
} from "three";
import { drawnFromWorld } from "../core/frames.ts";
import { axesOf, clipFromCamera, drawnFromCamera } from "../core/pinhole.ts";
import type { Shot } from "../core/place.ts";

/** Longest side of a depth picture; nearer than this share of the reach nothing is seen. */
const DEPTH_PX = 1536;
const NEAR_SHARE = 1e-3;

export class Projector {
  readonly shot: Shot;
  readonly texture: Texture;
  readonly clipFromDrawn = new Matrix4();
  readonly eye: Vector3;
  readonly reach: Vector2;
  #target: WebGLRenderTarget | null = null;
  #isDue = true;
  readonly #camera = new PerspectiveCamera();

  /** `far`: how far away the last of the surfaces is. */
  constructor(shot: Shot, texture: Texture, far: number) {
    this.shot = shot;
    this.texture = texture;
    const axes = axesOf(shot);
    this.eye = new Vector3(...drawnFromWorld(axes.eye));
    this.reach = new Vector2(NEAR_SHARE * far, far);
    const camera = this.#camera;
    camera.matrixAutoUpdate = false;
    camera.matrix.fromArray(drawnFromCamera(axes));
    camera.projectionMatrix.fromArray(clipFromCamera(shot, this.reach.x, this.reach.y));
    camera.projectionMatrixInverse.copy(camera.projectionMatrix).invert();
    camera.updateMatrixWorld(true);
    this.clipFromDrawn.multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
  }

  get depth(): Texture | null {
    return this.#target?.depthTexture ?? null;
  }

  /** In units of the focal length; 0 where there is no depth picture. */
  get pixel(): number {
    const { shot } = this;
    return this.#target === null ? 0 : shot.width_px / this.#target.width / Math.min(...shot.focal_px);
  }

  /** The surfaces are others than they were. */
  lookAgain(): void {
    this.#isDue = true;
  }

  /** Draws what the photo sees first, where that is not known yet. */
  look(renderer: WebGLRenderer, surfaces: Scene): void {
    if (!this.#isDue) return;
    this.#isDue = false;
    this.#target ??= depthTarget(this.shot);
    const before = { target: renderer.getRenderTarget(), clears: renderer.autoClear };
    const { overrideMaterial } = surfaces;
    surfaces.overrideMaterial = DEPTH_ONLY;
    renderer.autoClear = true;
    renderer.setRenderTarget(this.#target);
    renderer.render(surfaces, this.#camera);
    renderer.setRenderTarget(before.target);
    renderer.autoClear = before.clears;
    surfaces.overrideMaterial = overrideMaterial;
  }

  dispose(): void {
    this.#target?.depthTexture?.dispose();
    this.#target?.dispose();
    this.#target = null;
  }
}

const DEPTH_ONLY = new MeshBasicMaterial({ side: DoubleSide, colorWrite: false });

function depthTarget({ width_px, height_px }: Shot): WebGLRenderTarget {
  const share = DEPTH_PX / Math.max(width_px, height_px);
  const [width, height] = [Math.ceil(share * width_px), Math.ceil(share * height_px)];
  const depthTexture = new DepthTexture(width, height, FloatType);
  depthTexture.minFilter = NearestFilter;
  depthTexture.magFilter = NearestFilter;
  return new WebGLRenderTarget(width, height, { depthTexture, generateMipmaps: false });
}
