/** The page's address: it says what is seen, brings it back, and goes back. */
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { describe, expect } from "vitest";
import { MISSING } from "./chromium.ts";
import { open, picked, settled } from "./page.ts";
import { visits } from "./visits.ts";

const TITLE = "Rue des Essais <b>";

const it = visits((folder) => {
  const file = join(folder, "place.json");
  const place = JSON.parse(readFileSync(file, "utf8")) as object;
  writeFileSync(file, JSON.stringify({ ...place, title: TITLE, description: "One house", author: "Ada", licence: "CC0-1.0" }));
});

describe.skipIf(MISSING !== null)("the address of a view", () => {
  it("shows another person the same", async ({ page, opened }) => {
    await page.keyboard.press("2");
    await settled(page);
    await page.keyboard.press("p");
    await page.keyboard.down("w");
    await page.waitForTimeout(600);
    await page.keyboard.up("w");
    await page.waitForFunction(() => location.hash.includes("mode=walk") && location.hash.includes("colours=class"));
    await page.waitForTimeout(1200);
    const [link, here] = await page.evaluate(() => [location.hash, window.veduta?.camera()] as const);
    const other = await open(opened.browser, `${opened.origin}/${link}`);
    const state = await other.page.evaluate(() => window.veduta?.state());
    const there = await other.page.evaluate(() => window.veduta?.camera());
    expect(state).toMatchObject({ mode: "walk", colouring: "class" });
    for (const axis of [0, 1, 2] as const) expect(there?.eye[axis]).toBeCloseTo(here?.eye[axis] ?? 0, 1);
    for (const axis of [0, 1, 2] as const) expect(there?.direction[axis]).toBeCloseTo(here?.direction[axis] ?? 0, 2);
    await other.page.context().close();
  });

  it("goes back from walking to looking from outside", async ({ page }) => {
    await page.waitForFunction(() => location.hash.includes("mode=orbit"));
    await page.keyboard.press("2");
    await page.waitForFunction(() => location.hash.includes("mode=walk"));
    await page.goBack();
    await page.waitForFunction(() => window.veduta?.state().mode === "orbit");
  });

  it("keeps the surface that is chosen", async ({ opened }) => {
    const { page } = await open(opened.browser, `${opened.origin}/`);
    const id = await page.evaluate(() => window.veduta?.features().find((one) => one.class === "window")?.id);
    await page.context().close();
    const other = await open(opened.browser, `${opened.origin}/#mode=orbit&pick=${id ?? ""}`);
    expect((await picked(other.page))?.id).toBe(id);
    await other.page.context().close();
  });

  it("says what the maker of the place says", async ({ page }) => {
    expect(await page.title()).toBe(`${TITLE} · Veduta`);
    const meta = async (name: string): Promise<string | null> =>
      await page.locator(`head meta[name="${name}"]`).getAttribute("content");
    expect(await Promise.all(["description", "author", "license"].map(meta))).toEqual(["One house", "Ada", "CC0-1.0"]);
  });
});
