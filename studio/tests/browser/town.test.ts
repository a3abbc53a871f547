/**
 * Opens a town that is streamed, at $VEDUTA_TOWN_URL: `tests/integration/test_streamed_town.py` derives
 * one and serves it with `veduta view`.
 */
import { describe, expect, it } from "vitest";
import { launch, MISSING } from "./chromium.ts";
import { open, picked, project, settled, stateOf, walkState } from "./page.ts";

const url = process.env.VEDUTA_TOWN_URL;

describe.skipIf(MISSING !== null || url === undefined)("a town of tiles", () => {
  it("is fetched where the person stands, can be asked and stops a walker", async () => {
    const browser = await launch();
    try {
      const { page, complaints } = await open(browser, url ?? "");
      expect(await stateOf(page)).toBe("ready");
      expect(await page.evaluate(() => window.veduta?.stats().tiles)).toBeGreaterThan(0);
      await page.keyboard.press("2");
      await settled(page);
      const find = async (): Promise<{ x: number; y: number; z: number } | null> =>
        await page.evaluate(() => {
          for (let y = 60; y < 620; y += 6) {
            for (let x = 290; x < 1260; x += 6) {
              const hit = window.veduta?.under(x, y);
              if (hit?.feature.class === "window") {
                const [px, py, pz] = hit.point;
                return { x: px, y: py, z: pz };
              }
            }
          }
          return null;
        });
      let seen = await find();
      for (let wait = 0; seen === null && wait < 40; wait += 1) {
        await page.waitForTimeout(500);
        seen = await find();
      }
      expect(seen).not.toBeNull();
      if (seen === null) return;
      const at = await project(page, [seen.x, seen.y, seen.z]);
      await page.mouse.click(at.x, at.y);
      const chosen = await picked(page);
      expect(chosen?.class).toBe("window");
      expect(chosen?.part).toMatch(/^house \d+$/);
      expect(chosen?.width_m).toBeCloseTo(1, 2);
      await page.keyboard.down("w");
      await page.waitForFunction(() => window.veduta?.walk().blocked === true, undefined, { timeout: 120_000 });
      await page.keyboard.up("w");
      // The front stands at y = 0 of the southern row; the body has a radius of 0.3 m.
      expect((await walkState(page)).feet[1]).toBeLessThan(-0.25);
      expect(complaints).toEqual([]);
    } finally {
      await browser.close();
    }
  }, 240_000);
});
