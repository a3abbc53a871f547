/** Places that are opened one after another in one page leave nothing behind. */
import { mkdirSync } from "node:fs";
import { join } from "node:path";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { addAnimal } from "../fixture/animal.mjs";
import { makePlace } from "../fixture/make-place.mjs";
import { addPhotos } from "../fixture/photos.mjs";
import { makeRooms } from "../fixture/rooms.mjs";
import { addWalk } from "../fixture/walk.mjs";
import { launch, MISSING } from "./chromium.ts";
import { makeSite, type Site } from "./site.ts";

/** Of what the page held when the same place was seen ten places before. */
const MOST_GROWTH = 1.05;

describe.skipIf(MISSING !== null)("places that are opened one after another", () => {
  let browser: Browser;
  let site: Site;

  const kinds: Readonly<Record<string, (folder: string) => void>> = {
    one: (folder) => makePlace(folder),
    two: (folder) => makePlace(folder, 2),
    seven: (folder) => makePlace(folder, 7),
    rooms: makeRooms,
    animal: (folder) => {
      makePlace(folder);
      addAnimal(folder);
    },
    stroll: (folder) => {
      makePlace(folder);
      addWalk(folder);
    },
    photo: (folder) => {
      makePlace(folder);
      addPhotos(folder, [{ eye: [5, -14, 1.7], target: [5, 0, 5] }]);
    },
    photos: (folder) => {
      makePlace(folder);
      addPhotos(folder, [1, 3, 5, 7, 9].map((x) => ({ eye: [x, -14, 1.7], target: [x, 0, 5] })));
    },
  };

  beforeAll(async () => {
    [browser, site] = [await launch(), await makeSite()];
    for (const [name, make] of Object.entries(kinds)) {
      mkdirSync(join(site.folder, name));
      make(join(site.folder, name));
    }
  });
  afterAll(async () => {
    await browser.close();
    await site.close();
  });

  /** What the page holds after a forced collection (bytes). */
  async function held(page: Page): Promise<number> {
    const inner = await page.context().newCDPSession(page);
    for (let round = 0; round < 3; round += 1) await inner.send("HeapProfiler.collectGarbage");
    const { usedSize } = await inner.send("Runtime.getHeapUsage");
    await inner.detach();
    return usedSize;
  }

  it("hold no more after the tenth than after the first", async () => {
    const context = await browser.newContext({ viewport: { width: 600, height: 400 }, deviceScaleFactor: 0.3, serviceWorkers: "block" });
    const page = await context.newPage();
    const visit = async (name: string): Promise<number> => {
      await page.goto("about:blank");
      await page.goto(`${site.origin}/?place=${name}/`);
      await page.waitForFunction(() => document.documentElement.dataset.veduta === "ready" && window.veduta?.stats().loading === 0);
      return await held(page);
    };
    const names = Object.keys(kinds);
    const sizes: number[] = [];
    // Code that a kind of place alone needs is compiled once, and kept by the browser.
    for (const name of names) await visit(name);
    for (const name of ["one", ...names, "rooms", "one"]) sizes.push(await visit(name));
    expect(sizes.at(-1)).toBeLessThan(MOST_GROWTH * (sizes[0] ?? 0));
    await context.close();
  }, 240_000);
});
