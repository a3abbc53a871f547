/**
 * The shaders of a walk from view to view. `layerMaterial` draws a model at m of its way: its vertices by
 * equation (1) of Komodakis et al., its colours by (2). `mixMaterial` lays the two models of a
 * transition over one another, as `walk/build/render.py` does: the nearer surface is seen, and of one
 * surface that both show, more of the model that is nearer to the eye.
 */
import { DoubleSide, type IUniform, NoBlending, ShaderMaterial, type Texture } from "three";
import type { MorphLook } from "../core/morph-walk.ts";

/** A surface that is behind another by less than this share may be the same. */
const TOLERANCE = 0.3;
/** Of what spans a break in depth: it shows where nothing else does. */
const TORN_WEIGHT = 0.02;
/** Share of the way over which what hides a model, and its own breaks, come to count: before, its picture is seen. */
const ALONE = 0.12;
/** Of what is elsewhere in the other view, and the share of the way over which it is left behind. */
const MOVING_WEIGHT = 0.0004;
const LEAVE = 0.3;
/** Grey levels by which both pictures may differ where a surface lies in them, and what is left of the weight beyond. */
const DOUBT = 30;
const DOUBTED_WEIGHT = 0.05;
/** Levels of the pictures' smaller ones by which they are compared smoothed: 1.5 px. */
const SMOOTHED = 1.5;
/** What a triangle is of a model: a thing that was seen, a break in depth, or what moves. */
export type LayerKind = "seen" | "torn" | "moving";
const WEIGHTS: Readonly<Record<LayerKind, string>> = {
  seen: `mix(1.0, believed(), smoothstep(0.0, ${ALONE.toFixed(2)}, m))`,
  torn: `mix(1.0, ${TORN_WEIGHT.toFixed(3)}, smoothstep(0.0, ${ALONE.toFixed(2)}, m))`,
  moving: `pow(${MOVING_WEIGHT.toFixed(4)}, smoothstep(0.0, ${LEAVE.toFixed(2)}, m))`,
};
const LOOKS: Readonly<Record<MorphLook, number>> = { picture: 0, geometry: 1, psi: 2 };

export interface LayerUniforms {
  readonly m: IUniform<number>;
  readonly own: IUniform<Texture | null>;
  readonly other: IUniform<Texture | null>;
  readonly look: IUniform<number>;
  readonly round: IUniform<boolean>;
  [name: string]: IUniform;
}

export function layerUniforms(): LayerUniforms {
  return { m: { value: 0 }, own: { value: null }, other: { value: null }, look: { value: 0 }, round: { value: false } };
}

export function setLook(uniforms: LayerUniforms, look: MorphLook): void {
  uniforms.look.value = LOOKS[look];
}

export function layerMaterial(uniforms: LayerUniforms, kind: LayerKind): ShaderMaterial {
  return new ShaderMaterial({
    name: "walk-layer",
    uniforms,
    defines: kind === "moving" ? { MOVING: "" } : {},
    side: DoubleSide,
    blending: NoBlending,
    toneMapped: false,
    vertexShader: `
      uniform float m;
      uniform bool round;
      attribute vec3 moved;
      attribute vec2 uvThere;
      attribute float psi;
      varying vec3 vOwn;
      varying vec2 vThere;
      varying float vPsi;
      varying vec3 vSeen;
      void main() {
        // A picture lies on its surface as its camera threw it there: in proportion to the depth.
        float depth = max(round ? length(position.xz) : -position.z, 1e-3);
        vOwn = vec3(uv * depth, depth);
        vThere = uvThere;
        vPsi = psi;
        vec4 seen = modelViewMatrix * vec4(position + m * moved, 1.0);
        vSeen = seen.xyz;
        gl_Position = projectionMatrix * seen;
      }`,
    fragmentShader: `
      uniform float m;
      uniform float look;
      uniform sampler2D own;
      uniform sampler2D other;
      varying vec3 vOwn;
      varying vec2 vThere;
      varying float vPsi;
      varying vec3 vSeen;
      // A surface at the wrong depth lies in the other picture where that shows something else.
      float believed() {
        vec3 apart = texture2D(own, vOwn.xy / vOwn.z, ${SMOOTHED.toFixed(1)}).rgb - texture2D(other, vThere, ${SMOOTHED.toFixed(1)}).rgb;
        float share = dot(abs(apart), vec3(255.0 / 3.0)) / ${DOUBT.toFixed(1)};
        return mix(${DOUBTED_WEIGHT.toFixed(3)}, 1.0, exp(-share * share));
      }
      void main() {
        vec3 colour = mix(texture2D(own, vOwn.xy / vOwn.z).rgb, texture2D(other, vThere).rgb, m * vPsi);
        if (look > 1.5) {
          colour = mix(colour * 0.45, mix(vec3(0.95, 0.55, 0.25), vec3(0.2, 0.75, 0.65), vPsi), 0.45);
          #ifdef MOVING
          colour = mix(colour, vec3(0.9, 0.1, 0.1), 0.6);
          #endif
        } else if (look > 0.5) {
          vec3 normal = normalize(cross(dFdx(vSeen), dFdy(vSeen)));
          float light = 0.25 + 0.7 * abs(normal.z);
          float near = clamp(8.0 / -vSeen.z, 0.0, 1.0);
          colour = light * mix(vec3(0.45, 0.55, 0.7), vec3(0.95, 0.85, 0.7), near);
        }
        // The root of the weight: eight bits then have small ones, too.
        gl_FragColor = vec4(colour, sqrt(${WEIGHTS[kind]}));
      }`,
  });
}

