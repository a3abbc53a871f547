/** A place that is a raster: a picture from above on heights. It is seen in its colours, asked and walked on. */
import type { Page } from "playwright-core";
import { describe, expect } from "vitest";
import { heightAt, makeRaster, RASTER, rasterColour } from "../fixture/raster.mjs";
import { MISSING } from "./chromium.ts";
import { around, look, picked, project, settled, walkState } from "./page.ts";
import { visits } from "./visits.ts";

const it = visits(makeRaster);

/** What the page shows of the ground at a place, and what its picture has there. */
async function colours(page: Page, x: number, y: number): Promise<{ shown: readonly number[]; told: readonly number[] }> {
  const { mean } = await look(page, around(await project(page, [x, y, heightAt(x)]), 8));
  return { shown: mean, told: rasterColour(x, y) };
}

describe.skipIf(MISSING !== null)("a raster", () => {
  it("is shown whole from outside, in the colours of its picture", async ({ page }) => {
    await settled(page);
    const { width, height } = page.viewportSize() ?? { width: 0, height: 0 };
    const { size_m } = RASTER;
    for (const [x, y] of [[0, 0], [size_m, 0], [size_m, size_m], [0, size_m]] as const) {
      const at = await project(page, [x, y, heightAt(x)]);
      expect(at.x).toBeGreaterThan(0);
      expect(at.x).toBeLessThan(width);
      expect(at.y).toBeGreaterThan(0);
      expect(at.y).toBeLessThan(height);
    }
    // Red and green as the picture has them, by how they stand to each other: the light is the same for both.
    for (const [x, y] of [[5, 8], [15, 8], [15, 14], [6, 15]] as const) {
      const { shown: [red = 0, green = 0, blue = 0], told } = await colours(page, x, y);
      const [toldRed = 0, toldGreen = 0] = told;
      expect(Math.log(red / green)).toBeCloseTo(Math.log(toldRed / toldGreen), 0);
      expect(Math.sign(red - green)).toBe(Math.sign(toldRed - toldGreen));
      expect(blue).toBeLessThan(Math.max(red, green));
    }
  });

  it("says what it is where it is clicked", async ({ page }) => {
    await settled(page);
    const at = await project(page, [15, 8, RASTER.high_m]);
    await page.mouse.click(at.x, at.y);
    expect(await picked(page)).toMatchObject({ class: "ground", provenance: "measured", part: "map" });
  });

  it("carries who walks on it, level, up the rise and level again", async ({ page }) => {
    await page.keyboard.press("2");
    await settled(page);
    expect((await walkState(page)).feet[2]).toBeCloseTo(0, 2);
    await page.keyboard.down("w");
    await page.waitForFunction((x) => (window.veduta?.walk().feet[0] ?? 0) > x, RASTER.rise[1] + 1);
    await page.keyboard.up("w");
    const { feet } = await walkState(page);
    expect(feet[2]).toBeCloseTo(RASTER.high_m, 2);
    expect(feet[0]).toBeGreaterThan(RASTER.rise[1]);
  });
});
