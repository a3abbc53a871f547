/**
 * Photos thrown onto surfaces as by slide projectors (projective texture mapping). A surface takes the
 * light of a photo where it lies in the photo's picture, turns the same side to the photo as to the
 * visitor, and nothing stands between: the photo's own depth picture tells.
 */

/** Photos that lie on the surfaces at once. */
export const SLOTS = 4;

export const PROJECTION_VERTEX = `
  varying vec3 vWorld;
  void main() {
    #include <begin_vertex>
    #include <project_vertex>
    vec4 world = vec4(transformed, 1.0);
    #ifdef USE_INSTANCING
    world = instanceMatrix * world;
    #endif
    vWorld = (modelMatrix * world).xyz;
  }`;

/**
 * `reach` has near and far of the depth picture; `pixel` the size of its pixels in units of the focal
 * length (0: there is none, and nothing hides the surface). Levels say how far each photo has faded
 * in, shares how they part the surface between them.
 */
export const PROJECTION_FRAGMENT = `
  varying vec3 vWorld;
  uniform mat4 clipFromDrawn[${SLOTS}];
  uniform vec3 eyes[${SLOTS}];
  uniform vec2 reach[${SLOTS}];
  uniform float pixel[${SLOTS}];
  uniform float levels[${SLOTS}];
  uniform float shares[${SLOTS}];
  uniform float feather[${SLOTS}];
  ${perSlot((k) => `uniform sampler2D photo${k}; uniform sampler2D depth${k};`)}

  float depthAt(sampler2D depths, vec2 uv, vec2 nearFar) {
    float d = texture2D(depths, uv).r;
    return nearFar.x * nearFar.y / (nearFar.y - d * (nearFar.y - nearFar.x));
  }

  // The share of nine samples at which the surface is the first that the photo sees.
  float shownTo(sampler2D depths, vec2 uv, vec2 nearFar, float away, float cosine, float size) {
    float slope = min(10.0, sqrt(1.0 - cosine * cosine) / max(cosine, 1e-3));
    float slack = away * (0.002 + 2.0 * size * slope);
    vec2 texel = 1.0 / vec2(textureSize(depths, 0));
    float shown = 0.0;
    for (int i = -1; i <= 1; i++) {
      for (int j = -1; j <= 1; j++) {
        shown += step(away, depthAt(depths, uv + vec2(i, j) * texel, nearFar) + slack);
      }
    }
    return shown / 9.0;
  }

  float within(vec2 uv, float border) {
    vec2 room = min(uv, 1.0 - uv);
    return smoothstep(0.0, border, min(room.x, room.y));
  }

  void main() {
    vec3 normal = normalize(cross(dFdx(vWorld), dFdy(vWorld)));
    if (dot(normal, cameraPosition - vWorld) < 0.0) normal = -normal;
    vec3 light = vec3(0.0);
    float weight = 0.0;
    float bare = 1.0;
    ${perSlot(
      (k) => `
    if (levels[${k}] > 0.0) {
      vec4 clip = clipFromDrawn[${k}] * vec4(vWorld, 1.0);
      vec2 uv = 0.5 + 0.5 * clip.xy / max(clip.w, 1e-6);
      vec3 way = eyes[${k}] - vWorld;
      float cosine = pixel[${k}] > 0.0 ? dot(normal, normalize(way)) : 1.0;
      float on = clip.w > 0.0 ? within(uv, feather[${k}]) * smoothstep(0.03, 0.12, cosine) : 0.0;
      vec3 colour = texture2D(photo${k}, uv).rgb;
      if (pixel[${k}] > 0.0 && on > 0.0) on *= shownTo(depth${k}, uv, reach[${k}], clip.w, cosine, pixel[${k}]);
      on *= levels[${k}];
      light += shares[${k}] * on * colour;
      weight += shares[${k}] * on;
      bare *= 1.0 - on;
    }`,
    )}
    if (weight <= 0.0) discard;
    gl_FragColor = vec4(light / weight, 1.0 - bare);
    #include <colorspace_fragment>
  }`;

function perSlot(text: (slot: number) => string): string {
  return Array.from({ length: SLOTS }, (_, slot) => text(slot)).join("\n");
}
