/** What lies under a point of the canvas, and where a point of the world is on it. */
import { type PerspectiveCamera, Raycaster, Vector2, Vector3 } from "three";
import { isDrawnOnly } from "../core/classes.ts";
import { drawnFromWorld, worldFromDrawn } from "../core/frames.ts";
import type { FeatureRef, StudioState } from "../core/state.ts";
import { add, scale, type Vec3 } from "../core/vector.ts";
import type { Hit } from "./solid.ts";
import type { Stage, ViewerContent } from "./stage.ts";

/** Points of the canvas are in CSS pixels. */
export class Picker {
  readonly #canvas: HTMLCanvasElement;
  readonly #camera: PerspectiveCamera;
  readonly #solid: Stage["solid"];
  readonly #content: ViewerContent;
  readonly #state: () => StudioState;

  constructor(
    canvas: HTMLCanvasElement,
    camera: PerspectiveCamera,
    solid: Stage["solid"],
    content: ViewerContent,
    state: () => StudioState,
  ) {
    this.#canvas = canvas;
    this.#camera = camera;
    this.#solid = solid;
    this.#content = content;
    this.#state = state;
  }

  /** The visible surface there. */
  hitAt(x: number, y: number): Hit | null {
    const caster = new Raycaster();
    caster.setFromCamera(this.#onScreen(x, y), this.#camera);
    return this.#solid.firstHit(
      worldFromDrawn(caster.ray.origin.toArray()),
      worldFromDrawn(caster.ray.direction.toArray()),
      (feature) => this.#isVisible(feature),
    );
  }

  /** The ground there: a surface, else the level at a height (m); null towards the sky. */
  groundAt(x: number, y: number, height_m: number): Vec3 | null {
    const hit = this.hitAt(x, y);
    if (hit !== null) return hit.point;
    const caster = new Raycaster();
    caster.setFromCamera(this.#onScreen(x, y), this.#camera);
    const [origin, ahead] = [worldFromDrawn(caster.ray.origin.toArray()), worldFromDrawn(caster.ray.direction.toArray())];
    const along = (height_m - origin[2]) / ahead[2];
    return along > 0 && Number.isFinite(along) ? add(origin, scale(ahead, along)) : null;
  }

  /** The photo whose pyramid is there. */
  shotAt(x: number, y: number): number | null {
    const { shot, off } = this.#state();
    if (shot !== null || off.has("cameras")) return null;
    return this.#content.frusta?.hit(this.#onScreen(x, y), this.#camera) ?? null;
  }

  /** Where a point of the world is; null behind the camera. */
  project(point: Vec3): { x: number; y: number } | null {
    const box = this.#canvas.getBoundingClientRect();
    const seen = new Vector3(...drawnFromWorld(point)).project(this.#camera);
    if (seen.z > 1) return null;
    return { x: ((seen.x + 1) / 2) * box.width, y: ((1 - seen.y) / 2) * box.height };
  }

  #onScreen(x: number, y: number): Vector2 {
    const box = this.#canvas.getBoundingClientRect();
    return new Vector2((2 * x) / box.width - 1, 1 - (2 * y) / box.height);
  }

  #isVisible(ref: FeatureRef): boolean {
    const { town, parts } = this.#content;
    const part = parts[ref.part];
    const kind = town === null ? (part?.table.rows[ref.row]?.class ?? null) : town.classOf(ref);
    const layer = town === null ? (part?.part.layer ?? null) : "model";
    const { hidden, off } = this.#state();
    return kind !== null && !isDrawnOnly(kind) && !hidden.has(kind) && (layer === null || !off.has(layer));
  }
}
