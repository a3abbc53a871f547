/** A walk from view to view: how one gets along on it, what is seen, and what a frame of it costs. */
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it as plainly } from "vitest";
import { addWalk, WALK, wallColour } from "../fixture/walk.mjs";
import { launch, MISSING } from "./chromium.ts";
import { around, type Inspection, look, open, settled, stateOf } from "./page.ts";
import { makeSite, type Site } from "./site.ts";
import { visits } from "./visits.ts";

const it = visits(addWalk);

const stroll = async (page: Page): Promise<NonNullable<ReturnType<Inspection["stroll"]>>> => {
  const state = await page.evaluate(() => window.veduta?.stroll() ?? null);
  if (state === null) throw new Error("one is not on the walk");
  return state;
};
const cost = async (page: Page): Promise<NonNullable<ReturnType<Inspection["strollCost"]>>> => {
  const found = await page.evaluate(() => window.veduta?.strollCost() ?? null);
  if (found === null) throw new Error("one is not on the walk");
  return found;
};
const seek = async (page: Page, at: number): Promise<void> => {
  await page.getByRole("slider", { name: "How far the walk is" }).fill(String(at));
  await page.waitForFunction(() => window.veduta?.strollCost()?.waiting === 0);
  await settled(page);
};
/** What the page shows of the wall, at a place of it (m from its middle) and a depth, beside what it is. */
const wall = async (page: Page, x: number, y: number, depth: number): Promise<number> => {
  const { height, width } = page.viewportSize() ?? { width: 0, height: 0 };
  const scale = Math.max(height / WALK.height, width / WALK.width) * WALK.focal;
  const { mean } = await look(page, around({ x: width / 2 + (x / depth) * scale, y: height / 2 + (y / depth) * scale }, 8));
  return Math.max(...mean.map((value, k) => Math.abs(value - (wallColour(x, y)[k] ?? 0))));
};

describe.skipIf(MISSING !== null)("a walk from view to view", () => {
  it("shows the plain picture at a key position, and one picture of both between", async ({ page }) => {
    await seek(page, 0);
    for (const [x, y] of [[1, 1], [-1, 1], [3, -1], [-3, -1]] as const) {
      expect(await wall(page, x, y, WALK.wall_m)).toBeLessThan(4);
    }
    await seek(page, 0.5);
    for (const [x, y] of [[1, 1], [-1, 1], [3, -1]] as const) {
      expect(await wall(page, x, y, WALK.wall_m - WALK.step_m / 2)).toBeLessThan(6);
    }
  });

  it("walks by keys and wheel, stops at both ends, and cuts where it is cut", async ({ page }) => {
    await page.keyboard.down("w");
    await page.waitForFunction(() => (window.veduta?.stroll()?.at ?? 0) > 0.2);
    await page.keyboard.up("w");
    const { at } = await stroll(page);
    await page.mouse.move(300, 200);
    await page.mouse.wheel(0, -400);
    await page.waitForFunction((before) => (window.veduta?.stroll()?.at ?? 0) > before + 0.3, at);
    await page.mouse.wheel(0, 9000);
    await page.waitForFunction(() => window.veduta?.stroll()?.at === 0);
    await page.mouse.wheel(0, -99_000);
    await page.waitForFunction(() => window.veduta?.stroll()?.at === 3);
    expect(await page.locator("veduta-morph-panel [data-field=way]").textContent()).toBe("3 of 3 is cut");
    await seek(page, 2.4);
    expect(await wall(page, 1, 1, WALK.wall_m - 2 * WALK.step_m)).toBeLessThan(4);
  });

  it("plays by itself at walking speed, and stands at the end", async ({ page }) => {
    await seek(page, 2.9);
    await page.keyboard.press("g");
    await page.waitForFunction(() => window.veduta?.stroll()?.at === 3);
    await page.waitForFunction(() => window.veduta?.stroll()?.playing === false);
  });

  it("shows geometry and counterparts, and the picture again (J)", async ({ page }) => {
    await seek(page, 0.5);
    const looks: string[] = [];
    const means: number[] = [];
    for (let n = 0; n < 3; n++) {
      await settled(page);
      looks.push((await stroll(page)).look);
      means.push((await look(page, { x: 500, y: 250, width: 200, height: 120 })).mean[0]);
      await page.keyboard.press("j");
    }
    expect(looks).toEqual(["picture", "geometry", "psi"]);
    expect((await stroll(page)).look).toBe("picture");
    expect(Math.abs((means[0] ?? 0) - (means[1] ?? 0))).toBeGreaterThan(5);
    expect(Math.abs((means[0] ?? 0) - (means[2] ?? 0))).toBeGreaterThan(5);
  });

  it("goes from position to position at once where that is wished", async ({ page }) => {
    await seek(page, 0.4);
    await page.getByRole("button", { name: "instant" }).click();
    await settled(page);
    expect((await stroll(page)).instant).toBe(true);
    expect(await wall(page, 1, 1, WALK.wall_m)).toBeLessThan(4);
    await seek(page, 0.6);
    expect(await wall(page, 1, 1, WALK.wall_m - WALK.step_m)).toBeLessThan(4);
  });

  it("draws two textured models and their mixture, and holds three transitions at most", async ({ page }) => {
    await seek(page, 1.5);
    const { calls, triangles, held, bytes } = await cost(page);
    expect(calls).toBe(3);
    expect(triangles).toBe(2 * 2 * 12 * 8 + 2);
    expect(held).toBeLessThanOrEqual(3);
    expect(bytes).toBeGreaterThan(1e5);
    expect(bytes).toBeLessThan(300e6);
    await seek(page, 0.5);
    expect((await cost(page)).bytes).toBeLessThan(1.5 * bytes);
  });
});

