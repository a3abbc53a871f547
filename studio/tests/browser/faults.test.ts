/** Places of which something does not come, at first or for good. */
import { renameSync, rmSync, writeFileSync, readFileSync } from "node:fs";
import { join } from "node:path";
import type { Browser, Page } from "playwright-core";
import { afterAll, afterEach, beforeAll, beforeEach, describe, expect, it } from "vitest";
import { launch, MISSING } from "./chromium.ts";
import { look, loseContext, open, settled, stateOf } from "./page.ts";
import { makeSite, type Site } from "./site.ts";

const HOUSES = 7;

describe.skipIf(MISSING !== null)("a place of which something is missing", () => {
  let browser: Browser;
  let site: Site;

  beforeAll(async () => {
    browser = await launch();
  });
  afterAll(async () => {
    await browser.close();
  });
  beforeEach(async () => {
    site = await makeSite(HOUSES);
  });
  afterEach(async () => {
    await site.close();
  });

  const missing = async (page: Page): Promise<string[]> => await page.evaluate(() => window.veduta?.stats().missing ?? []);
  const parts = async (page: Page): Promise<number> =>
    await page.evaluate(() => new Set(window.veduta?.features().map(({ part }) => part)).size);
  const calm = async (page: Page): Promise<void> => {
    await page.waitForFunction(() => window.veduta?.stats().loading === 0);
  };

  it("shows the others and names the one that is not there, and takes it when it comes", async () => {
    const model = join(site.folder, "house-3", "model.glb");
    renameSync(model, `${model}.away`);
    const { page } = await open(browser, `${site.origin}/`);
    expect(await stateOf(page)).toBe("ready");
    await calm(page);
    expect(await parts(page)).toBe(HOUSES - 1);
    const panel = page.locator("veduta-missing div");
    expect(await panel.textContent()).toContain("house-3/model.glb");
    expect(await panel.textContent()).toContain("not there");
    renameSync(`${model}.away`, model);
    await page.getByRole("button", { name: "Ask now" }).click();
    await page.waitForFunction(() => window.veduta?.stats().missing.length === 0);
    expect(await parts(page)).toBe(HOUSES);
    expect(await panel.isVisible()).toBe(false);
    await page.context().close();
  });

  it("names one that is cut short, and does not ask for it again", async () => {
    const model = join(site.folder, "house-2", "model.glb");
    writeFileSync(model, readFileSync(model).subarray(0, 4000));
    const { page } = await open(browser, `${site.origin}/`);
    await calm(page);
    expect(await missing(page)).toEqual(["house-2/model.glb"]);
    expect(await page.locator("veduta-missing div").textContent()).toContain("cut short");
    await page.context().close();
  });

  it("asks again at once when the network is back", async () => {
    const { page } = await open(browser, `${site.origin}/`);
    await calm(page);
    await page.route("**/house-4/model.glb", (route) => route.abort());
    await page.reload();
    await page.waitForFunction(() => window.veduta?.stats().missing.length === 1);
    await page.unroute("**/house-4/model.glb");
    await page.evaluate(() => globalThis.dispatchEvent(new Event("online")));
    await page.waitForFunction(() => window.veduta?.stats().missing.length === 0);
    expect(await parts(page)).toBe(HOUSES);
    await page.context().close();
  });

  it("does not let a walker through a house that has not come", async () => {
    rmSync(join(site.folder, "house-1", "model.glb"));
    const { page } = await open(browser, `${site.origin}/`);
    await calm(page);
    await page.keyboard.press("2");
    await settled(page);
    await page.keyboard.down("w");
    await page.waitForFunction(() => window.veduta?.walk().blocked === true);
    await page.keyboard.up("w");
    await page.context().close();
  });

  it("draws again when the graphics card was taken away and comes back", async () => {
    const { page } = await open(browser, `${site.origin}/`);
    await calm(page);
    const middle = { x: 480, y: 200, width: 400, height: 300 };
    const before = await look(page, middle);
    const giveBack = await loseContext(page);
    await page.waitForTimeout(500);
    await giveBack();
    await page.waitForTimeout(2000);
    expect(await stateOf(page)).toBe("ready");
    expect(await page.getByRole("alert").count()).toBe(0);
    const after = await look(page, middle);
    expect(after.spread).toBeGreaterThan(0.8 * before.spread);
    await page.context().close();
  });
});
