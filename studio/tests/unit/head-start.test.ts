import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { FEW_PARTS, HeadStart } from "../../src/app/head-start.ts";
import type { Part } from "../../src/core/place.ts";

const MANIFEST = new URL("https://place.test/place.json");
const part = (model: string): Part => ({ model }) as unknown as Part;
const [FIRST, SECOND] = [part("a.glb"), part("b.glb")];
let asked: string[] = [];
let told: [number, string][] = [];
const start = (parts: readonly Part[]): HeadStart => new HeadStart(parts, MANIFEST, (share, file) => told.push([share, file]));

beforeEach(() => {
  [asked, told] = [[], []];
  vi.stubGlobal("fetch", async (url: URL) => {
    asked.push(url.pathname);
    if (url.pathname === "/away.glb") throw new Error("away");
    return await Promise.resolve(new Response(new Uint8Array(asked.length), { headers: { "content-length": String(asked.length) } }));
  });
});

afterEach(() => vi.unstubAllGlobals());

test("all of few parts are asked for before anybody takes one", () => {
  start([FIRST, SECOND]);
  expect(asked).toEqual(["/a.glb", "/b.glb"]);
});

test("of many parts none is asked for before it is wanted", async () => {
  const many = Array.from({ length: FEW_PARTS + 1 }, (_, index) => part(`${index}.glb`));
  const headStart = start(many);
  expect(asked).toEqual([]);
  await headStart.bytesOf(many[3] ?? FIRST, 3);
  expect(asked).toEqual(["/3.glb"]);
});

test("a part is fetched anew when it is asked for a second time", async () => {
  const headStart = start([FIRST, SECOND]);
  expect((await headStart.bytesOf(SECOND, 1)).byteLength).toBe(2);
  expect((await headStart.bytesOf(SECOND, 1)).byteLength).toBe(3);
  expect(asked).toEqual(["/a.glb", "/b.glb", "/b.glb"]);
});

test("a part that does not come fails for the one who takes it, and alone for him", async () => {
  const headStart = start([part("away.glb"), SECOND]);
  await new Promise((resolve) => setTimeout(resolve, 5));
  await expect(headStart.bytesOf(part("away.glb"), 0)).rejects.toThrow("away");
  expect((await headStart.bytesOf(SECOND, 1)).byteLength).toBe(2);
});

test("how much has come is the mean over all parts", async () => {
  const headStart = start([FIRST, SECOND]);
  await Promise.all([headStart.bytesOf(FIRST, 0), headStart.bytesOf(SECOND, 1)]);
  expect(told).toEqual([[0.5, "a.glb"], [1, "b.glb"]]);
});
