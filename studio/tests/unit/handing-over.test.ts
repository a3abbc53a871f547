import { BufferAttribute, BufferGeometry, Texture } from "three";
import { describe, expect, it } from "vitest";
import { HandingOver, OneByOne, Unwanted } from "../../src/three/handing-over.ts";

const wanted = (): boolean => true;
type Renderer = Parameters<HandingOver["giveOne"]>[0];

const triangles = (): BufferGeometry => new BufferGeometry().setAttribute("position", new BufferAttribute(new Float32Array(27), 3));

/** Notes what it is given. */
function noting(): { renderer: Renderer; given: string[] } {
  const given: string[] = [];
  const renderer = {
    initTexture: (texture: Texture) => given.push(texture.name),
    setRenderTarget: () => undefined,
    render: (scene: { children: { geometry?: BufferGeometry }[] }) => {
      const geometry = scene.children[0]?.geometry;
      given.push(`${geometry?.name ?? ""} ${geometry?.drawRange.count ?? 0}`);
    },
  };
  return { renderer: renderer as unknown as Renderer, given };
}

describe("handing over what has come", () => {
  it("gives the card one piece at a time, of a geometry one triangle's drawing", () => {
    const [picture, surface] = [new Texture(), triangles()];
    [picture.name, surface.name] = ["picture", "surface"];
    const fresh = new HandingOver();
    fresh.add(picture, surface);
    const { renderer, given } = noting();
    fresh.giveOne(renderer);
    expect([given, fresh.count]).toEqual([["picture"], 1]);
    fresh.giveOne(renderer);
    fresh.giveOne(renderer);
    expect([given, fresh.count]).toEqual([["picture", "surface 3"], 0]);
    expect(surface.drawRange.count).toBe(Infinity);
  });

  it("lets go of what was disposed of before its turn", () => {
    const [picture, surface] = [new Texture(), triangles()];
    const fresh = new HandingOver();
    fresh.add(picture, surface);
    picture.dispose();
    surface.dispose();
    expect(fresh.count).toBe(0);
  });
});

describe("work one by one", () => {
  it("begins none before the one before is done, even where that fails", async () => {
    const line = new OneByOne();
    const told: string[] = [];
    let finish: () => void = () => undefined;
    const first = line.do(async () => {
      told.push("first begins");
      await new Promise<void>((resolve) => (finish = resolve));
      throw new Error("broken");
    }, wanted);
    const second = line.do(async () => await Promise.resolve(told.push("second begins")), wanted);
    await new Promise((resolve) => setTimeout(resolve, 5));
    expect(told).toEqual(["first begins"]);
    finish();
    await expect(first).rejects.toThrow("broken");
    await second;
    expect(told).toEqual(["first begins", "second begins"]);
  });
  it("leaves out what was let go of while it waited", async () => {
    const line = new OneByOne();
    let isWanted = true;
    let finish: () => void = () => undefined;
    const first = line.do(async () => await new Promise<void>((resolve) => (finish = resolve)), wanted);
    const second = line.do(async () => await Promise.reject(new Error("was done")), () => isWanted);
    const third = line.do(async () => await Promise.resolve("done"), wanted);
    await new Promise((resolve) => setTimeout(resolve, 5));
    isWanted = false;
    finish();
    await first;
    await expect(second).rejects.toBeInstanceOf(Unwanted);
    expect(await third).toBe("done");
  });
});
