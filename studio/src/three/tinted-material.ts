/** Materials that show the tint of each feature, and the pixels of a texture that were invented. */
import { Color, type DataTexture, type IUniform, type Material, type Texture } from "three";
import { PROVENANCE_LOOKS } from "../core/classes.ts";
import { TINT_WIDTH } from "./feature-mesh.ts";

export interface Tinting {
  readonly tints: DataTexture;
  readonly mask: Texture | null;
  /** 0 hides the mask, 1 shows it; shared by all materials. */
  readonly maskStrength: IUniform<number>;
}

const INVENTED = new Color(PROVENANCE_LOOKS.invented.colour);

/** The tint keeps a part of the surface's own light and dark, so that shapes stay readable. */
export function addTint(material: Material, { tints, mask, maskStrength }: Tinting): void {
  material.onBeforeCompile = (shader) => {
    shader.uniforms.tints = { value: tints };
    shader.uniforms.inventedMask = { value: mask };
    shader.uniforms.maskStrength = maskStrength;
    shader.uniforms.inventedColour = { value: INVENTED };
    const masked = mask === null ? "" : "#define INVENTED_MASK\n";
    shader.vertexShader = shader.vertexShader
      .replace("#include <common>", `#include <common>\n${VERTEX_HEAD}`)
      .replace("#include <begin_vertex>", `#include <begin_vertex>\n${VERTEX_BODY}`);
    shader.fragmentShader = shader.fragmentShader
      .replace("#include <common>", `#include <common>\n${masked}${FRAGMENT_HEAD}`)
      .replace("#include <color_fragment>", `#include <color_fragment>\n${FRAGMENT_BODY}`);
  };
  material.customProgramCacheKey = () => `veduta-tint-${mask === null ? "plain" : "masked"}`;
}

const VERTEX_HEAD = `
  attribute float featureRow;
  uniform sampler2D tints;
  varying vec4 vTint;`;

const VERTEX_BODY = `
  int row = int(featureRow + 0.5);
  vTint = texelFetch(tints, ivec2(row % ${TINT_WIDTH}, row / ${TINT_WIDTH}), 0);`;

const FRAGMENT_HEAD = `
  varying vec4 vTint;
  #ifdef INVENTED_MASK
  uniform sampler2D inventedMask;
  uniform float maskStrength;
  uniform vec3 inventedColour;
  #endif`;

const FRAGMENT_BODY = `
  float ownLight = 0.45 + 0.75 * sqrt(dot(diffuseColor.rgb, vec3(0.2126, 0.7152, 0.0722)));
  vec4 tint = vTint;
  #ifdef INVENTED_MASK
  tint.rgb = mix(tint.rgb, inventedColour, maskStrength * texture2D(inventedMask, vMapUv).r);
  #endif
  diffuseColor.rgb = mix(diffuseColor.rgb, tint.rgb * ownLight, tint.a);`;
