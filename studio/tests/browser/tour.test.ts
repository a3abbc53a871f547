import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import type { Page } from "playwright-core";
import { describe, expect } from "vitest";
import { MISSING } from "./chromium.ts";
import { type Inspection, settled, walkState } from "./page.ts";
import { visits } from "./visits.ts";

/** Along the street before the house of the fixture, looking at it; then a turn to the east. */
const TOUR = {
  id: "tour",
  name: "Tour",
  times_s: [0, 20, 22],
  eyes: [[-4, -9, 1.7], [6, -9, 1.7], [6, -9, 1.7]],
  directions: [[0, 1, 0], [0, 1, 0], [1, 0, 0]],
  stretches: [
    { room: null, name: "The street", start_s: 0, end_s: 20 },
    { room: "r", name: "The corner", start_s: 20, end_s: 22 },
  ],
};

/** The same street the other way. */
const BACK = {
  id: "back",
  name: "Back again",
  times_s: [0, 10],
  eyes: [[6, -9, 1.7], [-4, -9, 1.7]],
  directions: [[0, 1, 0], [0, 1, 0]],
  stretches: [{ room: null, name: "Back", start_s: 0, end_s: 10 }],
};

const it = visits((folder) => {
  const file = join(folder, "place.json");
  const place = JSON.parse(readFileSync(file, "utf8")) as object;
  writeFileSync(file, JSON.stringify({ ...place, tours: [TOUR, BACK] }));
});

describe.skipIf(MISSING !== null)("a guided tour", () => {
  const tourState = async (page: Page): Promise<ReturnType<Inspection["tour"]>> =>
    await page.evaluate(() => window.veduta?.tour() ?? null);
  const camera = async (page: Page): Promise<ReturnType<Inspection["camera"]>> => {
    const state = await page.evaluate(() => window.veduta?.camera());
    if (state === undefined) throw new Error("window.veduta is not there");
    return state;
  };
  const playing = async (page: Page): Promise<void> => {
    await page.waitForFunction(() => (window.veduta?.tour()?.time_s ?? 0) > 0.2);
  };

  it("plays from the panel, takes the eye along, and pauses", async ({ page }) => {
    expect(await tourState(page)).toBeNull();
    await page.getByRole("button", { name: "Play the tour" }).click();
    await playing(page);
    await page.getByRole("button", { name: "Pause the tour" }).click();
    await settled(page);
    const [state, { eye, direction }] = [await tourState(page), await camera(page)];
    expect(state?.playing).toBe(false);
    expect(state?.room).toBe("The street");
    // Half a metre a second; the page knows the time to a quarter of a second.
    expect(Math.abs(eye[0] - (-4 + 0.5 * (state?.time_s ?? 0)))).toBeLessThan(0.3);
    expect(eye[1]).toBeCloseTo(-9, 3);
    expect(direction[1]).toBeCloseTo(1, 3);
  });

  it("goes where the slider says and names the room", async ({ page }) => {
    const slider = page.getByRole("slider", { name: "How far the tour is" });
    await slider.fill("21");
    await settled(page);
    const { eye, direction } = await camera(page);
    expect(eye[0]).toBeCloseTo(6, 3);
    expect(direction[0]).toBeCloseTo(Math.SQRT1_2, 3);
    expect(await page.locator("veduta-tour-panel [data-field=room]").textContent()).toBe("The corner");
    expect(await page.locator("veduta-tour-panel [data-field=time]").textContent()).toBe("0:21 of 0:22");
  });

  it("takes the tour that one chooses", async ({ page }) => {
    await page.getByRole("combobox", { name: "Which tour" }).selectOption("Back again");
    await settled(page);
    expect((await camera(page)).eye[0]).toBeCloseTo(6, 3);
    await page.getByRole("slider", { name: "How far the tour is" }).fill("10");
    await settled(page);
    expect((await camera(page)).eye[0]).toBeCloseTo(-4, 3);
    expect((await tourState(page))?.room).toBe("Back");
  });

  it("stops for a visitor who walks on, and goes on where it was left", async ({ page }) => {
    await page.keyboard.press("KeyG");
    await playing(page);
    await page.keyboard.down("KeyW");
    await page.waitForFunction(() => window.veduta?.tour()?.playing === false);
    await page.waitForFunction(() => (window.veduta?.walk().feet[1] ?? -9) > -8.7);
    await page.keyboard.up("KeyW");
    const left = await tourState(page);
    expect((await walkState(page)).feet[1]).toBeGreaterThan(-8.7);
    await page.keyboard.press("KeyG");
    await page.waitForFunction((time) => (window.veduta?.tour()?.time_s ?? 0) > time, left?.time_s ?? 0);
    const { eye } = await camera(page);
    expect(eye[1]).toBeCloseTo(-9, 3);
    await page.keyboard.press("Digit1");
    expect((await tourState(page))?.playing).toBe(false);
  });
});
