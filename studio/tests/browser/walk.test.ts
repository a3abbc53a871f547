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

/** A headset made up in the page: it draws both eyes side by side on the canvas, for three frames. */
function withHeadset(): void {
  const near = 0.3;
  const far = 4000;
  const [sum, product] = [-(far + near) / (far - near), (-2 * far * near) / (far - near)];
  const counted = window as { eyesAsked?: number };
  const size = (): { width: number; height: number } => document.querySelector("veduta-studio")?.shadowRoot?.querySelector("canvas") ?? { width: 2, height: 2 };
  const views = [-1, 1].map((x) => ({ x, transform: { matrix: new Float32Array([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, 0, 0, 1]) } }));
  const session = {
    inputSources: [],
    updateRenderState: async () => await Promise.resolve(),
    requestReferenceSpace: async () => await Promise.resolve({}),
    addEventListener: () => undefined,
    end: async () => await Promise.resolve(),
    requestAnimationFrame: (draw: (now: number, frame: unknown) => void) => {
      counted.eyesAsked = (counted.eyesAsked ?? 0) + 1;
      if (counted.eyesAsked > 3) return;
      const { width, height } = size();
      const across = (2 * height) / (width / 2);
      const projectionMatrix = new Float32Array([across, 0, 0, 0, 0, 2, 0, 0, 0, 0, sum, -1, 0, 0, product, 0]);
      requestAnimationFrame((now) => draw(now, { getViewerPose: () => ({ views: views.map((view) => ({ ...view, projectionMatrix })) }) }));
    },
  };
  const layer = class {
    framebuffer = null;
    framebufferWidth = size().width;
    framebufferHeight = size().height;
    getViewport({ x }: { x: number }): object {
      const { width, height } = size();
      return { x: x < 0 ? 0 : width / 2, y: 0, width: width / 2, height };
    }
  };
  const xr = { isSessionSupported: async () => await Promise.resolve(true), requestSession: async () => await Promise.resolve(session) };
  Object.defineProperty(navigator, "xr", { value: xr });
  Object.defineProperty(window, "XRWebGLLayer", { value: layer });
  WebGL2RenderingContext.prototype.makeXRCompatible = async () => await Promise.resolve();
}

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

  plainly("shows both eyes of a headset their own view, where there is one", async () => {
    const { page, complaints } = await open(await browser(true), `${site.origin}/`, {}, withHeadset);
    await seek(page, 0);
    await page.getByRole("button", { name: "headset" }).click();
    await page.waitForFunction(() => ((window as { eyesAsked?: number }).eyesAsked ?? 0) > 3);
    const { width, height } = page.viewportSize() ?? { width: 0, height: 0 };
    // The eyes are 1 m to the left and to the right, and see 12 m of a wall 12 m away: the middle of each, a little lower.
    for (const [x, part] of [[-1, 0.25], [1, 0.75]] as const) {
      const { mean } = await look(page, around({ x: part * width, y: height * (0.5 + 1 / 12) }, 8));
      expect(Math.max(...mean.map((value, k) => Math.abs(value - (wallColour(x, 1)[k] ?? 0))))).toBeLessThan(6);
    }
    expect(complaints).toEqual([]);
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
