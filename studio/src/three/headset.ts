/** Walking from view to view in a headset (WebXR): one picture for each eye, as the head is. */
import { WebGLRenderTarget, type WebGLRenderer } from "three";
import { pushOf } from "../core/headset.ts";
import type { StudioState } from "../core/state.ts";
import type { Store } from "../core/store.ts";
import type { Eye } from "./eyes.ts";
import { FAR_M, type MorphShow, NEAR_M } from "./morph-show.ts";

const LONGEST_FRAME_S = 0.1;

/** What the types of three leave out. */
type LentRenderer = WebGLRenderer & { setRenderTargetFramebuffer(target: WebGLRenderTarget, framebuffer: WebGLFramebuffer | null): void };

export class Headset {
  readonly #renderer: LentRenderer;
  readonly #morphs: Pick<MorphShow, "advance" | "drawEyes">;
  readonly #store: Store<StudioState>;
  readonly #onLeft: () => void;
  #session: XRSession | null = null;
  #asked = false;
  #before_ms: number | null = null;

  constructor(renderer: WebGLRenderer, morphs: Pick<MorphShow, "advance" | "drawEyes">, store: Store<StudioState>, onLeft: () => void) {
    this.#renderer = renderer as LentRenderer;
    this.#morphs = morphs;
    this.#store = store;
    this.#onLeft = onLeft;
  }

  /** Whether it draws; the page's own picture then stands still. */
  get isOn(): boolean {
    return this.#session !== null;
  }

  /** Into the headset; what to say where that does not go. */
  async enter(xr: Pick<XRSystem, "requestSession"> | undefined = navigator.xr): Promise<string | null> {
    if (this.isOn || this.#asked) return null;
    if (xr === undefined) return "There is no headset";
    this.#asked = true;
    try {
      const session = await xr.requestSession("immersive-vr");
      await this.#begin(session).catch(async (error: unknown) => {
        await session.end();
        throw error;
      });
      return null;
    } catch (error) {
      return `The headset cannot be used: ${error instanceof Error ? error.message : String(error)}`;
    } finally {
      this.#asked = false;
    }
  }

  async leave(): Promise<void> {
    await this.#session?.end();
  }

  async #begin(session: XRSession): Promise<void> {
    const gl = this.#renderer.getContext() as WebGL2RenderingContext;
    await gl.makeXRCompatible();
    const layer = new XRWebGLLayer(session, gl);
    // The depths of both models are compared by these: the headset's own pictures have them, too.
    await session.updateRenderState({ baseLayer: layer, depthNear: NEAR_M, depthFar: FAR_M });
    const space = await session.requestReferenceSpace("local");
    const target = new WebGLRenderTarget(layer.framebufferWidth, layer.framebufferHeight);
    this.#renderer.setRenderTargetFramebuffer(target, layer.framebuffer);
    session.addEventListener("select", () => this.#togglePlay());
    session.addEventListener("end", () => {
      this.#session = null;
      this.#before_ms = null;
      target.dispose();
      this.#onLeft();
    });
    this.#session = session;
    const frame = (now_ms: number, given: XRFrame): void => {
      if (this.#session !== session) return;
      session.requestAnimationFrame(frame);
      this.#advance(session, now_ms);
      const { morph } = this.#store.value;
      const pose = given.getViewerPose(space);
      if (pose !== undefined && morph !== null) this.#morphs.drawEyes(this.#renderer, morph, eyesOf(pose, layer), target);
    };
    session.requestAnimationFrame(frame);
  }

  #advance(session: XRSession, now_ms: number): void {
    const seconds = Math.min(LONGEST_FRAME_S, (now_ms - (this.#before_ms ?? now_ms)) / 1000);
    this.#before_ms = now_ms;
    const { morph } = this.#store.value;
    if (morph === null) return;
    const wish = { forward: pushOf(session.inputSources), run: false };
    const next = this.#morphs.advance(morph, wish, { left: 0, up: 0 }, seconds);
    if (next !== null) this.#store.update({ morph: next });
  }

  #togglePlay(): void {
    const { morph } = this.#store.value;
    if (morph !== null) this.#store.update({ morph: { ...morph, playing: !morph.playing } });
  }
}

function eyesOf({ views }: XRViewerPose, layer: XRWebGLLayer): Eye[] {
  return views.flatMap((view) => {
    const viewport = layer.getViewport(view);
    return viewport === undefined ? [] : [{ head: view.transform.matrix, projection: view.projectionMatrix, viewport }];
  });
}
