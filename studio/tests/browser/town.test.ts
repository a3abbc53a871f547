/**
 * Opens a town that is streamed, at $VEDUTA_TOWN_URL: `tests/integration/test_streamed_town.py` derives
 * one and serves it with `veduta view`.
 */
import type { Page, Route } from "playwright-core";
import { describe, expect, it } from "vitest";
import type { Vec3 } from "../../src/core/vector.ts";
import { findings } from "./axe.ts";
import { launch, MISSING } from "./chromium.ts";
import { open, picked, project, settled, stateOf, walkState } from "./page.ts";

const url = process.env.VEDUTA_TOWN_URL;
/** Rules of the test town make panes where everything is shown, and plain windows before. */
const PANE = "Pane";
const PATIENCE_MS = 120_000;

/** What is nearer than this is on this side of the first row (m). */
const ACROSS_M = 30;
const NEAR_M = 12;

/**
 * The panes of the test town lie behind the walls with nothing between: whoever looks past the edge of one sees
 * through the hollow house. A surface is taken only where it is seen so far around, too (CSS pixels).
 */
const AROUND = 12;

/** Waits until the walker stands, and all is there that is seen from there. */
async function still(page: Page): Promise<void> {
  await page.waitForFunction(
    () => {
      const { velocity } = window.veduta?.walk() ?? { velocity: [1, 0, 0] };
      const { loading } = window.veduta?.stats() ?? { loading: 1 };
      return Math.hypot(...velocity) < 1e-3 && loading === 0;
    },
    undefined,
    { timeout: PATIENCE_MS },
  );
  await settled(page);
}

/** A point of the picture where such a surface is seen; the picture's middle first. */
async function seen(page: Page, kind: string, rule: string | null): Promise<Vec3 | null> {
  return await page.evaluate(
    ([wanted, made, most, around]) => {
      const at = (x: number, y: number): Vec3 | null => {
        const hit = window.veduta?.under(x, y);
        if (hit === null || hit === undefined || hit.distance_m > most) return null;
        return hit.feature.class === wanted && (made === null || hit.feature.name === made) ? hit.point : null;
      };
      for (let away = 0; away < 300; away += 10) {
        for (const y of [330 - away, 330 + away]) {
          for (let x = 290; x < 1260; x += 8) {
            const point = at(x, y);
            const beside = [[-around, 0], [around, 0], [0, -around], [0, around]] as const;
            if (point !== null && beside.every(([dx, dy]) => at(x + dx, y + dy) !== null)) return point;
          }
        }
      }
      return null;
    },
    [kind, rule, rule === null ? ACROSS_M : NEAR_M, AROUND] as const,
  );
}

async function waitFor<T>(page: Page, look: () => Promise<T | null>): Promise<T> {
  const end = performance.now() + PATIENCE_MS;
  for (;;) {
    const found = await look();
    if (found !== null) return found;
    if (performance.now() > end) throw new Error("it does not come into view");
    await page.waitForTimeout(400);
  }
}

