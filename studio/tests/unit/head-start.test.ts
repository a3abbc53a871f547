import { expect, test } from "vitest";
import { HeadStart } from "../../src/app/head-start.ts";
import type { Part } from "../../src/core/place.ts";

const part = (model: string): Part => ({ model }) as unknown as Part;
const FIRST = part("a.glb");
const SECOND = part("b.glb");
const PARTS = [FIRST, SECOND];

function counted(): { asked: string[]; fetch: (part: Part, index: number) => Promise<ArrayBuffer> } {
  const asked: string[] = [];
  return {
    asked,
    fetch: async ({ model }, index) => {
      asked.push(model);
      return await Promise.resolve(new ArrayBuffer(index + asked.length));
    },
  };
}

test("all of the parts are asked for before anybody takes one", () => {
  const { asked, fetch } = counted();
  new HeadStart(PARTS, fetch);
  expect(asked).toEqual(["a.glb", "b.glb"]);
});

test("a part is fetched anew when it is asked for a second time", async () => {
  const { asked, fetch } = counted();
  const start = new HeadStart(PARTS, fetch);
  expect((await start.bytesOf(SECOND, 1)).byteLength).toBe(3);
  expect((await start.bytesOf(SECOND, 1)).byteLength).toBe(4);
  expect(asked).toEqual(["a.glb", "b.glb", "b.glb"]);
});

test("what has no head start is fetched when it is wanted", async () => {
  const { asked, fetch } = counted();
  const start = new HeadStart([], fetch);
  expect(asked).toEqual([]);
  await start.bytesOf(part("c.glb"), 7);
  expect(asked).toEqual(["c.glb"]);
});

test("a part that does not come fails for the one who takes it, and alone for him", async () => {
  const start = new HeadStart(PARTS, async () => await Promise.reject(new Error("away")));
  await new Promise((resolve) => setTimeout(resolve, 5));
  await expect(start.bytesOf(FIRST, 0)).rejects.toThrow("away");
});