export interface MixUniforms {
  readonly ownColour: IUniform<Texture | null>;
  readonly ownDepth: IUniform<Texture | null>;
  readonly otherColour: IUniform<Texture | null>;
  readonly otherDepth: IUniform<Texture | null>;
  readonly m: IUniform<number>;
  readonly near: IUniform<number>;
  readonly far: IUniform<number>;
  [name: string]: IUniform;
}

export function mixUniforms(near: number, far: number): MixUniforms {
  return {
    ownColour: { value: null },
    ownDepth: { value: null },
    otherColour: { value: null },
    otherDepth: { value: null },
    m: { value: 0 },
    near: { value: near },
    far: { value: far },
  };
}

export function mixMaterial(uniforms: MixUniforms): ShaderMaterial {
  return new ShaderMaterial({
    name: "walk-mix",
    uniforms,
    depthTest: false,
    depthWrite: false,
    blending: NoBlending,
    toneMapped: false,
    vertexShader: `
      varying vec2 vAt;
      void main() {
        vAt = uv;
        gl_Position = vec4(position.xy, 0.0, 1.0);
      }`,
    fragmentShader: `
      #include <packing>
      uniform sampler2D ownColour;
      uniform sampler2D ownDepth;
      uniform sampler2D otherColour;
      uniform sampler2D otherDepth;
      uniform float m;
      uniform float near;
      uniform float far;
      varying vec2 vAt;

      // The colour times its weight, and the weight.
      vec4 mixedAt(vec2 at) {
        vec4 own = texture2D(ownColour, at);
        vec4 other = texture2D(otherColour, at);
        own.a *= own.a;
        other.a *= other.a;
        float ownZ = -perspectiveDepthToViewZ(texture2D(ownDepth, at).r, near, far);
        float otherZ = -perspectiveDepthToViewZ(texture2D(otherDepth, at).r, near, far);
        ownZ = own.a > 0.0 ? ownZ : 1e6;
        otherZ = other.a > 0.0 ? otherZ : 1e6;
        float first = min(ownZ, otherZ);
        vec2 behind = vec2(ownZ - first, otherZ - first) / (first * ${TOLERANCE.toFixed(3)});
        // What spans a break in depth, or is left behind, hides nothing.
        vec2 solid = vec2(other.a, own.a);
        vec2 weight = vec2(own.a, other.a) * max(vec2(1.0 - m, m), vec2(1e-4))
          * exp(-min(behind * behind * solid * smoothstep(vec2(0.0), vec2(${ALONE.toFixed(2)}), vec2(m, 1.0 - m)), 60.0));
        return vec4(own.rgb * weight.x + other.rgb * weight.y, weight.x + weight.y);
      }

      void main() {
        vec4 sum = mixedAt(vAt);
        vec2 texel = 1.0 / vec2(textureSize(ownColour, 0));
        // A hole: what is seen around it closes over it.
        for (int ring = 0; ring < 7 && sum.a < 1e-9; ring++) {
          float radius = 2.0 * pow(1.9, float(ring));
          for (int k = 0; k < 12; k++) {
            float angle = 0.5236 * float(k);
            vec2 at = vAt + radius * texel * vec2(cos(angle), sin(angle));
            if (all(greaterThanEqual(at, vec2(0.0))) && all(lessThanEqual(at, vec2(1.0)))) sum += mixedAt(at);
          }
        }
        gl_FragColor = vec4(sum.a > 0.0 ? sum.rgb / sum.a : vec3(0.11, 0.12, 0.13), 1.0);
      }`,
  });
}