describe.skipIf(MISSING !== null)("a walk on other machines", () => {
  let site: Site;
  const browsers: Browser[] = [];
  const browser = async (webgl: boolean): Promise<Browser> => {
    const launched = await launch({ webgl });
    browsers.push(launched);
    return launched;
  };
  beforeAll(async () => {
    site = await makeSite();
    addWalk(site.folder);
  });
  afterAll(async () => {
    for (const launched of browsers) await launched.close();
    await site.close();
  });

  plainly("is instant from the start for whoever wants less motion", async () => {
    const { page } = await open(await browser(true), `${site.origin}/`, { reducedMotion: "reduce" });
    expect((await stroll(page)).instant).toBe(true);
  });

  plainly("walks by the stick where one touches", async () => {
    const { page } = await open(await browser(true), `${site.origin}/`, { hasTouch: true, isMobile: true, viewport: { width: 420, height: 800 } });
    const stick = await page.locator("veduta-joystick").boundingBox();
    if (stick === null) throw new Error("there is no stick");
    await page.mouse.move(stick.x + stick.width / 2, stick.y + stick.height / 2);
    await page.mouse.down();
    await page.mouse.move(stick.x + stick.width / 2, stick.y + 8, { steps: 3 });
    await page.waitForFunction(() => (window.veduta?.stroll()?.at ?? 0) > 0.15);
    await page.mouse.up();
  });

  plainly("cross-fades the pictures where WebGL 2 is missing, and says so", async () => {
    const { page, complaints } = await open(await browser(false), `${site.origin}/`);
    expect(await stateOf(page)).toBe("ready");
    const view = page.locator("veduta-plain-walk");
    expect(await view.locator("[role=status]").textContent()).toContain("no WebGL 2");
    expect(await view.locator("[data-field=end]").evaluate((image: HTMLElement) => image.style.opacity)).toBe("0");
    await page.keyboard.press("w");
    await page.keyboard.press("w");
    expect(await view.locator("[data-field=end]").evaluate((image: HTMLElement) => image.style.opacity)).toBe("0.25");
    const shown = await view.locator("[data-field=start]").evaluate((image: HTMLImageElement) => image.naturalWidth);
    expect(shown).toBe(WALK.width);
    await page.getByRole("slider", { name: "How far the walk is" }).fill("3");
    expect(await view.locator("[data-field=metres]").textContent()).toBe("6.0 m of 6.0 m");
    expect(complaints).toEqual([]);
  });
});
