/**
 * Opens a place on uneven ground, at $VEDUTA_UNEVEN_URL: `tests/integration/test_uneven_place.py`
 * derives one and serves it with `veduta view`. A row of boxes stands 3 m over the plane.
 */
import { describe, expect, it } from "vitest";
import { launch, MISSING } from "./chromium.ts";
import { open, picked, settled, stateOf, walkState } from "./page.ts";

const url = process.env.VEDUTA_UNEVEN_URL;
const HIGH_M = 3;
const PATIENCE_MS = 120_000;

describe.skipIf(MISSING !== null || url === undefined)("a place on uneven ground", () => {
  it("has a ground that carries, can be asked and can be hidden, and is framed without it", async () => {
    const browser = await launch();
    try {
      const { page, complaints } = await open(browser, url ?? "", { viewport: { width: 1280, height: 720 } });
      expect(await stateOf(page)).toBe("ready");
      expect(await page.locator("header.brand span").textContent()).toContain("and 4 more");
      await settled(page);

      // The buildings fill the free part of the picture in one direction, however far the ground goes.
      const across = await page.evaluate(() => {
        const seen = [0, 48].map((x) => window.veduta?.project([x, 0, 8])?.x ?? 0);
        return Math.abs((seen[1] ?? 0) - (seen[0] ?? 0));
      });
      expect(across).toBeGreaterThan(300);

      // The slope before the row is ground, and invented.
      const at = await page.evaluate(() => window.veduta?.project([24, -8, 2.2]) ?? null);
      if (at === null) throw new Error("the slope is not seen");
      await page.mouse.click(at.x, at.y);
      expect(await picked(page)).toMatchObject({ class: "ground", provenance: "invented", part: "ground:00" });
      await page.keyboard.press("Escape");

      await page.keyboard.press("2");
      await settled(page);
      const feet = async (): Promise<readonly [number, number, number]> => (await walkState(page)).feet;
      const start = await feet();
      expect(start[2]).toBeGreaterThan(0.3);
      expect(start[2]).toBeLessThan(HIGH_M);

      // Backwards down to the plane, then up again as far as the wall: on the ground all the way.
      await page.keyboard.down("s");
      await page.waitForFunction(() => (window.veduta?.walk().feet[2] ?? 9) < 0.01, undefined, { timeout: PATIENCE_MS });
      await page.keyboard.up("s");
      expect((await feet())[2]).toBeGreaterThanOrEqual(0);
      await page.keyboard.down("w");
      await page.waitForFunction(() => window.veduta?.walk().blocked === true, undefined, { timeout: PATIENCE_MS });
      await page.keyboard.up("w");
      const end = await feet();
      expect(end[1]).toBeGreaterThan(-1);
      expect(end[2]).toBeGreaterThan(HIGH_M - 0.1);
      expect(end[2]).toBeLessThan(HIGH_M + 0.1);

      // Hidden ground is not picked, but carries.
      await page.locator("veduta-layers button[data-class=ground]").click();
      await page.keyboard.down("s");
      await page.waitForTimeout(1500);
      await page.keyboard.up("s");
      expect((await feet())[2]).toBeGreaterThan(0.3);
      expect(complaints).toEqual([]);
    } finally {
      await browser.close();
    }
  }, 380_000);
});
