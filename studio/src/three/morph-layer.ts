/** One of the two models of a transition, drawn into a picture of its own with its depth. */
import {
  BufferAttribute,
  BufferGeometry,
  DepthTexture,
  Mesh,
  NearestFilter,
  type PerspectiveCamera,
  Scene,
  type Texture,
  UnsignedIntType,
  type WebGLRenderer,
  WebGLRenderTarget,
} from "three";
import type { MorphLook, Station } from "../core/morph-walk.ts";
import { axesOf, drawnFromCamera } from "../core/pinhole.ts";
import { layerMaterial, layerUniforms, setLook } from "./morph-material.ts";
import type { EndModel } from "./morph-load.ts";

/** Where a picture without a model stands (m): about as far as the sky. */
const FAR_M = 1800;
/** Of a cylinder's picture. */
const STRIPS = 96;

export class MorphLayer {
  readonly target: WebGLRenderTarget;
  readonly #scene = new Scene();
  readonly #uniforms = layerUniforms();
  readonly #seen: Mesh;
  readonly #torn: Mesh;
  readonly #moving: Mesh;
  readonly #sheet: Mesh;
  #sheetOf: Station | null = null;

  constructor() {
    this.target = new WebGLRenderTarget(1, 1, { minFilter: NearestFilter, magFilter: NearestFilter });
    this.target.depthTexture = new DepthTexture(1, 1, UnsignedIntType);
    this.#seen = new Mesh(new BufferGeometry(), layerMaterial(this.#uniforms, "seen"));
    this.#torn = new Mesh(new BufferGeometry(), layerMaterial(this.#uniforms, "torn"));
    this.#moving = new Mesh(new BufferGeometry(), layerMaterial(this.#uniforms, "moving"));
    this.#sheet = new Mesh(new BufferGeometry(), layerMaterial(this.#uniforms, "seen"));
    for (const mesh of this.#all) {
      mesh.frustumCulled = false;
      mesh.matrixAutoUpdate = false;
      this.#scene.add(mesh);
    }
  }

  get #all(): readonly Mesh[] {
    return [this.#seen, this.#torn, this.#moving, this.#sheet];
  }

  /** What stands at a station: its model on the way to another, or its picture alone. */
  show(station: Station, model: EndModel | null, own: Texture | null, other: Texture | null, m: number, look: MorphLook): void {
    const matrix = drawnFromCamera(axesOf({ ...station, name: station.id }));
    for (const mesh of this.#all) mesh.matrix.fromArray(matrix);
    this.#seen.visible = this.#torn.visible = this.#moving.visible = model !== null && own !== null;
    this.#sheet.visible = model === null && own !== null;
    if (model !== null) {
      this.#seen.geometry = model.seen;
      this.#torn.geometry = model.torn;
      this.#moving.geometry = model.moving;
      for (const mesh of [this.#torn, this.#moving]) mesh.visible &&= mesh.geometry.hasAttribute("position");
    } else if (this.#sheetOf !== station) {
      this.#sheet.geometry.dispose();
      this.#sheet.geometry = sheet(station);
      this.#sheetOf = station;
    }
    this.#uniforms.m.value = model === null ? 0 : m;
    this.#uniforms.own.value = own;
    this.#uniforms.other.value = other ?? own;
    this.#uniforms.round.value = station.projection === "cylinder";
    setLook(this.#uniforms, look);
  }

  draw(renderer: WebGLRenderer, camera: PerspectiveCamera, width: number, height: number): void {
    if (this.target.width !== width || this.target.height !== height) this.target.setSize(width, height);
    renderer.setRenderTarget(this.target);
    renderer.setClearColor(0x000000, 0);
    renderer.clear();
    renderer.render(this.#scene, camera);
  }

  /** Of the picture that it draws and its depth. */
  get bytes(): number {
    return this.target.width * this.target.height * 8;
  }

  dispose(): void {
    this.target.depthTexture?.dispose();
    this.target.dispose();
    this.#sheet.geometry.dispose();
  }
}

/** The station's picture far away, on its plane or cylinder, in the frame of its camera (y up, looking along -z). */
function sheet({ width_px, height_px, focal_px, centre_px, projection }: Station): BufferGeometry {
  const strips = projection === "cylinder" ? STRIPS : 1;
  const [positions, uv, indices]: [number[], number[], number[]] = [[], [], []];
  for (let n = 0; n <= strips; n++) {
    const across = ((n / strips) * width_px - centre_px[0]) / focal_px[0];
    const [x, z] = projection === "cylinder" ? [Math.sin(across), -Math.cos(across)] : [across, -1];
    for (const v of [0, 1]) {
      const y = -(v * height_px - centre_px[1]) / focal_px[1];
      positions.push(x * FAR_M, y * FAR_M, z * FAR_M);
      uv.push(n / strips, v);
    }
    if (n < strips) indices.push(2 * n, 2 * n + 1, 2 * n + 2, 2 * n + 2, 2 * n + 1, 2 * n + 3);
  }
  const geometry = new BufferGeometry();
  const texture = new BufferAttribute(new Float32Array(uv), 2);
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(positions), 3));
  geometry.setAttribute("uv", texture);
  geometry.setAttribute("uvThere", texture);
  geometry.setAttribute("psi", new BufferAttribute(new Float32Array(uv.length / 2), 1));
  geometry.setAttribute("moved", new BufferAttribute(new Float32Array(positions.length), 3));
  geometry.setIndex(indices);
  return geometry;
}
