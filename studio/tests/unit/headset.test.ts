/** Walking in a headset, with a made-up one: what it is asked for, and where its eyes are. */
import { Matrix4, Quaternion, Vector3, type WebGLRenderer } from "three";
import { afterEach, describe, expect, it, vi } from "vitest";
import { headsetIsThere, pushOf } from "../../src/core/headset.ts";
import type { MorphState } from "../../src/core/morph-walk.ts";
import type { StudioState } from "../../src/core/state.ts";
import { Store } from "../../src/core/store.ts";
import { type Eye, eyeCamera, levelAt } from "../../src/three/eyes.ts";
import { Headset } from "../../src/three/headset.ts";

const MORPH: MorphState = { which: 0, at: 0.5, playing: false, look: "picture", instant: false };
const IDENTITY = new Float32Array(new Matrix4().elements);

/** A headset of two eyes, 6 cm apart, whose frames come when they are asked for. */
function madeUp() {
  const events = new Map<string, () => void>();
  let next: ((now: number, frame: unknown) => void) | null = null;
  const views = [-0.03, 0.03].map((x) => ({ transform: { matrix: new Float32Array(new Matrix4().makeTranslation(x, 0, 0).elements) }, projectionMatrix: IDENTITY }));
  const session = {
    inputSources: [] as { gamepad: { axes: number[] } }[],
    updateRenderState: vi.fn(async () => await Promise.resolve()),
    requestReferenceSpace: vi.fn(async () => await Promise.resolve({})),
    addEventListener: (name: string, act: () => void) => events.set(name, act),
    requestAnimationFrame: (draw: typeof next) => (next = draw),
    end: vi.fn(async () => {
      events.get("end")?.();
      await Promise.resolve();
    }),
  };
  class Layer {
    framebuffer = null;
    framebufferWidth = 200;
    framebufferHeight = 100;
    getViewport(view: unknown): Eye["viewport"] {
      return { x: 100 * views.indexOf(view as (typeof views)[0]), y: 0, width: 100, height: 100 };
    }
  }
  vi.stubGlobal("XRWebGLLayer", Layer);
  const xr = { requestSession: vi.fn(async () => await Promise.resolve(session)) } as unknown as XRSystem;
  const frame = (now: number): void => next?.(now, { getViewerPose: () => ({ views }) });
  return { xr, session, frame, fire: (name: string) => events.get(name)?.() };
}

function rig() {
  const store = new Store({ morph: MORPH } as StudioState);
  const renderer = {
    getContext: () => ({ makeXRCompatible: async () => await Promise.resolve() }),
    setRenderTargetFramebuffer: vi.fn(),
  } as unknown as WebGLRenderer;
  const drawEyes = vi.fn();
  const advance = vi.fn((state: MorphState, wish: { forward: number }, _: unknown, seconds: number) =>
    wish.forward === 0 ? null : { ...state, at: state.at + wish.forward * seconds },
  );
  const onLeft = vi.fn();
  return { store, drawEyes, onLeft, headset: new Headset(renderer, { drawEyes, advance }, store, onLeft) };
}

afterEach(() => vi.unstubAllGlobals());

describe("a headset on a walk", () => {
  it("is offered where the device has it, and nowhere else", async () => {
    expect(await headsetIsThere({ isSessionSupported: async () => await Promise.resolve(true) })).toBe(true);
    expect(await headsetIsThere({ isSessionSupported: async () => await Promise.resolve(false) })).toBe(false);
    expect(await headsetIsThere({ isSessionSupported: async () => await Promise.reject(new Error("framed")) })).toBe(false);
    vi.stubGlobal("navigator", {});
    expect(await headsetIsThere()).toBe(false);
  });

  it("reads the stick that is pushed furthest, and no trembling", () => {
    expect(pushOf([])).toBe(0);
    expect(pushOf([{ gamepad: { axes: [0, 0, 0, -0.1] } }, { gamepad: null }])).toBe(0);
    expect(pushOf([{ gamepad: { axes: [0, 0, 0, -0.4] } }, { gamepad: { axes: [0, 0.9] } }])).toBeCloseTo(-0.9);
  });

  it("draws both eyes of each frame, walks by the stick, and gives the page back at the end", async () => {
    const { xr, session, frame, fire } = madeUp();
    const { store, drawEyes, onLeft, headset } = rig();
    expect(await headset.enter(xr)).toBeNull();
    expect(headset.isOn).toBe(true);
    frame(1000);
    const [, state, eyes, target] = drawEyes.mock.calls[0] as [unknown, MorphState, Eye[], { width: number }];
    expect(state.at).toBe(0.5);
    expect(eyes.map(({ viewport }) => viewport.x)).toEqual([0, 100]);
    expect(target.width).toBe(200);
    session.inputSources.push({ gamepad: { axes: [0, 0, 0, -1] } });
    frame(1050);
    expect(store.value.morph?.at).toBeCloseTo(0.55);
    frame(9000); // asleep: no leap
    expect(store.value.morph?.at).toBeCloseTo(0.65);
    fire("select");
    expect(store.value.morph?.playing).toBe(true);
    await headset.leave();
    expect(headset.isOn).toBe(false);
    expect(onLeft).toHaveBeenCalledOnce();
    const drawn = drawEyes.mock.calls.length;
    frame(9050);
    expect(drawEyes.mock.calls.length).toBe(drawn);
  });

  it("says why it cannot be used, and lets go of it", async () => {
    const { headset } = rig();
    vi.stubGlobal("navigator", {});
    expect(await headset.enter(undefined)).toBe("There is no headset");
    const refusing = { requestSession: async () => await Promise.reject(new Error("in use")) } as unknown as XRSystem;
    expect(await headset.enter(refusing)).toBe("The headset cannot be used: in use");
    const { xr, session } = madeUp();
    session.requestReferenceSpace.mockRejectedValueOnce(new Error("no floor"));
    expect(await headset.enter(xr)).toBe("The headset cannot be used: no floor");
    expect(session.end).toHaveBeenCalledOnce();
    expect(headset.isOn).toBe(false);
  });

  it("keeps the horizon level and the eyes on both sides of the place where one is", () => {
    const turn = new Quaternion().setFromAxisAngle(new Vector3(0, 1, 0), 0.7).multiply(new Quaternion().setFromAxisAngle(new Vector3(1, 0, 0), 0.3));
    const base = levelAt(new Vector3(4, 1.6, -9), turn);
    const [x, y, z] = [0, 1, 2].map((column) => new Vector3().setFromMatrixColumn(base, column));
    expect(y?.distanceTo(new Vector3(0, 1, 0))).toBeLessThan(1e-6);
    expect(z?.distanceTo(new Vector3(Math.sin(0.7), 0, Math.cos(0.7)))).toBeLessThan(1e-6);
    const head = new Float32Array(new Matrix4().makeTranslation(0.03, 0, 0).elements);
    const eye = eyeCamera(base, { head, projection: IDENTITY, viewport: { x: 0, y: 0, width: 1, height: 1 } });
    const at = new Vector3().setFromMatrixPosition(eye.matrixWorld);
    expect(at.distanceTo(new Vector3(4, 1.6, -9).addScaledVector(x ?? new Vector3(), 0.03))).toBeLessThan(1e-6);
    expect(new Matrix4().multiplyMatrices(eye.matrixWorld, eye.matrixWorldInverse).elements.every((v, n) => Math.abs(v - (n % 5 === 0 ? 1 : 0)) < 1e-6)).toBe(true);
  });
});
