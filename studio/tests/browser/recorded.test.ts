/** A place that keeps what was recorded beside its model: both are compared in one picture. */
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { describe, expect } from "vitest";
import { HOUSE } from "../fixture/house.mjs";
import { MISSING } from "./chromium.ts";
import { around, look, project, settled } from "./page.ts";
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
});
