/** Draws a walk from view to view: two models, each with both pictures, laid over one another. */
import {
  Euler,
  Matrix4,
  Mesh,
  OrthographicCamera,
  PerspectiveCamera,
  PlaneGeometry,
  Quaternion,
  Scene,
  Vector2,
  Vector3,
  type Texture,
  type WebGLRenderer,
  type WebGLRenderTarget,
} from "three";
import { heightToCover, type MorphState, type MorphWalk, nearestStation, placeOn, reachOf, type Station, walkedOn } from "../core/morph-walk.ts";
import { axesOf, drawnFromCamera } from "../core/pinhole.ts";
import type { Wishes } from "../core/wishes.ts";
import { type Eye, eyeCamera, levelAt } from "./eyes.ts";
import { MorphFiles, type WayModels } from "./morph-load.ts";
import { MorphLayer } from "./morph-layer.ts";
import { mixMaterial, mixUniforms } from "./morph-material.ts";

export const NEAR_M = 0.3;
export const FAR_M = 4000;
/** Looking aside: no further than there are pictures, by and large (the least, rad). */
const LEAST_YAW = 1.4;
const MOST_PITCH = 0.9;
const TURN_RAD_S = 0.8;
const RUN = 3;

/** calls, triangles: of the last frame. held: models of transitions; waiting: on their way. bytes: on the card. */
export interface StrollCost {
  readonly calls: number;
  readonly triangles: number;
  readonly held: number;
  readonly waiting: number;
  readonly bytes: number;
}

/** Where one is: m of the way from the start to the end; shown: the same, where it is cut 0 or 1. */
interface Between {
  readonly start: Station;
  readonly end: Station;
  readonly m: number;
  readonly shown: number;
  readonly models: WayModels | null;
  readonly pictures: readonly [Texture | null, Texture | null];
}

interface Size {
  readonly width: number;
  readonly height: number;
}

export class MorphShow {
  readonly #walks: readonly MorphWalk[];
  readonly #files: readonly MorphFiles[];
  readonly #camera = new PerspectiveCamera(40, 1, NEAR_M, FAR_M);
  readonly #own = new MorphLayer();
  readonly #other = new MorphLayer();
  readonly #mix = mixUniforms(NEAR_M, FAR_M);
  readonly #screen = new Scene();
  readonly #flat = new OrthographicCamera(-1, 1, 1, -1, 0, 1);
  #drawn = { calls: 0, triangles: 0 };
  #yaw = 0;
  #pitch = 0;