describe.skipIf(MISSING !== null || url === undefined)("a town of tiles", () => {
  it("is fetched where the person stands, can be asked and stops a walker", async () => {
    const browser = await launch();
    try {
      const { page, complaints } = await open(browser, url ?? "", { viewport: { width: 1280, height: 720 } });
      const fetched = new Set<string>();
      page.on("response", (answer) => fetched.add(new URL(answer.url()).pathname));
      expect(await stateOf(page)).toBe("ready");
      expect(await page.evaluate(() => window.veduta?.stats().tiles)).toBeGreaterThan(0);
      expect(await findings(page)).toEqual([]);
      await page.keyboard.press("2");
      await settled(page);

      // Across the street: the plain level.
      const window_ = await waitFor(page, () => seen(page, "window", null));
      const at = await project(page, window_);
      await page.mouse.click(at.x, at.y);
      const chosen = await picked(page);
      expect(chosen?.class).toBe("window");
      expect(chosen?.part).toMatch(/^house \d+$/);
      expect(chosen?.width_m).toBeCloseTo(1, 2);
      await page.keyboard.press("Escape");

      // The rows behind stand higher: there is ground between them, and it is there.
      expect(await page.evaluate(() => window.veduta?.features().some((one) => one.class === "ground"))).toBe(true);

      // To the wall: on the way the full level comes.
      await page.keyboard.down("w");
      await page.waitForFunction(() => window.veduta?.walk().blocked === true, undefined, { timeout: PATIENCE_MS });
      await page.keyboard.up("w");
      // The front stands at y = 0 of the southern row; the body has a radius of 0.3 m.
      expect((await walkState(page)).feet[1]).toBeLessThan(-0.25);
      expect((await walkState(page)).feet[1]).toBeGreaterThan(-1);
      await waitFor(page, () => Promise.resolve([...fetched].some((path) => path.endsWith("-full.glb")) || null));

      // Along it, as far as a window of the full level is seen: recessed by 0.2 m, known as the rules say.
      await page.keyboard.down("s");
      await page.waitForFunction(() => (window.veduta?.walk().feet[1] ?? 0) < -4, undefined, { timeout: PATIENCE_MS });
      await page.keyboard.up("s");
      await still(page);
      const pane = await waitFor(page, () => seen(page, "window", PANE));
      expect(pane[1]).toBeCloseTo(0.2, 2);
      const there = await project(page, pane);
      await page.mouse.click(there.x, there.y);
      const near = await picked(page);
      expect(near).toMatchObject({ class: "window", name: PANE, provenance: "inferred" });
      expect(near?.width_m).toBeCloseTo(1, 2);
      expect(near?.height_m).toBeCloseTo(1.5, 2);
      const panel = page.locator("veduta-feature-panel");
      expect(await panel.locator("[data-field=provenance]").textContent()).toBe("Inferred");
      expect(await page.locator("veduta-layers button[data-class=window] .count").textContent()).not.toBe("0");

      // The picture of the walls is there once, however many tiles have it.
      const pictures = await page.evaluate(() =>
        performance.getEntriesByType("resource").filter(({ name }) => name.includes("/textures/")),
      );
      expect(pictures).toHaveLength(1);
      expect(complaints).toEqual([]);
    } finally {
      await browser.close();
    }
  }, 400_000);

  it("names tiles that do not come, stops a walker meanwhile, and asks for them again", async () => {
    const browser = await launch();
    try {
      const { page } = await open(browser, url ?? "", { viewport: { width: 700, height: 450 } });
      await page.route("**/*-full.glb", (route) => route.abort());
      await page.keyboard.press("2");
      await settled(page);
      await page.keyboard.down("w");
      await page.waitForFunction(() => window.veduta?.walk().blocked === true, undefined, { timeout: PATIENCE_MS });
      await page.keyboard.up("w");
      await page.waitForFunction(() => (window.veduta?.stats().missing.length ?? 0) > 0, undefined, { timeout: PATIENCE_MS });
      const words = (await page.locator("veduta-missing div").textContent()) ?? "";
      expect(words).toContain("-full.glb");
      expect(words).not.toContain("http");
      await page.unroute("**/*-full.glb");
      const came = page.waitForResponse((answer) => answer.url().endsWith("-full.glb") && answer.ok(), { timeout: PATIENCE_MS });
      await page.getByRole("button", { name: "Ask now" }).click();
      await came;
      await page.waitForFunction(() => window.veduta?.stats().missing.length === 0, undefined, { timeout: PATIENCE_MS });
    } finally {
      await browser.close();
    }
  }, 400_000);

  /** Opens the town while files of this kind come in a way of their own. */
  async function servedBadly(files: string, how: (route: Route) => Promise<void>, look: (page: Page) => Promise<void>): Promise<void> {
    const browser = await launch();
    try {
      const page = await (await browser.newContext({ viewport: { width: 500, height: 320 }, deviceScaleFactor: 0.4, serviceWorkers: "block" })).newPage();
      const errors: string[] = [];
      page.on("pageerror", (error) => errors.push(error.message));
      await page.route(files, how);
      await page.goto(url ?? "");
      await page.waitForFunction(() => document.documentElement.dataset.veduta !== undefined, undefined, { timeout: PATIENCE_MS });
      await look(page);
      expect(errors).toEqual([]);
    } finally {
      await browser.close();
    }
  }

  it("names its tree of tiles where that is missing", async () => {
    await servedBadly("**/tileset.json", async (route) => await route.fulfill({ status: 404, body: "not there" }), async (page) => {
      expect(await stateOf(page)).toBe("error");
      expect(await page.getByRole("alert").textContent()).toContain("tileset.json");
    });
  }, 200_000);

  it("names tiles that are cut short, and shows what it has of the place", async () => {
    const cut = async (route: Route): Promise<void> => {
      const body = await (await route.fetch()).body();
      await route.fulfill({ status: 200, body: body.subarray(0, Math.floor(body.length / 2)) });
    };
    await servedBadly("**/*-full.glb", cut, async (page) => {
      expect(await stateOf(page)).toBe("ready");
      await page.keyboard.press("2");
      await page.waitForFunction(() => (window.veduta?.stats().missing.length ?? 0) > 0, undefined, { timeout: PATIENCE_MS });
      expect((await page.evaluate(() => window.veduta?.stats().missing))?.join()).toContain("-full.glb");
      expect(await page.evaluate(() => window.veduta?.stats().tiles)).toBeGreaterThan(0);
    });
  }, 300_000);

  it("shows all where its tiles are slow", async () => {
    const late = async (route: Route): Promise<void> => {
      await new Promise((resolve) => setTimeout(resolve, 1000));
      await route.continue();
    };
    await servedBadly("**/*.glb", late, async (page) => {
      expect(await stateOf(page)).toBe("ready");
      await page.waitForFunction(() => window.veduta?.stats().loading === 0, undefined, { timeout: PATIENCE_MS });
      expect(await page.evaluate(() => window.veduta?.stats().missing)).toEqual([]);
    });
  }, 300_000);
});
