/** An exported folder without its server: what was seen is there, and what was cut is not kept. */
import { createHash } from "node:crypto";
import { appendFileSync, readdirSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { join, relative } from "node:path";
import type { Browser, Page } from "playwright-core";
import { afterAll, afterEach, beforeAll, beforeEach, describe, expect, it } from "vitest";
import { launch, MISSING } from "./chromium.ts";
import { open, stateOf } from "./page.ts";
import { makeSite, type Site } from "./site.ts";

/** What `veduta export` writes beside the files (python/veduta/studio/export.py). */
function writeRecord(folder: string): number {
  const names = readdirSync(folder, { recursive: true, encoding: "utf8" })
    .map((name) => relative(folder, join(folder, name)))
    .filter((name) => name !== "veduta-web.json" && statSync(join(folder, name)).isFile());
  const digest = (name: string): string => createHash("sha256").update(readFileSync(join(folder, name))).digest("hex");
  const files = Object.fromEntries(names.map((name) => [name, digest(name)]));
  writeFileSync(join(folder, "veduta-web.json"), JSON.stringify({ schema: "veduta/web", version: 1, files }));
  return names.length;
}

const keptFiles = async (page: Page): Promise<string[]> =>
  await page.evaluate(async () => {
    const [name = ""] = await caches.keys();
    return (await (await caches.open(name)).keys()).map(({ url }) => new URL(url).pathname.slice(1));
  });

async function kept(page: Page, count: number): Promise<string[]> {
  for (let tries = 0; tries < 150; tries += 1) {
    const files = await keptFiles(page);
    if (files.length === count) return files;
    await page.waitForTimeout(100);
  }
  return await keptFiles(page);
}

describe.skipIf(MISSING !== null)("an exported folder", () => {
  let browser: Browser;
  let site: Site;

  beforeAll(async () => {
    browser = await launch();
  });
  afterAll(async () => {
    await browser.close();
  });
  beforeEach(async () => {
    site = await makeSite();
  });
  afterEach(async () => {
    await site.close();
  });

  it("is there again when its server is gone", async () => {
    const files = writeRecord(site.folder);
    const { page } = await open(browser, `${site.origin}/`, { serviceWorkers: "allow" });
    expect(await kept(page, files + 1)).toHaveLength(files + 1);
    await site.close();
    await page.reload();
    await page.waitForFunction(() => document.documentElement.dataset.veduta !== undefined);
    expect(await stateOf(page)).toBe("ready");
    expect(await page.evaluate(() => window.veduta?.features().length)).toBeGreaterThan(10);
    await page.context().close();
    site = await makeSite();
  });

  it("takes what has changed, and keeps nothing that is not what its record says", async () => {
    const files = writeRecord(site.folder);
    const { page } = await open(browser, `${site.origin}/`, { serviceWorkers: "allow" });
    await kept(page, files + 1);
    const place = join(site.folder, "place.json");
    writeFileSync(place, JSON.stringify({ ...(JSON.parse(readFileSync(place, "utf8")) as object), title: "Another" }));
    appendFileSync(join(site.folder, "licences.txt"), "new");
    writeRecord(site.folder);
    appendFileSync(join(site.folder, "licences.txt"), "more than was recorded");
    await page.reload();
    await page.waitForFunction(() => document.documentElement.dataset.veduta === "ready");
    expect(await page.title()).toContain("Another");
    const now = await kept(page, files);
    expect(now).toHaveLength(files);
    expect(now).not.toContain("licences.txt");
    await page.context().close();
  });

  it("is shown where nothing can be kept", async () => {
    const { page, complaints } = await open(browser, `${site.origin}/`, { serviceWorkers: "allow" });
    expect(await stateOf(page)).toBe("ready");
    expect(complaints).toEqual([]);
    await page.context().close();
  });
});
