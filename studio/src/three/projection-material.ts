/** The material of surfaces on which photos lie. */
import { DataTexture, Matrix4, ShaderMaterial, type Side, type Texture, Vector2, Vector3 } from "three";
import { PROJECTION_FRAGMENT, PROJECTION_VERTEX, SLOTS } from "./projection-shader.ts";
import type { Projector } from "./projector.ts";

/** Shares of the photo over which it fades towards its border. */
const CHOSEN_BORDER = 0.002;
const PASSING_BORDER = 0.1;

/** One photo, as the material takes it. */
export interface Light {
  readonly projector: Projector;
  /** How far it has faded in, 0..1. */
  readonly level: number;
  readonly share: number;
  readonly border: number;
}

export function lightOf(projector: Projector | null, level: number, share: number, isChosen: boolean): Light | null {
  if (projector === null) return null;
  return { projector, level, share, border: isChosen ? CHOSEN_BORDER : PASSING_BORDER };
}

const NOTHING = new DataTexture(new Uint8Array(4), 1, 1);
NOTHING.needsUpdate = true;

/** Without photos: nothing of it is seen. It lies on what has been drawn, as near to it as goes. */
export function makeProjection(side: Side): ShaderMaterial {
  const each = <T>(value: () => T): { value: T[] } => ({ value: Array.from({ length: SLOTS }, value) });
  const textures = Object.fromEntries(
    Array.from({ length: SLOTS }, (_, k) => [`photo${k}`, `depth${k}`]).flat().map((name) => [name, { value: NOTHING }]),
  );
  return new ShaderMaterial({
    vertexShader: PROJECTION_VERTEX,
    fragmentShader: PROJECTION_FRAGMENT,
    uniforms: {
      clipFromDrawn: each(() => new Matrix4()),
      eyes: each(() => new Vector3()),
      reach: each(() => new Vector2(1, 2)),
      pixel: each(() => 0),
      levels: each(() => 0),
      shares: each(() => 0),
      feather: each(() => 1),
      ...textures,
    },
    side,
    transparent: true,
    forceSinglePass: true,
    depthWrite: false,
    polygonOffset: true,
    polygonOffsetFactor: -1,
    polygonOffsetUnits: -1,
    // The photos' colours as they are.
    toneMapped: false,
  });
}

export function setLights(material: ShaderMaterial, lights: readonly (Light | null)[]): void {
  const { uniforms } = material;
  for (let slot = 0; slot < SLOTS; slot += 1) {
    const light = lights[slot] ?? null;
    const set = (name: string, value: unknown): void => {
      const list = uniforms[name]?.value as unknown[];
      list[slot] = value;
    };
    const bind = (name: string, value: Texture): void => {
      const uniform = uniforms[`${name}${slot}`];
      if (uniform !== undefined) uniform.value = value;
    };
    set("levels", light?.level ?? 0);
    bind("photo", light?.projector.texture ?? NOTHING);
    bind("depth", light?.projector.depth ?? NOTHING);
    if (light === null) continue;
    const { projector } = light;
    set("clipFromDrawn", projector.clipFromDrawn);
    set("eyes", projector.eye);
    set("reach", projector.reach);
    set("pixel", projector.pixel);
    set("shares", light.share);
    set("feather", light.border);
  }
}
