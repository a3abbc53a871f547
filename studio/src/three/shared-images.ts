/**
 * The images of models and tiles: each is fetched, decoded and given to the graphics card once, however
 * many show it. Images beside a file are known by their addresses, those inside by their digests, which
 * `formats/gltf_materials.py` names them by.
 */
import { ClampToEdgeWrapping, LinearFilter, LinearMipmapLinearFilter, LoaderUtils, RepeatWrapping, type Texture, TextureLoader } from "three";
import type { GLTFLoaderPlugin, GLTFParser } from "three/examples/jsm/loaders/GLTFLoader.js";

import { limited } from "./limited-image.ts";

const ANISOTROPY = 8;
const DIGEST = /^sha256-[0-9a-f]{64}$/;
/** As glTF numbers it. */
const CLAMP = 33_071;

interface Named {
  readonly images?: readonly { readonly uri?: string; readonly name?: string }[];
  readonly textures?: readonly { readonly source?: number; readonly sampler?: number }[];
  readonly samplers?: readonly { readonly wrapS?: number }[];
}

export class SharedImages {
  readonly #known = new Map<string, Promise<Texture>>();
  readonly #loader = new TextureLoader();
  readonly #most_px: number;

  /** Larger images are made smaller: their longest side. */
  constructor(most_px: number) {
    this.#most_px = most_px;
  }

  /** Takes over the textures of a file whose images lie beside it, or are named by their digests. */
  pluginOf(parser: GLTFParser): GLTFLoaderPlugin {
    return {
      name: "VEDUTA_shared_images",
      loadTexture: (number) => {
        const json = parser.json as Named;
        const told = json.textures?.[number];
        const source = told?.source ?? -1;
        const { uri, name } = json.images?.[source] ?? {};
        const isClamped = json.samplers?.[told?.sampler ?? -1]?.wrapS === CLAMP;
        if (uri !== undefined && !uri.startsWith("data:")) {
          const address = LoaderUtils.resolveURL(uri, parser.options.path);
          return this.#shared(address, isClamped, () => this.#loader.loadAsync(address));
        }
        if (uri !== undefined || name === undefined || !DIGEST.test(name)) return this.#own(parser, number, source);
        return this.#shared(name, isClamped, () => parser.loadImageSource(source, parser.textureLoader));
      },
    };
  }

  dispose(): void {
    for (const texture of this.#known.values()) {
      texture.then(
        (one) => one.dispose(),
        () => undefined,
      );
    }
  }

  /** An image that nobody else knows; null where the parser may load it as it is. */
  #own(parser: GLTFParser, number: number, source: number): Promise<Texture> | null {
    if (!Number.isFinite(this.#most_px)) return null;
    return parser.loadTextureImage(number, source, parser.textureLoader).then(async (texture) => await limited(texture, this.#most_px));
  }

  /** A texture of its own, of the image that all of them have. */
  async #shared(key: string, isClamped: boolean, load: () => Promise<Texture>): Promise<Texture> {
    let known = this.#known.get(key);
    if (known === undefined) {
      known = load().then(async (one) => await limited(one, this.#most_px));
      this.#known.set(key, known);
      // One that did not arrive is asked for again by the next that shows it.
      known.catch(() => this.#known.delete(key));
    }
    const texture = (await known).clone();
    texture.flipY = false;
    texture.wrapS = isClamped ? ClampToEdgeWrapping : RepeatWrapping;
    texture.wrapT = texture.wrapS;
    texture.magFilter = LinearFilter;
    texture.minFilter = LinearMipmapLinearFilter;
    texture.anisotropy = ANISOTROPY;
    return texture;
  }
}
