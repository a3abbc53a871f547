/** Commands: by their names, from a test, by a click on the place, and from a link to what has not come yet. */
import type { Page } from "playwright-core";
import { describe, expect } from "vitest";
import { HOUSE } from "../fixture/house.mjs";
import { addPhotos } from "../fixture/photos.mjs";
import { findings } from "./axe.ts";
import { MISSING } from "./chromium.ts";
import { open, picked, project, settled } from "./page.ts";
import { makeSite } from "./site.ts";
import { visits } from "./visits.ts";

const it = visits((folder) => addPhotos(folder, [{ eye: [5, -14, 1.7], target: [5, 0, 5] }]));

const shown = async (page: Page): Promise<string[]> => await page.locator("veduta-palette [role=option] span").allTextContents();

describe.skipIf(MISSING !== null)("the commands", () => {
  it("are found by their names and done by Enter", async ({ page }) => {
    await page.keyboard.press("Control+k");
    const field = page.getByRole("combobox", { name: "Find a command" });
    await field.waitFor();
    expect((await shown(page)).length).toBeGreaterThan(10);
    // It has photos, but no rooms and no files that are missing.
    expect(await shown(page)).toContain("Look through the next photo");
    expect((await shown(page)).join()).not.toContain("In a house");
    expect(await findings(page)).toEqual([]);
    await page.keyboard.type("colours");
    expect((await shown(page))[0]).toContain("Change the colours");
    await page.keyboard.press("Enter");
    await page.waitForFunction(() => window.veduta?.state().colouring === "class");
    expect(await field.isVisible()).toBe(false);
  });

  it("are chosen by arrow keys, and left by Escape, without moving anything behind them", async ({ page }) => {
    await settled(page);
    const before = await page.evaluate(() => window.veduta?.camera());
    await page.keyboard.press("Control+k");
    await page.keyboard.press("ArrowDown");
    const active = page.locator("veduta-palette [aria-selected=true]");
    expect(await active.textContent()).toContain("Walk in it");
    await page.keyboard.press("ArrowUp");
    await page.keyboard.press("ArrowUp");
    expect(await active.textContent()).toContain((await shown(page)).at(-1) ?? "");
    await page.keyboard.type("nothing like it");
    await page.getByText("No command of that name").waitFor();
    expect(await findings(page)).toEqual([]);
    await page.keyboard.press("Escape");
    expect(await page.getByRole("combobox").isVisible()).toBe(false);
    await settled(page);
    expect(await page.evaluate(() => window.veduta?.camera())).toEqual(before);
    expect(await page.evaluate(() => window.veduta?.state().mode)).toBe("orbit");
  });

  it("can be called by scripts", async ({ page }) => {
    await page.evaluate(() => {
      window.veduta?.do("colour", "provenance");
      window.veduta?.do("walk", undefined);
    });
    await settled(page);
    expect(await page.evaluate(() => window.veduta?.state())).toMatchObject({ mode: "walk", colouring: "provenance" });
  });

  it("choose what is clicked", async ({ page }) => {
    await settled(page);
    const at = await project(page, [HOUSE.width / 2, 0, HOUSE.eaves - 0.3]);
    await page.mouse.click(at.x, at.y);
    expect((await picked(page))?.class).toBe("wall");
    await page.waitForFunction(() => location.hash.includes("pick=house-1/"));
  });

  it("choose what a link names when it has come", async ({ opened }) => {
    const site = await makeSite(2);
    const { page } = await open(opened.browser, `${site.origin}/`);
    const id = (await page.evaluate(() => window.veduta?.features().find((one) => one.class === "window")?.id)) ?? "";
    await page.route("**/house-2/model.glb", (route) => route.abort());
    await page.goto(`${site.origin}/?again#mode=orbit&pick=house-2/${id}`);
    await page.waitForFunction(() => window.veduta?.stats().missing.length === 1);
    expect(await picked(page)).toBeNull();
    // It stays in the address until then.
    await page.waitForFunction(() => location.hash.includes("hour="));
    expect(await page.evaluate(() => location.hash)).toContain(`pick=house-2/${id}`);
    await page.unroute("**/house-2/model.glb");
    await page.getByRole("button", { name: "Ask now" }).click();
    await page.waitForFunction(() => window.veduta?.picked() !== null);
    expect(await picked(page)).toMatchObject({ id, part: "house-2", class: "window" });
    await page.context().close();
    await site.close();
  });
});
