/** Sun, sky and ground, at an hour of the day. */
import {
  BackSide,
  type Box3,
  Color,
  DirectionalLight,
  Group,
  HemisphereLight,
  type IUniform,
  Mesh,
  PlaneGeometry,
  ShaderMaterial,
  ShadowMaterial,
  SphereGeometry,
  Vector3,
  Vector4,
} from "three";
import type { Budget } from "../core/budget.ts";
import { DAY_HOUR, type Daylight, daylightAt } from "../core/daylight.ts";
import { drawnFromWorld } from "../core/frames.ts";
import type { Box } from "../core/framing.ts";
import { GROUND_LOOK, HORIZON } from "./ground-material.ts";
import { skyLightAt } from "./sky-light.ts";

const SHADE = 0.36;
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
  /** Sets the sun, or the moon, and all colours; what of a picture's light there is then. */
  light(daylight: Daylight): Color;
}

/**
 * `footprints` are the boxes of the buildings in the drawn frame; `lowest_m` is how low the place's own
 * ground lies, null where it has none. `scaleKnown`: the ground gets lines a metre apart, which would
 * say something false of a place of unknown scale.
 */
export function makeScenery(
  bounds: Box,
  footprints: readonly Box3[],
  { lowest_m, scaleKnown }: { lowest_m: number | null; scaleKnown: boolean },
  budget: Pick<Budget, "shadowSide_px">,
): Scenery {
  const height_m = lowest_m === null ? GROUND_HEIGHT_M : Math.min(0, lowest_m) + UNDER_GROUND_M;
  const group = new Group();
  const toSun = new Vector3(...drawnFromWorld(daylightAt(DAY_HOUR).light.to));
  const toGlow = toSun.clone();
  const sky = makeSky(toGlow);
  const sun = makeSun();
  let shaded = sphereOf(bounds);
  const aimSun = (...aim: [DirectionalLight, Vector3, Vector3, number]): void => {
    aimShadow(...aim, budget.shadowSide_px(aim[3]));
  };
  aimSun(sun, toSun, shaded.centre, shaded.radius);
  // A sky light instead of an environment map: the surfaces are matt, and the map's filtering took
  // most of the loading time without a graphics card.
  const skyLight = new HemisphereLight();
  const shade = makeGroundShadow(bounds, height_m);
  const ground = makeGround(footprints, height_m, scaleKnown);
  group.add(sky, ground, shade, skyLight, sun, sun.target);
  const light = (daylight: Daylight): Color => {
    const look = skyLightAt(daylight);
    toSun.set(...drawnFromWorld(daylight.light.to));
    toGlow.set(...drawnFromWorld(daylight.glow.to));
    sun.color.copy(look.sun);
    sun.intensity = look.sunStrength;
    skyLight.color.copy(look.above);
    skyLight.groundColor.copy(look.below);
    skyLight.intensity = look.strength;
    HORIZON.copy(look.horizon);
    shade.material.opacity = SHADE * look.shade;
    (sky.material.uniforms.zenith as IUniform<Color>).value.copy(look.zenith);
    (sky.material.uniforms.glow as IUniform<Color>).value.copy(look.glow);
    (sky.material.uniforms.glowStrength as IUniform<number>).value = look.glowStrength;
    (ground.material.uniforms.light as IUniform<Color>).value.copy(look.ground);
    aimSun(sun, toSun, shaded.centre, shaded.radius);
    return look.picture;
  };
  light(daylightAt(DAY_HOUR));
  return {
    light,
    group,
    sun,
    follow: (camera) => sky.position.copy(camera.position),
    shadeAround: (centre, radius_m) => {
      shaded = { centre: centre.clone(), radius: radius_m };
      aimSun(sun, toSun, centre, radius_m);
      shade.position.set(centre.x, shade.position.y, centre.z);
    },
  };
}

function makeSky(toGlow: Vector3): Mesh<SphereGeometry, ShaderMaterial> {
  const material = new ShaderMaterial({
    side: BackSide,
    depthWrite: false,
    uniforms: {
      horizon: { value: HORIZON },
      zenith: { value: new Color() },
      glow: { value: new Color() },
      glowStrength: { value: 1 },
      toGlow: { value: toGlow },
    },
    vertexShader: `
      varying vec3 vDirection;
      void main() {
        vDirection = position;
        gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
      }`,
    fragmentShader: `
      uniform vec3 horizon, zenith, glow, toGlow;
      uniform float glowStrength;
      varying vec3 vDirection;
      float dither(vec2 p) { return fract(sin(dot(p, vec2(12.9898, 78.233))) * 43758.5453) - 0.5; }
      void main() {
        vec3 d = normalize(vDirection);
        float height = clamp(d.y, 0.0, 1.0);
        vec3 colour = mix(horizon, zenith, pow(height, 0.62));
        float near = max(0.0, dot(d, toGlow));
        colour = mix(colour, glow, glowStrength * (0.28 * pow(near, 6.0) + 0.5 * pow(near, 90.0)));
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

function makeSun(): DirectionalLight {
  const sun = new DirectionalLight();
  sun.castShadow = true;
  // Little moves in a place: shadows are drawn again when layers change, doors move or the sun does.
  sun.shadow.autoUpdate = false;
  return sun;
}

/** Frames a sphere, with room for the shadows that fall in front of it. */
function aimShadow(sun: DirectionalLight, toSun: Vector3, centre: Vector3, radius: number, size: number): void {
  sun.position.copy(centre).addScaledVector(toSun, 2 * radius);
  sun.target.position.copy(centre);
  sun.target.updateMatrixWorld();
  const camera = sun.shadow.camera;
  camera.left = -radius;
  camera.right = radius;
  camera.top = radius;
  camera.bottom = -radius;
  camera.near = 0.1;
  camera.far = 4 * radius;
  sun.shadow.mapSize.set(size, size);
  sun.shadow.bias = -0.0004;
  sun.shadow.normalBias = Math.min(0.06, (2 * radius) / size);
  sun.shadow.radius = 1; // wider, its samples show as dots
  camera.updateProjectionMatrix();
  sun.shadow.needsUpdate = true;
}

function makeGround(footprints: readonly Box3[], height_m: number, scaleKnown: boolean): Mesh<PlaneGeometry, ShaderMaterial> {
  const boxes = footprints
    .slice(0, MOST_FOOTPRINTS)
    .map(({ min, max }) => new Vector4(min.x, min.z, max.x, max.z));
  const material = new ShaderMaterial({
    defines: { FOOTPRINTS: boxes.length, LINES: scaleKnown ? 1 : 0 },
    uniforms: {
      ground: { value: GROUND },
      light: { value: new Color() },
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
  uniform vec3 ground, horizon, light;
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
    colour = hazed(colour * light, horizon, away);
    gl_FragColor = vec4(colour, 1.0);
    #include <colorspace_fragment>
    gl_FragColor.rgb += dither(gl_FragCoord.xy) / 255.0;
  }`;

function makeGroundShadow(bounds: Box, height_m: number): Mesh<PlaneGeometry, ShadowMaterial> {
  const { centre, radius } = sphereOf(bounds);
  const material = new ShadowMaterial({ color: "#2b3442", depthWrite: false });
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
