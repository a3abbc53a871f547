import { join } from "node:path";
import { describe, expect, it } from "vitest";
import { INDOOR_BODY } from "../../src/core/walking.ts";
import { DOOR, DOOR_ID, makeRooms } from "../fixture/rooms.mjs";
import { launch, MISSING } from "./chromium.ts";
import { look, open, settled, stateOf, walkState } from "./page.ts";
import { makeSite } from "./site.ts";

/** From where one comes in to a metre before the door, where one stays and looks at it. */
function toDoor(id: string, shut: readonly string[]): object {
  const eyes = [[2, 0.6, 1.7], [2, DOOR.y - 1, 1.7], [2, DOOR.y - 1, 1.7]];
  return { id, name: id, times_s: [0, 3, 90], eyes, directions: eyes.map(() => [0, 1, 0]), stretches: [], shut };
}

describe.skipIf(MISSING !== null)("a house in Chromium", () => {
  it("opens its door, lights the room that one comes into, and shows all that on the map", async () => {
    const site = await makeSite();
    const browser = await launch();
    try {
      makeRooms(join(site.folder, "rooms"));
      const { page, complaints } = await open(browser, `${site.origin}/?place=rooms/`, { viewport: { width: 900, height: 560 } });
      expect(await stateOf(page)).toBe("ready");
      await page.keyboard.press("KeyX");
      await page.keyboard.press("KeyI");
      await page.keyboard.press("KeyI"); // all off
      await page.keyboard.press("Digit2");
      await settled(page);
      const map = page.locator("veduta-minimap");
      await map.getByText("Hall").waitFor();
      const clip = { x: 300, y: 60, width: 320, height: 300 }; // between the panels
      const dark = await look(page, clip);
      await page.keyboard.press("KeyI"); // where one comes in
      await page.waitForFunction(() => window.veduta?.litRooms().join() === "r1");
      await settled(page);
      const lit = await look(page, clip);
      expect(lit.mean[0]).toBeGreaterThan(1.5 * dark.mean[0]);
      const door = async (): Promise<number> => (await page.evaluate(() => window.veduta?.doors()[0]?.share)) ?? -1;
      expect(await door()).toBe(0);
      await page.keyboard.down("KeyW");
      await page.waitForFunction((y) => (window.veduta?.walk().feet[1] ?? 0) > y, DOOR.y - 1.8);
      await page.waitForFunction(() => (window.veduta?.doors()[0]?.share ?? 0) > 0);
      await page.waitForFunction(() => window.veduta?.room()?.id === "r2", null, { timeout: 60_000 });
      await page.waitForFunction(() => window.veduta?.doors()[0]?.share === 0, null, { timeout: 60_000 });
      await page.keyboard.up("KeyW");
      await map.getByText("Studio").waitFor();
      expect(await page.evaluate(() => window.veduta?.litRooms())).toContain("r2");
      const { feet } = await walkState(page);
      expect(feet[1]).toBeLessThan(8 - INDOOR_BODY.radius_m + 0.01);
      expect(feet[0]).toBeCloseTo(2, 1);
      expect(complaints).toEqual([]);
    } finally {
      await browser.close();
      await site.close();
    }
  });

  it("keeps the door closed that a tour wants closed, and opens it for the other", async () => {
    const site = await makeSite();
    const browser = await launch();
    try {
      makeRooms(join(site.folder, "rooms"), [toDoor("past", [DOOR_ID]), toDoor("in", [])]);
      const { page, complaints } = await open(browser, `${site.origin}/?place=rooms/`, { viewport: { width: 900, height: 560 } });
      const door = async (): Promise<number> => (await page.evaluate(() => window.veduta?.doors()[0]?.share)) ?? -1;
      const middle = { x: 420, y: 200, width: 60, height: 120 };
      await page.getByRole("button", { name: "Play the tour" }).click();
      await page.waitForFunction(() => (window.veduta?.tour()?.time_s ?? 0) > 5, null, { timeout: 60_000 });
      expect(await door()).toBe(0);
      const closed = await look(page, middle);
      await page.getByRole("combobox", { name: "Which tour" }).selectOption("in"); // it plays on
      await page.waitForFunction(() => window.veduta?.doors()[0]?.share === 1, null, { timeout: 60_000 });
      await settled(page);
      const opened = await look(page, middle);
      expect(Math.abs(opened.mean[0] - closed.mean[0])).toBeGreaterThan(5);
      expect(complaints).toEqual([]);
    } finally {
      await browser.close();
      await site.close();
    }
  });
});
