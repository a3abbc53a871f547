/**
 * What has come for a walk reaches the card and the page's thread a piece at a time: all at once, at a key
 * position, would be felt.
 */
import {
  BufferGeometry,
  type EventDispatcher,
  Mesh,
  OrthographicCamera,
  Scene,
  ShaderMaterial,
  type Texture,
  type WebGLRenderer,
  WebGLRenderTarget,
} from "three";

/** After each piece the page draws before the next one is read. */
const PAUSE_MS = 60;

const NOTHING = new BufferGeometry();

/** What textures and geometries have in common. */
type Disposed = EventDispatcher<{ dispose: object }>;

/** What has come, but is not on the card. */
export class HandingOver {
  readonly #fresh = new Set<Texture | BufferGeometry>();
  readonly #scene = new Scene();
  readonly #camera = new OrthographicCamera();
  readonly #target = new WebGLRenderTarget(1, 1, { depthBuffer: false });
  /** A triangle of it is drawn nowhere: three.js sends a geometry when it is drawn first, and not before. */
  readonly #mesh = new Mesh(
    NOTHING,
    new ShaderMaterial({
      vertexShader: "void main() { gl_Position = vec4(position.xy * 0.0 + 2.0, 2.0, 1.0); }",
      fragmentShader: "void main() { gl_FragColor = vec4(0.0); }",
    }),
  );

  constructor() {
    this.#mesh.frustumCulled = false;
    this.#scene.add(this.#mesh);
  }

  add(...pieces: readonly (Texture | BufferGeometry)[]): void {
    for (const piece of pieces) {
      this.#fresh.add(piece);
      (piece as Disposed).addEventListener("dispose", () => this.#fresh.delete(piece));
    }
  }

  get count(): number {
    return this.#fresh.size;
  }

  /** Gives one piece to the card; changes the renderer's target. */
  giveOne(renderer: Pick<WebGLRenderer, "initTexture" | "setRenderTarget" | "render">): void {
    const [next] = this.#fresh;
    if (next === undefined) return;
    this.#fresh.delete(next);
    if (next instanceof BufferGeometry) this.#send(renderer, next);
    else renderer.initTexture(next);
  }

  #send(renderer: Pick<WebGLRenderer, "setRenderTarget" | "render">, geometry: BufferGeometry): void {
    if (!geometry.hasAttribute("position")) return;
    const { start, count } = geometry.drawRange;
    geometry.setDrawRange(0, 3);
    this.#mesh.geometry = geometry;
    renderer.setRenderTarget(this.#target);
    renderer.render(this.#scene, this.#camera);
    geometry.setDrawRange(start, count);
    // What one has walked past is not to be held here.
    this.#mesh.geometry = NOTHING;
  }

  dispose(): void {
    this.#fresh.clear();
    this.#target.dispose();
    this.#mesh.material.dispose();
  }
}

/** It was let go of before it was read. */
export class Unwanted extends Error {}

/** Work that is done one after the other, with pauses in which the page draws. */
export class OneByOne {
  #last: Promise<void> = Promise.resolve();

  /** What nobody wants any more when its turn comes is not done, and has no pause after it. */
  async do<T>(work: () => Promise<T>, isWanted: () => boolean): Promise<T> {
    const before = this.#last;
    let release: () => void = () => undefined;
    this.#last = new Promise((resolve) => (release = resolve));
    await before;
    let pause_ms = 0;
    try {
      if (!isWanted()) throw new Unwanted();
      pause_ms = PAUSE_MS;
      return await work();
    } finally {
      setTimeout(release, pause_ms);
    }
  }
}
