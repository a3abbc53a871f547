/**
 * Opens a studio that somebody else serves, at $VEDUTA_STUDIO_URL: `tests/integration/test_studio.py`
 * does this with `veduta view` and with an exported folder.
 */
import { describe, expect, it } from "vitest";
import { launch, MISSING } from "./chromium.ts";
import { around, look, open, picked, project, settled, stateOf } from "./page.ts";

const url = process.env.VEDUTA_STUDIO_URL;

describe.skipIf(MISSING !== null || url === undefined)("the studio as Veduta serves it", () => {
  it("shows the place, picks a window and stays with its own server", async () => {
    const browser = await launch();
    try {
      const { page, complaints } = await open(browser, url ?? "");
      expect(await stateOf(page)).toBe("ready");
      await settled(page);
      expect((await look(page, { x: 420, y: 120, width: 500, height: 440 })).spread).toBeGreaterThan(10);
      const seen = await page.evaluate(() => {
        const api = window.veduta;
        for (let y = 60; y < 620; y += 4) {
          for (let x = 290; x < 1260; x += 4) {
            const hit = api?.under(x, y);
            if (hit?.feature.class === "window") return hit;
          }
        }
        return null;
      });
      expect(seen).not.toBeNull();
      if (seen === null) return;
      const at = await project(page, seen.point);
      await page.mouse.click(at.x, at.y);
      expect((await picked(page))?.id).toBe(seen.feature.id);
      await settled(page);
      expect((await look(page, around(at, 4))).mean.every((v) => v > 0)).toBe(true);
      expect(complaints).toEqual([]);
    } finally {
      await browser.close();
    }
  });
});