  constructor(walks: readonly MorphWalk[], manifest: URL, most_px: number, onArrival: () => void, wishes: Wishes) {
    this.#walks = walks;
    this.#files = walks.map((walk) => new MorphFiles(walk, manifest, most_px, onArrival, wishes));
    const plane = new Mesh(new PlaneGeometry(2, 2), mixMaterial(this.#mix));
    plane.frustumCulled = false;
    this.#screen.add(plane);
  }

  /** Until what one sees first is there. */
  async settle(state: MorphState): Promise<void> {
    await this.#files[state.which]?.settle(state.at);
  }

  cost(which: number): StrollCost {
    const files = this.#files[which];
    const bytes = (files?.bytes ?? 0) + this.#own.bytes + this.#other.bytes;
    return { ...this.#drawn, held: files?.held ?? 0, waiting: files?.waiting ?? 0, bytes };
  }

  /** In the drawn frame. */
  get camera(): PerspectiveCamera {
    return this.#camera;
  }

  look(left: number, up: number): void {
    const widest = Math.max(0, ...this.#walks.flatMap(({ stations }) => stations.slice(0, 1).map(reachOf)));
    this.#yaw = clamp(this.#yaw + left, Math.max(LEAST_YAW, widest));
    this.#pitch = clamp(this.#pitch + up, MOST_PITCH);
  }

  lookAhead(): void {
    this.#yaw = 0;
    this.#pitch = 0;
  }

  /** After so many seconds; null where nothing changes. */
  advance(
    state: MorphState,
    wish: { readonly forward: number; readonly run: boolean },
    turn: { readonly left: number; readonly up: number },
    seconds: number,
  ): MorphState | null {
    const walk = this.#walks[state.which];
    if (walk === undefined) return null;
    this.look(turn.left * TURN_RAD_S * seconds, turn.up * TURN_RAD_S * seconds);
    const steered = wish.forward !== 0;
    const pace = walk.speed_m_s * (steered ? wish.forward * (wish.run ? RUN : 1) : state.playing ? 1 : 0);
    if (pace === 0) return turn.left === 0 && turn.up === 0 ? null : { ...state };
    const at = walkedOn(walk, state.at, pace * seconds, this.#yaw);
    const ended = at === state.at;
    return { ...state, at, playing: state.playing && !steered && !ended };
  }

  draw(renderer: WebGLRenderer, state: MorphState): void {
    const between = this.#between(state);
    if (between === null) return;
    const { x, y } = renderer.getDrawingBufferSize(new Vector2());
    this.#aim(between, x / y);
    this.#drawn = { calls: 0, triangles: 0 };
    this.#paint(renderer, between, state, this.#camera, { width: x, height: y });
    this.#files[state.which]?.handOver(renderer);
    renderer.setRenderTarget(null);
    this.#lay(renderer, between);
  }

  /** The same for each eye of a headset, into the parts of its picture. */
  drawEyes(renderer: WebGLRenderer, state: MorphState, eyes: readonly Eye[], target: WebGLRenderTarget): void {
    const between = this.#between(state);
    if (between === null) return;
    this.#aim(between, 1);
    const base = levelAt(this.#camera.position, poseBetween(between).turn);
    this.#drawn = { calls: 0, triangles: 0 };
    for (const eye of eyes) {
      const { x, y, width, height } = eye.viewport;
      this.#paint(renderer, between, state, eyeCamera(base, eye), { width, height });
      target.viewport.set(x, y, width, height);
      target.scissor.set(x, y, width, height);
      renderer.setRenderTarget(target);
      this.#lay(renderer, between);
    }
    this.#files[state.which]?.handOver(renderer);
    renderer.setRenderTarget(null);
  }

  /** Where one is; null where there is nothing. */
  #between(state: MorphState): Between | null {
    const walk = this.#walks[state.which];
    const files = this.#files[state.which];
    if (walk === undefined || files === undefined) return null;
    const at = state.instant ? nearestStation(walk, state.at) : state.at;
    files.follow(at);
    const { transition, m } = placeOn(walk, at);
    const way = walk.transitions[transition];
    const [start, end] = [walk.stations[way?.start ?? 0], walk.stations[way?.end ?? 0]];
    if (start === undefined || end === undefined) return null;
    const pictures = [files.picture(way?.start ?? 0), files.picture(way?.end ?? 0)] as const;
    return { start, end, m, shown: way?.kind === "cut" ? Math.round(m) : m, models: files.way(transition), pictures };
  }

  /** Both models, each into a picture of its own. */
  #paint(renderer: WebGLRenderer, between: Between, { look }: MorphState, camera: PerspectiveCamera, size: Size): void {
    const { start, end, m, models, pictures: [own, other] } = between;
    this.#own.show(start, models?.forth ?? null, own, other, m, look);
    this.#other.show(end, models?.back ?? null, other, own, 1 - m, look);
    const before = renderer.autoClear;
    renderer.autoClear = false;
    for (const layer of [this.#own, this.#other]) {
      layer.draw(renderer, camera, size.width, size.height);
      this.#count(renderer);
    }
    renderer.autoClear = before;
  }

  /** One over the other, into what is to be seen. */
  #lay(renderer: WebGLRenderer, { shown }: Between): void {
    this.#mix.ownColour.value = this.#own.target.texture;
    this.#mix.ownDepth.value = this.#own.target.depthTexture;
    this.#mix.otherColour.value = this.#other.target.texture;
    this.#mix.otherDepth.value = this.#other.target.depthTexture;
    this.#mix.m.value = shown;
    const before = renderer.autoClear;
    renderer.autoClear = false;
    renderer.render(this.#screen, this.#flat);
    this.#count(renderer);
    renderer.autoClear = before;
  }

  #count({ info: { render } }: WebGLRenderer): void {
    this.#drawn.calls += render.calls;
    this.#drawn.triangles += render.triangles;
  }

  dispose(): void {
    for (const files of this.#files) files.dispose();
    this.#own.dispose();
    this.#other.dispose();
  }

  /** Between the two cameras, turned as the person looks; the picture covers the canvas. */
  #aim(between: Between, aspect: number): void {
    const { eye, turn } = poseBetween(between);
    this.#camera.position.copy(eye);
    const aside = new Quaternion().setFromEuler(new Euler(this.#pitch, this.#yaw, 0, "YXZ"));
    this.#camera.quaternion.copy(turn).multiply(aside);
    this.#camera.fov = (heightToCover(between.start, aspect) * 180) / Math.PI;
    this.#camera.aspect = aspect;
    this.#camera.updateProjectionMatrix();
    this.#camera.updateMatrixWorld();
  }
}

function poseBetween({ start, end, shown }: Between): { eye: Vector3; turn: Quaternion } {
  const [from, to] = [poseOf(start), poseOf(end)];
  return { eye: from.eye.lerp(to.eye, shown), turn: from.turn.slerp(to.turn, shown) };
}

function poseOf(station: Station): { eye: Vector3; turn: Quaternion } {
  const matrix = new Matrix4().fromArray(drawnFromCamera(axesOf({ ...station, name: station.id })));
  const [eye, turn] = [new Vector3(), new Quaternion()];
  matrix.decompose(eye, turn, new Vector3());
  return { eye, turn };
}

function clamp(value: number, most: number): number {
  return Math.min(most, Math.max(-most, value));
}
