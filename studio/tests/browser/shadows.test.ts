/** Shadows are even: the samples of a shadow's soft edge are not seen one by one, as dots. */
import type { Browser } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { launch, MISSING } from "./chromium.ts";
import { look, open, settled, specks } from "./page.ts";
import { makeSite, type Site } from "./site.ts";

/** A dot is so much darker or brighter than its neighbours (luminance, 0..255). */
const DOT = 2;
/** The ground behind two houses, between the panels of the page: shadows end there, at any hour of the morning. */
const GROUND = { x: 280, y: 350, width: 980, height: 250 };

describe.skipIf(MISSING !== null)("shadows", () => {
  let browser: Browser;
  let site: Site;
  beforeAll(async () => {
    [browser, site] = [await launch(), await makeSite(2)];
  });
  afterAll(async () => {
    await browser.close();
    await site.close();
  });

  it.each([9, 10, 12])("lie on the ground without stipple at %i o'clock", async (hour) => {
    const view = `mode=orbit&eye=40,20,14&to=24,8,0&hour=${String(hour)}`;
    const { page } = await open(browser, `${site.origin}/#${view}`, { deviceScaleFactor: 1 });
    await settled(page);
    expect((await look(page, GROUND)).spread).toBeGreaterThan(10); // light and shade
    expect(await specks(page, GROUND, DOT)).toBeLessThan(1e-4);
    await page.close();
  });
});
