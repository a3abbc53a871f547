/** Sun, sky and ground: calm daylight that leaves the photo's colours as they are. */
import {
  BackSide,
  type Box3,
  Color,
  DirectionalLight,
  Group,
  HemisphereLight,
  Mesh,
  PlaneGeometry,
  ShaderMaterial,
  ShadowMaterial,
  SphereGeometry,
  Vector3,
  Vector4,
} from "three";
import { drawnFromWorld } from "../core/frames.ts";
import type { Box } from "../core/framing.ts";
import type { Vec3 } from "../core/vector.ts";
import { GROUND_LOOK, HORIZON } from "./ground-material.ts";

/** To the sun, world frame: a spring afternoon, from the street's side (facades look south). */
const TO_SUN: Vec3 = [-0.72, -0.62, 0.66];
const SUN_STRENGTH = 3.1;
const SKY_STRENGTH = 2.05;
const SKY_LIGHT = new Color("#e3edf7");
const GROUND_LIGHT = new Color("#d8d0c2");
const ZENITH = new Color("#7ea6c9");
const SUN_GLOW = new Color("#fff3dc");
const GROUND = new Color("#cfccc4");
/** Radius of the ground; beyond, the sky's lower half has the same colour as the horizon. */
const GROUND_RADIUS_M = 3000;
/** Just under the buildings' own bases, which lie at zero. */
const GROUND_HEIGHT_M = -0.012;
/** Where the place has a ground of its own: between the lowest lots and that ground's end. */
const UNDER_GROUND_M = -0.04;
/** Buildings beyond this number get no darkening of the ground along their walls. */
const MOST_FOOTPRINTS = 24;

export interface Scenery {
  readonly group: Group;
  readonly sun: DirectionalLight;
  /** Keeps the sky around the camera. */
  follow(camera: { readonly position: Vector3 }): void;
  /** Lets the sun's shadows fall around a place of the drawn frame. */
  shadeAround(centre: Vector3, radius_m: number): void;
}

/**
 * `footprints` are the boxes of the buildings in the drawn frame; `hasGround` says whether the place
 * has a ground of its own. `scaleKnown`: the ground gets lines a metre apart, which would say
 * something false of a place of unknown scale.
 */
export function makeScenery(
  bounds: Box,
  footprints: readonly Box3[],
  { hasGround, scaleKnown }: { hasGround: boolean; scaleKnown: boolean },
): Scenery {
  const height_m = hasGround ? UNDER_GROUND_M : GROUND_HEIGHT_M;
  const group = new Group();
  const sky = makeSky();
  const sun = makeSun(bounds);
  // A sky light instead of an environment map: the surfaces are matt, and the map's filtering took
  // most of the loading time without a graphics card.
  const skyLight = new HemisphereLight(SKY_LIGHT, GROUND_LIGHT, SKY_STRENGTH);
  const shade = makeGroundShadow(bounds, height_m);
  group.add(sky, makeGround(footprints, height_m, scaleKnown), shade, skyLight, sun, sun.target);
  return {
    group,
    sun,
    follow: (camera) => sky.position.copy(camera.position),
    shadeAround: (centre, radius_m) => {
      aimSun(sun, centre, radius_m);
      shade.position.set(centre.x, shade.position.y, centre.z);
    },
  };
}

function toSun(): Vector3 {
  return new Vector3(...drawnFromWorld(TO_SUN)).normalize();
}

function makeSky(): Mesh {
  const material = new ShaderMaterial({
    side: BackSide,
    depthWrite: false,
    uniforms: {
      horizon: { value: HORIZON },
      zenith: { value: ZENITH },
      glow: { value: SUN_GLOW },
      toSun: { value: toSun() },
    },
    vertexShader: `
      varying vec3 vDirection;
      void main() {
        vDirection = position;
        gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
      }`,
    fragmentShader: `
      uniform vec3 horizon, zenith, glow, toSun;
      varying vec3 vDirection;
      float dither(vec2 p) { return fract(sin(dot(p, vec2(12.9898, 78.233))) * 43758.5453) - 0.5; }
      void main() {
        vec3 d = normalize(vDirection);
        float height = clamp(d.y, 0.0, 1.0);
        vec3 colour = mix(horizon, zenith, pow(height, 0.62));
        float near = max(0.0, dot(d, toSun));
        colour = mix(colour, glow, 0.28 * pow(near, 6.0) + 0.5 * pow(near, 90.0));
        gl_FragColor = vec4(colour, 1.0);
        #include <colorspace_fragment>
        gl_FragColor.rgb += dither(gl_FragCoord.xy) / 255.0;
      }`,
  });
  const sky = new Mesh(new SphereGeometry(1500, 48, 24), material);
  sky.renderOrder = -2;
  sky.frustumCulled = false;
  return sky;
}

