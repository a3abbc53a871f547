/**
 * How the ground looks: paved, and pale in the distance. The plane around a place and the ground
 * that a place brings along share it, so that nobody sees where one ends.
 */
import { Color, type Material, type Mesh } from "three";

/** Changes with the hour: who draws it has this very colour. */
export const HORIZON = new Color("#e4eaee");

/** Paving lines of one and five metres give the eye a scale; they fade with distance. */
export const GROUND_LOOK = `
  float lines(vec2 p, float width) {
    vec2 blur = fwidth(p);
    vec2 toLine = abs(fract(p - 0.5) - 0.5);
    vec2 line = 1.0 - smoothstep(vec2(width), vec2(width) + 1.2 * blur, toLine);
    vec2 coverage = clamp(vec2(width) / max(blur, vec2(1e-5)), 0.0, 1.0);
    return max(line.x * coverage.x, line.y * coverage.y);
  }
  vec3 paved(vec3 colour, vec3 world, float away) {
    float fine = lines(world.xz, 0.012) * (1.0 - smoothstep(10.0, 40.0, away));
    float coarse = lines(world.xz / 5.0, 0.006) * (1.0 - smoothstep(30.0, 130.0, away));
    return colour * (1.0 - 0.09 * fine - 0.10 * coarse);
  }
  vec3 hazed(vec3 colour, vec3 horizon, float away) {
    return mix(colour, horizon, 1.0 - exp(-max(0.0, away - 30.0) / 260.0));
  }`;

/**
 * Makes a mesh ground: it throws no shadow, for it would be on itself alone. Where it has a picture,
 * lawn or cobbles, that gives the scale, and it gets no lines.
 */
export function layGround(mesh: Mesh): void {
  mesh.castShadow = false;
  for (const material of [mesh.material].flat()) pave(material);
}

function pave(material: Material): void {
  const before = material.onBeforeCompile.bind(material);
  const key = material.customProgramCacheKey();
  material.onBeforeCompile = (shader, renderer) => {
    before(shader, renderer);
    shader.uniforms.groundHorizon = { value: HORIZON };
    shader.vertexShader = shader.vertexShader
      .replace("#include <common>", "#include <common>\nvarying vec3 vGround;")
      .replace("#include <project_vertex>", `#include <project_vertex>
        vGround = (modelMatrix * vec4(transformed, 1.0)).xyz;`);
    shader.fragmentShader = shader.fragmentShader
      .replace("#include <common>", `#include <common>\nvarying vec3 vGround;\nuniform vec3 groundHorizon;\n${GROUND_LOOK}`)
      .replace("#include <color_fragment>", `#include <color_fragment>
        float groundAway = distance(vGround, cameraPosition);
        #ifndef USE_MAP
        diffuseColor.rgb = paved(diffuseColor.rgb, vGround, groundAway);
        #endif`)
      .replace("#include <colorspace_fragment>", `
        gl_FragColor.rgb = hazed(gl_FragColor.rgb, groundHorizon, groundAway);
        #include <colorspace_fragment>`);
  };
  material.customProgramCacheKey = () => `${key} ground`;
  material.needsUpdate = true;
}
