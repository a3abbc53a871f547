import { describe, expect } from "vitest";
import { DEFAULT_WALK } from "../../src/core/walking.ts";
import { HOUSE, openings, PARTLY_SEEN } from "../fixture/house.mjs";
import { launch, MISSING } from "./chromium.ts";
import { around, look, open, picked, project, settled, stateOf, walkState } from "./page.ts";
import { makeSite } from "./site.ts";
import { visits } from "./visits.ts";

const RADIUS = DEFAULT_WALK.body.radius_m;
const WINDOW = openings().find(({ name }) => name === "Window 3, floor 2");

/** The middle of the window's pane, world frame; the house stands at the origin. */
function paneCentre(): readonly [number, number, number] {
  if (WINDOW === undefined) throw new Error("the fixture has no such window");
  return [WINDOW.x + 0.3 * WINDOW.width, WINDOW.recess, WINDOW.z + 0.4 * WINDOW.height];
}

const it = visits();

describe.skipIf(MISSING !== null)("the studio in Chromium", () => {
  it("loads and draws something", async ({ page }) => {
    expect(await stateOf(page)).toBe("ready");
    expect(await page.title()).toContain("Rue Exemple 1");
    const middle = await look(page, { x: 420, y: 120, width: 500, height: 440 });
    expect(middle.spread).toBeGreaterThan(12);
    expect(middle.spread).toBeLessThan(110);
    const sky = await look(page, { x: 1000, y: 20, width: 100, height: 40 });
    expect(sky.mean[2]).toBeGreaterThan(sky.mean[0]);
  });

  it("picks a window and tells what is known about it", async ({ page }) => {
    const at = await project(page, paneCentre());
    await page.mouse.click(at.x, at.y);
    expect(await picked(page)).toMatchObject({ class: "window", name: WINDOW?.name, part: "house-1" });
    const field = (name: string): Promise<string | null> =>
      page.locator(`veduta-feature-panel [data-field=${name}]`).textContent();
    expect(await field("name")).toBe(WINDOW?.name);
    expect(await field("size")).toBe("1.10 × 1.70 m");
    expect(await field("area")).toBe("1.87 m²");
    expect(await field("provenance")).toBe("Measured");
    expect(await page.locator("[data-field=seen]").count()).toBe(0);
    const crop = page.locator("veduta-photo-region canvas");
    await crop.waitFor();
    await page.waitForTimeout(300);
    const box = await crop.boundingBox();
    if (box === null) throw new Error("the photo region is not shown");
    expect((await look(page, box)).spread).toBeGreaterThan(10);
    await page.locator("[data-field=parent]").click();
    expect(await picked(page)).toMatchObject({ class: "wall", name: "Street wall" });
    await page.keyboard.press("Escape");
    expect(await picked(page)).toBeNull();
  });

  it("tells measured from guessed where a window goes on behind a railing", async ({ page }) => {
    const partly = openings().find(({ name }) => name === PARTLY_SEEN.name);
    if (partly === undefined) throw new Error("the fixture has no such window");
    const at = await project(page, [partly.x + 0.3, partly.recess, partly.z + 0.7]);
    await page.mouse.click(at.x, at.y);
    expect(await picked(page)).toMatchObject({ name: PARTLY_SEEN.name, provenance: "inferred" });
    const panel = page.locator("veduta-feature-panel");
    expect(await panel.locator("[data-field=size]").textContent()).toBe("1.10 × 1.70 m");
    expect(await panel.locator("[data-field=seen]").textContent()).toBe("(height seen: 1.20 m)");
    expect(await panel.locator(".provenance p").textContent()).toContain("shows its upper part");
  });

  it("hides the windows with their layer and brings them back", async ({ page }) => {
    await settled(page);
    const at = await project(page, paneCentre());
    const before = await look(page, around(at));
    await page.getByRole("switch", { name: "Windows" }).click();
    await settled(page);
    const under = await page.evaluate(({ x, y }) => window.veduta?.under(x, y)?.feature.class ?? "nothing", at);
    expect(under).not.toBe("window");
    const hidden = await look(page, around(at));
    const change = Math.max(...before.mean.map((v, k) => Math.abs(v - (hidden.mean[k] ?? 0))));
    expect(change).toBeGreaterThan(15);
    await page.getByRole("switch", { name: "Windows" }).click();
    await settled(page);
    const after = await look(page, around(at));
    for (const k of [0, 1, 2] as const) expect(after.mean[k]).toBeCloseTo(before.mean[k], 0);
  });

  it("colours by provenance: the measured wall blue, the invented side red", async ({ page }) => {
    await page.keyboard.press("p");
    await page.keyboard.press("p");
    await settled(page);
    const wall = await look(page, around(await project(page, [0.5, 0, 2])));
    expect(wall.mean[2]).toBeGreaterThan(wall.mean[0] + 30);
    const painted = await look(page, around(await project(page, [10.2, 0, 0.35]), 6));
    expect(painted.mean[0]).toBeGreaterThan(painted.mean[2] + 10);
    const side = await look(page, around(await project(page, [0, 4, 6])));
    expect(side.mean[0]).toBeGreaterThan(side.mean[2] + 10);
    expect(await page.locator("veduta-layers .legend").textContent()).toContain("Invented");
  });

  it("walks into the doorway and is stopped by the door", async ({ page }) => {
    await page.keyboard.press("2");
    await settled(page);
    const eye = await page.evaluate(() => window.veduta?.camera().eye[2]);
    expect(eye).toBeCloseTo(1.7, 3);
    await page.keyboard.down("w");
    await page.waitForFunction(() => window.veduta?.walk().blocked === true);
    await page.waitForTimeout(400);
    await page.keyboard.up("w");
    const { feet } = await walkState(page);
    expect(feet[0]).toBeCloseTo(HOUSE.width / 2, 2);
    expect(feet[1]).toBeCloseTo(0.18 - RADIUS, 2);
    expect(feet[2]).toBeCloseTo(0, 3);
  });

  it("is stopped by the wall beside it and slides along", async ({ page }) => {
    await page.keyboard.press("2");
    await settled(page);
    await page.keyboard.down("d");
    await page.waitForFunction(() => (window.veduta?.walk().feet[0] ?? 0) > 8);
    await page.keyboard.up("d");
    await page.keyboard.down("w");
    await page.waitForFunction(() => window.veduta?.walk().blocked === true);
    await page.waitForTimeout(300);
    const stopped = await walkState(page);
    expect(stopped.feet[1]).toBeCloseTo(-RADIUS, 2);
    await page.keyboard.down("d");
    await page.waitForFunction((x) => (window.veduta?.walk().feet[0] ?? 0) > x, stopped.feet[0] + 1);
    await page.keyboard.up("d");
    await page.keyboard.up("w");
    expect((await walkState(page)).feet[1]).toBeCloseTo(-RADIUS, 2);
  });

  it("turns with a drag while walking, and does not pick", async ({ page }) => {
    await page.keyboard.press("2");
    await settled(page);
    const before = await page.evaluate(() => window.veduta?.camera().direction[0] ?? 0);
    await page.mouse.move(700, 300);
    await page.mouse.down();
    await page.mouse.move(500, 300, { steps: 5 });
    await page.mouse.up();
    await settled(page);
    const after = await page.evaluate(() => window.veduta?.camera().direction[0] ?? 0);
    expect(after - before).toBeGreaterThan(0.3);
    expect(await picked(page)).toBeNull();
  });

  it("goes back to the first view", async ({ page }) => {
    await settled(page);
    const first = await page.evaluate(() => window.veduta?.camera().eye);
    await page.mouse.move(640, 300);
    await page.mouse.wheel(0, -600);
    await page.keyboard.down("ArrowLeft");
    await page.waitForTimeout(500);
    await page.keyboard.up("ArrowLeft");
    const moved = await page.evaluate(() => window.veduta?.camera().eye);
    expect(Math.hypot(...[0, 1, 2].map((k) => (moved?.[k] ?? 0) - (first?.[k] ?? 0)))).toBeGreaterThan(1);
    await page.keyboard.press("r");
    await settled(page);
    await page.waitForTimeout(500);
    const back = await page.evaluate(() => window.veduta?.camera().eye);
    for (const k of [0, 1, 2] as const) expect(back?.[k]).toBeCloseTo(first?.[k] ?? Number.NaN, 1);
  });

  it("opens and closes the help from the keyboard, and names every button", async ({ page }) => {
    await page.keyboard.press("?");
    const help = page.getByRole("dialog", { name: "Looking and walking" });
    await help.waitFor();
    expect(await help.textContent()).toContain("Run");
    await page.keyboard.press("Escape");
    await help.waitFor({ state: "hidden" });
    for (const button of await page.locator("button:visible").all()) {
      const name = (await button.getAttribute("aria-label")) ?? (await button.textContent()) ?? "";
      expect(name.trim(), await button.innerHTML()).not.toBe("");
    }
  });

  it("is operable without a mouse", async ({ page }) => {
    const reached = new Set<string>();
    for (let i = 0; i < 25; i += 1) {
      await page.keyboard.press("Tab");
      reached.add(await page.evaluate(() => {
        let element = document.activeElement;
        while (element?.shadowRoot?.activeElement) element = element.shadowRoot.activeElement;
        return element?.getAttribute("aria-label") ?? element?.textContent.trim() ?? "";
      }));
    }
    for (const name of ["Walk", "Reset the view", "Layers and colours", "Help"]) expect(reached).toContain(name);
  });

  it("saves a picture of the place", async ({ page }) => {
    const download = page.waitForEvent("download");
    await page.getByRole("button", { name: "Save a picture" }).click();
    expect((await download).suggestedFilename()).toBe("house-1.png");
  });
});

