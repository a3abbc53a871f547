/** The page for those who use a keyboard or a screen reader: axe finds nothing in any of its states. */
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import type { AxeResults } from "axe-core";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { addPhotos, editPlace } from "../fixture/photos.mjs";
import { makeRooms } from "../fixture/rooms.mjs";
import { launch, MISSING } from "./chromium.ts";
import { open, settled } from "./page.ts";
import { makeSite, type Site } from "./site.ts";

const AXE = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

/** What axe finds, each with the elements that it is found on. */
async function findings(page: Page): Promise<string[]> {
  await settled(page);
  await page.evaluate(AXE);
  const { violations } = await page.evaluate<AxeResults>("axe.run()");
  return violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html.slice(0, 120)).join(" | ")}`);
}

describe.skipIf(MISSING !== null)("axe", () => {
  let site: Site;
  let browser: Browser;
  let page: Page;

  beforeAll(async () => {
    [site, browser] = [await makeSite(), await launch()];
    addPhotos(site.folder, [{ eye: [5, -14, 1.7], target: [5, 0, 5] }]);
    makeRooms(join(site.folder, "rooms"));
    ({ page } = await open(browser, `${site.origin}/`));
  });

  afterAll(async () => {
    await browser.close();
    await site.close();
  });

  it("finds nothing in the place from outside", async () => {
    expect(await findings(page)).toEqual([]);
  });

  it("finds nothing in the help, nor with the layers closed", async () => {
    await page.keyboard.press("h");
    expect(await findings(page)).toEqual([]);
    await page.keyboard.press("Escape");
    await page.keyboard.press("l");
    expect(await findings(page)).toEqual([]);
    await page.keyboard.press("l");
  });

  it("finds nothing where a surface is chosen", async () => {
    const id = await page.evaluate(() => window.veduta?.features().find((one) => one.class === "window")?.id);
    const { page: other } = await open(browser, `${site.origin}/#mode=orbit&pick=${id ?? ""}`);
    await other.locator("veduta-feature-panel [data-field=name]").waitFor();
    expect(await findings(other)).toEqual([]);
    await other.context().close();
  });

  it("finds nothing while one looks through a photo", async () => {
    await page.keyboard.press("n");
    await page.waitForFunction(() => window.veduta?.photo() !== null);
    expect(await findings(page)).toEqual([]);
    await page.keyboard.press("Escape");
  });

  it("finds nothing while one walks", async () => {
    await page.keyboard.press("2");
    expect(await findings(page)).toEqual([]);
  });

  it("finds nothing in a house with its map, its lamps and its doors", async () => {
    const { page: house } = await open(browser, `${site.origin}/?place=rooms/#mode=walk`);
    expect(await findings(house)).toEqual([]);
    await house.context().close();
  });

  it("finds nothing on a phone", async () => {
    const phone = { viewport: { width: 390, height: 780 }, hasTouch: true, isMobile: true };
    const { page: small } = await open(browser, `${site.origin}/#mode=walk`, phone);
    expect(await findings(small)).toEqual([]);
    await small.context().close();
  });

  it("finds nothing in the card of a place that cannot be shown", async () => {
    editPlace(site.folder, (place) => {
      place.version = "something else";
    });
    const { page: broken } = await open(browser, `${site.origin}/`);
    await broken.evaluate(AXE);
    const { violations } = await broken.evaluate<AxeResults>("axe.run()");
    expect(violations.map(({ id }) => id)).toEqual([]);
    await broken.context().close();
  });
});
