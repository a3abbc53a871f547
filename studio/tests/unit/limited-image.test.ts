import { Texture } from "three";
import { afterEach, describe, expect, it, vi } from "vitest";
import { limited, sizeWithin } from "../../src/three/limited-image.ts";

afterEach(() => vi.unstubAllGlobals());

/** A picture of a size; the second says whether it was let go. */
function picture(width: number, height: number): { image: ImageBitmap; close: ReturnType<typeof vi.fn> } {
  const close = vi.fn();
  return { image: { width, height, close }, close };
}

describe("a picture for a machine with little memory", () => {
  it("keeps its proportions", () => {
    expect(sizeWithin(4000, 1000, 2048)).toEqual({ width: 2048, height: 512 });
    expect(sizeWithin(1000, 4000, 2000)).toEqual({ width: 500, height: 2000 });
    expect(sizeWithin(300, 200, 2048)).toEqual({ width: 300, height: 200 });
    expect(sizeWithin(9000, 1, 2048)).toEqual({ width: 2048, height: 1 });
    expect(sizeWithin(9000, 3000, Infinity)).toEqual({ width: 9000, height: 3000 });
  });

  it("is made smaller before it is sent, and the large one is let go", async () => {
    const { image, close } = picture(4096, 2048);
    vi.stubGlobal("createImageBitmap", (_: unknown, { resizeWidth, resizeHeight }: ImageBitmapOptions) =>
      Promise.resolve({ width: resizeWidth, height: resizeHeight }),
    );
    const texture = await limited(new Texture(image), 1024);
    expect(texture.image).toEqual({ width: 1024, height: 512 });
    expect(close).toHaveBeenCalledOnce();
  });

  it("is left as it is where it is small enough, or nothing is asked", async () => {
    for (const most of [4096, Infinity]) {
      const { image, close } = picture(4096, 2048);
      expect((await limited(new Texture(image), most)).image).toBe(image);
      expect(close).not.toHaveBeenCalled();
    }
  });
});
