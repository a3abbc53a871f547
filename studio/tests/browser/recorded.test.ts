/** A place that keeps what was recorded beside its model: both are compared in one picture. */
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { describe, expect } from "vitest";
import { HOUSE } from "../fixture/house.mjs";
import { MISSING } from "./chromium.ts";
import { around, look, open, project, settled } from "./page.ts";
import { visits } from "./visits.ts";

const PHOTO = '"baseColorTexture":{"index":0}';

/** The house as it was recorded is red where the model has its photo. */
function keepRecord(folder: string): void {
  const model = readFileSync(join(folder, "house-1", "model.glb"), "latin1");
  const red = model.replace(PHOTO, '"baseColorFactor":[1,0,0,1]'.padEnd(PHOTO.length));
  writeFileSync(join(folder, "raw.glb"), red, "latin1");
  const file = join(folder, "place.json");
  const place = JSON.parse(readFileSync(file, "utf8")) as { parts: object[] };
  writeFileSync(file, JSON.stringify({ ...place, parts: place.parts.map((part) => ({ ...part, raw: "raw.glb" })) }));
}

const it = visits(keepRecord);

describe.skipIf(MISSING !== null)("what was recorded", () => {
  it("is compared with the model by a slider", async ({ page }) => {
    await settled(page);
    const walls = await Promise.all([0.1, 0.9].map(async (share) => await project(page, [share * HOUSE.width, 0, 3])));
    const redness = async (): Promise<number[]> => {
      await settled(page);
      const found = [];
      for (const at of walls) {
        const [red, green] = (await look(page, around(at))).mean;
        found.push(red - green);
      }
      return found;
    };
    const between = (((walls[0]?.x ?? 0) + (walls[1]?.x ?? 0)) / 2 / (page.viewportSize()?.width ?? 1)).toFixed(2);
    for (const red of await redness()) expect(red).toBeLessThan(60);
    await page.getByRole("switch", { name: "As recorded" }).click();
    const slider = page.getByRole("slider", { name: "as recorded" });
    await slider.fill(between);
    await page.waitForTimeout(500);
    const [left, right] = await redness();
    expect(left).toBeGreaterThan(60);
    expect(right).toBeLessThan(60);
    await slider.fill("1");
    for (const red of await redness()) expect(red).toBeGreaterThan(60);
    await page.getByRole("switch", { name: "As recorded" }).click();
    for (const red of await redness()) expect(red).toBeLessThan(60);
    expect(await slider.count()).toBe(0);
  });

  it("is named where it is late or does not come, and the model does not stand for it", async ({ opened }) => {
    const { page } = await open(opened.browser, `${opened.origin}/`);
    await settled(page);
    const wall = await project(page, [HOUSE.width / 2, 0, 3]);
    const seen = async (): Promise<readonly number[]> => {
      await settled(page);
      return (await look(page, around(wall))).mean;
    };
    const model = await seen();
    await page.route("**/raw.glb", (route) => route.abort());
    await page.getByRole("switch", { name: "As recorded" }).click();
    await page.getByRole("slider", { name: "as recorded" }).fill("1");
    await page.waitForFunction(() => window.veduta?.stats().missing.length === 1);
    expect(await page.locator("veduta-missing div").textContent()).toContain("raw.glb");
    const behind = await seen();
    expect(Math.hypot(...behind.map((value, k) => value - (model[k] ?? 0)))).toBeGreaterThan(20);
    await page.unroute("**/raw.glb");
    await page.getByRole("button", { name: "Ask now" }).click();
    await page.waitForFunction(() => window.veduta?.stats().missing.length === 0);
    const [red = 0, green = 0] = await seen();
    expect(red - green).toBeGreaterThan(60);
    await page.context().close();
  });
});
