/** Each file of a place is missing, cut short or slow, and the server goes away: the page goes on and says so. */
import { existsSync, mkdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import type { Browser, Page, Route } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { addAnimal } from "../fixture/animal.mjs";
import { makePlace } from "../fixture/make-place.mjs";
import { addPhotos, addPoints, editPlace } from "../fixture/photos.mjs";
import { makeRaster } from "../fixture/raster.mjs";
import { makeRooms } from "../fixture/rooms.mjs";
import { addWalk } from "../fixture/walk.mjs";
import { launch, MISSING } from "./chromium.ts";
import { open, stateOf } from "./page.ts";
import { makeSite, type Site } from "./site.ts";

const SLOW_MS = 1500;

describe.skipIf(MISSING !== null)("of a place that is served badly", () => {
  let browser: Browser;
  let site: Site;

  beforeAll(async () => {
    [browser, site] = [await launch(), await makeSite(2)];
    addPhotos(site.folder, [{ eye: [5, -14, 1.7], target: [5, 0, 5] }]);
    addPoints(site.folder, [[1, -1, 1], [2, -1, 2], [3, -1, 1]]);
    makeRooms(join(site.folder, "rooms"));
    makeRaster(join(site.folder, "map"));
    for (const [name, add] of [["stroll", addWalk], ["beast", addAnimal]] as const) {
      const folder = join(site.folder, name);
      mkdirSync(folder);
      makePlace(folder);
      add(folder);
    }
  });
  afterAll(async () => {
    await browser.close();
    await site.close();
  });

  /** The files of some places, where each is asked for, and the keys after which it is. */
  const files: readonly (readonly [string, string, readonly string[]])[] = [
    ["place.json", "/", []],
    ["house-1/model.glb", "/", []],
    ["pictures/1.png", "/", ["n"]],
    ["points.ply", "/", []],
    ["rooms/place.json", "/?place=rooms/", []],
    ["rooms/house.glb", "/?place=rooms/", []],
    ["rooms/plan.json", "/?place=rooms/", []],
    ["stroll/walk/key-0.png", "/?place=stroll/", []],
    ["stroll/walk/way-1-forth.glb", "/?place=stroll/", []],
    ["beast/animal/model.glb", "/?place=beast/", []],
    ["map/map.glb", "/?place=map/", []],
  ];

  const missing = async (route: Route): Promise<void> => await route.fulfill({ status: 404, body: "not there" });
  const cut = async (route: Route, file: string): Promise<void> => {
    const content = readFileSync(join(site.folder, file));
    await route.fulfill({ status: 200, body: content.subarray(0, Math.floor(content.length / 2)) });
  };
  const late = async (route: Route): Promise<void> => {
    await new Promise((resolve) => setTimeout(resolve, SLOW_MS));
    await route.continue();
  };

  /** Opens the place whose file comes in this way. */
  async function opened(file: string, path: string, keys: readonly string[], how: (route: Route) => Promise<void>): Promise<{ page: Page; errors: string[] }> {
    const context = await browser.newContext({ viewport: { width: 800, height: 500 }, deviceScaleFactor: 0.4, serviceWorkers: "block" });
    const page = await context.newPage();
    const errors: string[] = [];
    page.on("pageerror", (error) => errors.push(error.message));
    await page.route(`**/${file}`, how);
    await page.goto(`${site.origin}${path}`);
    await page.waitForFunction(() => document.documentElement.dataset.veduta !== undefined);
    for (const key of keys) await page.keyboard.press(key);
    return { page, errors };
  }

  it("knows each of its files", () => {
    for (const [file] of files) expect(existsSync(join(site.folder, file)), file).toBe(true);
  });

  for (const [file, path, keys] of files) {
    for (const [how, way] of [["is missing", missing], ["is cut short", cut]] as const) {
      it(`names ${file} where it ${how}`, async () => {
        const name = file.replace(/^(rooms|stroll|beast|map)\//, "");
        const { page, errors } = await opened(file, path, keys, async (route) => await way(route, file));
        await page.getByText(name).first().waitFor({ state: "attached", timeout: 30_000 });
        expect(errors).toEqual([]);
        await page.context().close();
      });
    }
    it(`shows all where ${file} is slow`, async () => {
      const { page, errors } = await opened(file, path, keys, late);
      expect(await stateOf(page)).toBe("ready");
      await page.waitForFunction(() => window.veduta?.stats().loading === 0);
      expect(await page.evaluate(() => window.veduta?.stats().missing)).toEqual([]);
      expect(errors).toEqual([]);
      await page.context().close();
    });
  }

  for (const [file, path, keys] of [
    ["pictures/1.png", "/", ["n"]],
    ["rooms/plan.json", "/?place=rooms/", []],
    ["stroll/walk/key-0.png", "/?place=stroll/", []],
    ["stroll/walk/way-1-back.glb", "/?place=stroll/", []],
  ] as const) {
    it(`takes ${file} when it comes after all`, async () => {
      const { page, errors } = await opened(file, path, keys, missing);
      await page.waitForFunction(() => (window.veduta?.stats().missing.length ?? 0) > 0);
      await page.unroute(`**/${file}`);
      const came = page.waitForResponse((answer) => answer.url().endsWith(file) && answer.ok());
      await page.getByRole("button", { name: "Ask now" }).click();
      await came;
      await page.waitForFunction(() => window.veduta?.stats().missing.length === 0 && window.veduta.stats().loading === 0);
      expect(errors).toEqual([]);
      await page.context().close();
    });
  }

  it("shows the place before its points have come", async () => {
    let letGo: () => void = () => undefined;
    const held = new Promise<void>((resolve) => (letGo = resolve));
    const { page, errors } = await opened("points.ply", "/", [], async (route) => {
      await held;
      await route.continue();
    });
    expect(await stateOf(page)).toBe("ready");
    expect(await page.evaluate(() => window.veduta?.stats().loading)).toBe(1);
    letGo();
    await page.waitForFunction(() => window.veduta?.stats().loading === 0);
    expect(errors).toEqual([]);
    await page.context().close();
  });

  it("takes what it lacks when the server is back", async () => {
    const other = await makeSite(7);
    const { page } = await open(browser, `${other.origin}/`);
    await page.waitForFunction(() => window.veduta?.stats().loading === 0);
    await page.route("**/house-6/model.glb", (route) => route.abort());
    await page.reload();
    await page.waitForFunction(() => window.veduta?.stats().missing.length === 1);
    await page.unroute("**/house-6/model.glb");
    await other.leave();
    await page.getByRole("button", { name: "Ask now" }).click();
    await page.waitForTimeout(1000);
    expect(await page.evaluate(() => window.veduta?.stats().missing)).toEqual(["house-6/model.glb"]);
    await other.comeBack();
    await page.waitForFunction(() => window.veduta?.stats().missing.length === 0);
    await page.context().close();
    await other.close();
  });

  for (const [words, transform] of [["out of reach", 1e9], ["nowhere", 0]] as const) {
    it(`refuses a part that stands ${words}, and says which`, async () => {
      const other = await makeSite(2);
      editPlace(other.folder, ({ parts: [first] }) => {
        if (first === undefined) return;
        first.transform = transform === 0 ? first.transform.map(() => 0) : [...first.transform.slice(0, 12), transform, 0, 0, 1];
      });
      const { page } = await open(browser, `${other.origin}/`);
      expect(await stateOf(page)).toBe("error");
      expect(await page.getByRole("alert").textContent()).toContain("Part 1");
      await page.context().close();
      await other.close();
    });
  }
});
