/**
 * The images that tiles name: each is fetched, decoded and given to the graphics card once, however
 * many tiles show it.
 */
import { LinearFilter, LinearMipmapLinearFilter, LoaderUtils, RepeatWrapping, type Texture, TextureLoader } from "three";
import type { GLTFLoaderPlugin, GLTFParser } from "three/examples/jsm/loaders/GLTFLoader.js";

const ANISOTROPY = 8;

interface Named {
  readonly images?: readonly { readonly uri?: string }[];
  readonly textures?: readonly { readonly source?: number }[];
}

export class SharedImages {
  readonly #known = new Map<string, Promise<Texture>>();
  readonly #loader = new TextureLoader();

  /** Takes over the textures of a file whose images lie beside it. */
  pluginOf(parser: GLTFParser): GLTFLoaderPlugin {
    return {
      name: "VEDUTA_shared_images",
      loadTexture: (number) => {
        const json = parser.json as Named;
        const uri = json.images?.[json.textures?.[number]?.source ?? -1]?.uri;
        if (uri === undefined || uri.startsWith("data:")) return null;
        return this.#shared(LoaderUtils.resolveURL(uri, parser.options.path));
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

  /** A texture of its own, of the image that all of them have. */
  async #shared(address: string): Promise<Texture> {
    let known = this.#known.get(address);
    if (known === undefined) {
      known = this.#loader.loadAsync(address);
      this.#known.set(address, known);
    }
    const texture = (await known).clone();
    texture.flipY = false;
    texture.wrapS = RepeatWrapping;
    texture.wrapT = RepeatWrapping;
    texture.magFilter = LinearFilter;
    texture.minFilter = LinearMipmapLinearFilter;
    texture.anisotropy = ANISOTROPY;
    return texture;
  }
}