describe.skipIf(MISSING !== null)("the studio on a phone", () => {
  it("fits, picks by touch and walks by the stick", async () => {
    const site = await makeSite(2);
    const browser = await launch();
    try {
      const phone = { viewport: { width: 390, height: 780 }, hasTouch: true, isMobile: true };
      const { page, complaints } = await open(browser, `${site.origin}/`, phone);
      await settled(page);
      expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(390);
      const tools = await page.locator("veduta-toolbar").boundingBox();
      expect(tools?.x).toBeGreaterThanOrEqual(0);
      expect((tools?.x ?? 0) + (tools?.width ?? 999)).toBeLessThanOrEqual(390);
      const at = await project(page, [0.4, 0, 6]);
      await page.touchscreen.tap(at.x, at.y);
      expect(await picked(page)).toMatchObject({ class: "wall" });
      await page.getByText("is invented: no record says so").waitFor();
      await page.getByRole("button", { name: "Close this panel" }).click();
      await page.getByRole("radio", { name: "Walk" }).click();
      await settled(page);
      const start = await walkState(page);
      const stick = await page.locator("veduta-joystick").boundingBox();
      if (stick === null) throw new Error("there is no stick");
      await page.mouse.move(stick.x + stick.width / 2, stick.y + stick.height / 2);
      await page.mouse.down();
      await page.mouse.move(stick.x + stick.width / 2, stick.y + 8, { steps: 3 });
      await page.waitForFunction((y) => (window.veduta?.walk().feet[1] ?? 0) > y, start.feet[1] + 0.5);
      await page.mouse.up();
      expect(complaints).toEqual([]);
    } finally {
      await browser.close();
      await site.close();
    }
  });
});