function makeSun(bounds: Box): DirectionalLight {
  const sun = new DirectionalLight("#fff6ea", SUN_STRENGTH);
  const { centre, radius } = sphereOf(bounds);
  sun.castShadow = true;
  aimSun(sun, centre, radius);
  // Nothing moves in a place: shadows are drawn again only when layers change.
  sun.shadow.autoUpdate = false;
  return sun;
}

/** Frames a sphere, with room for the shadows that fall in front of it. */
function aimSun(sun: DirectionalLight, centre: Vector3, radius: number): void {
  sun.position.copy(centre).addScaledVector(toSun(), 2 * radius);
  sun.target.position.copy(centre);
  sun.target.updateMatrixWorld();
  const camera = sun.shadow.camera;
  camera.left = -radius;
  camera.right = radius;
  camera.top = radius;
  camera.bottom = -radius;
  camera.near = 0.1;
  camera.far = 4 * radius;
  const size = radius > 25 ? 4096 : 2048;
  sun.shadow.mapSize.set(size, size);
  sun.shadow.bias = -0.0004;
  sun.shadow.normalBias = Math.min(0.06, (2 * radius) / size);
  sun.shadow.radius = 3;
  camera.updateProjectionMatrix();
  sun.shadow.needsUpdate = true;
}

function makeGround(footprints: readonly Box3[], height_m: number, scaleKnown: boolean): Mesh {
  const boxes = footprints
    .slice(0, MOST_FOOTPRINTS)
    .map(({ min, max }) => new Vector4(min.x, min.z, max.x, max.z));
  const material = new ShaderMaterial({
    defines: { FOOTPRINTS: boxes.length, LINES: scaleKnown ? 1 : 0 },
    uniforms: {
      ground: { value: GROUND },
      horizon: { value: HORIZON },
      footprints: { value: boxes },
    },
    vertexShader: `
      varying vec3 vWorld;
      void main() {
        vec4 world = modelMatrix * vec4(position, 1.0);
        vWorld = world.xyz;
        gl_Position = projectionMatrix * viewMatrix * world;
      }`,
    fragmentShader: GROUND_SHADER,
  });
  const ground = new Mesh(new PlaneGeometry(2 * GROUND_RADIUS_M, 2 * GROUND_RADIUS_M, 24, 24), material);
  ground.rotation.x = -Math.PI / 2;
  ground.position.y = height_m;
  ground.renderOrder = -1;
  return ground;
}

/** The ground, darker along the walls of buildings. */
const GROUND_SHADER = `
  uniform vec3 ground, horizon;
  #if FOOTPRINTS > 0
  uniform vec4 footprints[FOOTPRINTS];
  #endif
  varying vec3 vWorld;
  ${GROUND_LOOK}
  float dither(vec2 p) { return fract(sin(dot(p, vec2(12.9898, 78.233))) * 43758.5453) - 0.5; }
  void main() {
    float away = distance(vWorld, cameraPosition);
    #if LINES
    vec3 colour = paved(ground, vWorld, away);
    #else
    vec3 colour = ground;
    #endif
    #if FOOTPRINTS > 0
    float dark = 0.0;
    for (int i = 0; i < FOOTPRINTS; i++) {
      vec2 outside = max(footprints[i].xy - vWorld.xz, vWorld.xz - footprints[i].zw);
      float d = length(max(outside, 0.0));
      dark = max(dark, 0.34 * exp(-d / 0.55) + 0.16 * exp(-d / 3.0));
    }
    colour *= 1.0 - dark;
    #endif
    colour = hazed(colour, horizon, away);
    gl_FragColor = vec4(colour, 1.0);
    #include <colorspace_fragment>
    gl_FragColor.rgb += dither(gl_FragCoord.xy) / 255.0;
  }`;

function makeGroundShadow(bounds: Box, height_m: number): Mesh {
  const { centre, radius } = sphereOf(bounds);
  const material = new ShadowMaterial({ color: "#2b3442", opacity: 0.36, depthWrite: false });
  const plane = new Mesh(new PlaneGeometry(6 * radius, 6 * radius), material);
  plane.rotation.x = -Math.PI / 2;
  plane.position.set(centre.x, height_m + 0.004, centre.z);
  plane.receiveShadow = true;
  plane.renderOrder = -1;
  return plane;
}

/** In the drawn frame. */
function sphereOf(bounds: Box): { centre: Vector3; radius: number } {
  const min = new Vector3(...drawnFromWorld(bounds.min));
  const max = new Vector3(...drawnFromWorld(bounds.max));
  return {
    centre: min.clone().add(max).multiplyScalar(0.5),
    radius: Math.max(1, 0.5 * min.distanceTo(max)),
  };
}
