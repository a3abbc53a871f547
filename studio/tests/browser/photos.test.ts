import { rmSync } from "node:fs";
import { join } from "node:path";
import type { Browser, Page } from "playwright-core";
import { afterAll, afterEach, beforeAll, describe, expect, it } from "vitest";
import { HOUSE } from "../fixture/house.mjs";
import { addPhotos, addPoints, colourAt, editPlace, pixelOf, type Taken } from "../fixture/photos.mjs";
import { launch, MISSING } from "./chromium.ts";
import { around, look, open, picked, project, settled } from "./page.ts";
import { makeSite, type Site } from "./site.ts";

/** Drawing without a graphics card takes its time, pixel by pixel. */
const SMALL = { width: 960, height: 540 };

type Point = readonly [number, number, number];

const MIDDLE = HOUSE.width / 2;
/** Straight before the first house, and from its left. */
const BEFORE: Taken = { eye: [MIDDLE, -14, 3], target: [MIDDLE, 0, 5] };
const ASIDE: Taken = { eye: [-9, -12, 6], target: [4, 0, 4] };
/** Wall between the windows. */
const ON_WALL: readonly Point[] = [[2.4, 0, 2], [7.2, 0, 5.2], [4.8, 0, 6.2]];

describe.skipIf(MISSING !== null)("photos in the studio", () => {
  let browser: Browser;
  let site: Site | null = null;
  let page: Page;
  let complaints: string[] = [];

  beforeAll(async () => {
    browser = await launch();
  });
  afterAll(async () => {
    await browser.close();
  });
  afterEach(async () => {
    await page.context().close();
    await site?.close();
    site = null;
  });

  /** Opens a place of so many houses, after `change` has been made to its folder. */
  async function show(houses: number, change: (folder: string) => void): Promise<void> {
    site = await makeSite(houses);
    change(site.folder);
    ({ page, complaints } = await open(browser, `${site.origin}/`, { viewport: SMALL }));
    await settled(page);
  }

  async function shown(photos: number, level = 1): Promise<void> {
    await page.waitForFunction(
      ([count, least]) => {
        const levels = window.veduta?.photosShown() ?? [];
        return levels.length === count && levels.every((photo) => photo.level >= (least ?? 0));
      },
      [photos, level],
    );
    await settled(page);
  }

  async function colourOf(point: Point): Promise<readonly number[]> {
    return (await look(page, around(await project(page, point), 4))).mean;
  }

  function expectColour(seen: readonly number[], wanted: readonly number[], within = 6): void {
    for (const k of [0, 1, 2]) expect(Math.abs((seen[k] ?? 0) - (wanted[k] ?? 0)), `${seen.join()} for ${wanted.join()}`).toBeLessThan(within);
  }

  it("throws each pixel of a photo onto the surface that it shows, and takes it off again", async () => {
    await show(1, (folder) => addPhotos(folder, [BEFORE, ASIDE]));
    const before = await Promise.all(ON_WALL.map((point) => colourOf(point)));
    for (const [photo, taken] of [BEFORE, ASIDE].entries()) {
      await page.getByRole("option").nth(photo).click();
      await settled(page);
      await page.keyboard.press("Escape");
      await settled(page);
      await page.keyboard.press("t");
      await shown(1);
      // Taken from another place than it is seen from.
      for (const point of ON_WALL) expectColour(await colourOf(point), colourAt(...pixelOf(taken, point)));
      await page.keyboard.press("t");
      await shown(0);
    }
    for (const [k, point] of ON_WALL.entries()) expectColour(await colourOf(point), before[k] ?? [], 2);
    expect(complaints).toEqual([]);
  });

  it("leaves out what another building hides from the photo, and what is turned away from it", async () => {
    // A second house in the street hides the left half of the first from the photo, not from the visitor.
    const far: Taken = { eye: [MIDDLE + 0.5, -60, 3], target: [MIDDLE + 0.5, 0, 5] };
    const back: Taken = { eye: [MIDDLE, HOUSE.depth + 14, 3], target: [MIDDLE, HOUSE.depth, 5] };
    await show(2, (folder) => {
      editPlace(folder, (place) => {
        const [, second] = place.parts;
        second?.transform.splice(12, 3, MIDDLE - HOUSE.width, -30, 0);
        Object.assign(place.start, { eye: [MIDDLE, -14, 1.7], target: [MIDDLE, 0, 1.7] });
      });
      addPhotos(folder, [far, back]);
    });
    await page.keyboard.press("v");
    await page.keyboard.press("2");
    await settled(page);
    const [hidden, seen]: [Point, Point] = [[2.4, 0, 2.9], [9.6, 0, 2.9]];
    const [hiddenBefore, seenBefore] = [await colourOf(hidden), await colourOf(seen)];
    await page.keyboard.press("t");
    await shown(1);
    expect(await page.locator("veduta-photo-panel [data-field=name]").textContent()).toBe("IMG_1.png");
    expectColour(await colourOf(seen), colourAt(...pixelOf(far, seen)));
    expectColour(await colourOf(hidden), hiddenBefore, 2);
    // The other photo shows the back of the house; its front has nothing of it.
    await page.keyboard.press("n");
    await settled(page);
    await page.keyboard.press("Escape");
    await shown(1);
    expectColour(await colourOf(seen), seenBefore, 2);
    await page.keyboard.press("Escape");
    await shown(0);
    expect(complaints).toEqual([]);
  });

  it("mixes the photo and the surface as the slider says", async () => {
    await show(1, (folder) => addPhotos(folder, [BEFORE]));
    const [point] = ON_WALL as [Point];
    const bare = await colourOf(point);
    await page.keyboard.press("t");
    await shown(1);
    const slider = page.getByRole("slider", { name: "How much the photo covers the place" });
    await slider.fill("0.5");
    await page.waitForFunction(() => Math.abs((window.veduta?.photosShown()[0]?.level ?? 0) - 0.5) < 1e-6);
    await settled(page);
    expectColour(await colourOf(point), colourAt(...pixelOf(BEFORE, point)).map((v, k) => (v + (bare[k] ?? 0)) / 2));
    // In the photo one sees the place with the photo on it, not the photo before it.
    await slider.fill("1");
    await page.getByTitle("Look through this photo").click();
    await settled(page);
    await shown(1);
    expectColour(await colourOf(point), colourAt(...pixelOf(BEFORE, point)));
    expect(complaints).toEqual([]);
  });

  it("lets the photos fade in as one walks past, and lets go of them", async () => {
    const street = [0, 5, 10, 15, 20, 25].map((x): Taken => ({ eye: [x, -10, 1.7], target: [x, 0, 4] }));
    await show(2, (folder) => {
      addPhotos(folder, street);
      editPlace(folder, (place) => Object.assign(place.start, { eye: [0, -10, 1.7], target: [0, 0, 1.7] }));
    });
    expect(await page.evaluate(() => window.veduta?.photosShown())).toEqual([]);
    await page.keyboard.press("2");
    const first = async (): Promise<string> =>
      await page.evaluate(() => window.veduta?.photosShown().toSorted((a, b) => b.level - a.level)[0]?.id ?? "");
    await page.waitForFunction(() => window.veduta?.photosShown().some(({ level }) => level > 0.9) === true);
    expect(await first()).toBe("photo-1");
    await page.keyboard.down("d");
    await page.waitForFunction(() => (window.veduta?.walk().feet[0] ?? 0) > 15);
    await page.keyboard.up("d");
    await page.waitForFunction(() => {
      const photos = window.veduta?.photosShown() ?? [];
      return photos.length <= 3 && photos.some(({ id, level }) => id === "photo-4" && level > 0.9);
    });
    expect(await page.evaluate(() => window.veduta?.photosShown().some(({ id }) => id === "photo-1"))).toBe(false);
    await page.keyboard.press("v");
    await shown(0);
    await page.keyboard.press("v");
    await page.waitForFunction(() => (window.veduta?.photosShown().length ?? 0) > 0);
    await page.keyboard.press("1");
    await shown(0);
    expect(complaints).toEqual([]);
  });

  it("hangs photos on the plane of the points where there are no surfaces, and tells no metres", async () => {
    const facade = Array.from({ length: 400 }, (_, k): Point => [(k % 20) * 0.6, 0, Math.floor(k / 20) * 0.5]);
    await show(1, (folder) => {
      addPhotos(folder, [BEFORE]);
      addPoints(folder, facade);
      editPlace(folder, (place) => {
        place.parts = [];
        place.scale = "unknown";
        Object.assign(place.start, { eye: BEFORE.eye, target: BEFORE.target });
      });
    });
    expect(await page.locator("header.brand span").textContent()).toBe("1 photo, scale unknown");
    await page.getByRole("switch", { name: "Points" }).click();
    await page.getByRole("switch", { name: "Cameras" }).click();
    await page.keyboard.press("t");
    await shown(1);
    for (const point of ON_WALL) expectColour(await colourOf(point), colourAt(...pixelOf(BEFORE, point)));
    expect(complaints).toEqual([]);
  });

  it("shows and hides points, cameras, walls and the model, and says nothing of metres without a scale", async () => {
    const [, point] = ON_WALL as [Point, Point]; // the first lies below the panels
    await show(2, (folder) => {
      addPhotos(folder, [BEFORE]);
      addPoints(folder, [[20, -5, 1], [21, -5, 2]]);
      editPlace(folder, (place) => {
        place.scale = "unknown";
        const [, second] = place.parts;
        if (second !== undefined) Object.assign(second, { id: "walls", name: "Walls" });
        second?.transform.splice(12, 1, 0.01);
      });
    });
    const under = async (): Promise<string | null> => {
      const at = await project(page, point);
      await page.mouse.click(at.x, at.y);
      return (await picked(page))?.part ?? null;
    };
    // Walls lie in the model: they are hidden until they are asked for.
    expect(await under()).toBe("house-1");
    expect(await page.locator("[data-field=scale]").textContent()).toContain("scale of the place is unknown");
    expect(await page.locator("veduta-feature-panel").textContent()).not.toMatch(/\d m/);
    await page.getByRole("switch", { name: "Model" }).click();
    expect(await under()).toBeNull();
    await page.locator("veduta-records button[data-layer=walls]").click();
    expect(await under()).toBe("walls");
    const camera = await project(page, BEFORE.eye);
    const photo = async (): Promise<string | null> =>
      await page.evaluate(({ x, y }) => {
        for (let dx = -20; dx <= 20; dx += 2) {
          for (let dy = -20; dy <= 20; dy += 2) {
            const id = window.veduta?.photoUnder(x + dx, y + dy) ?? null;
            if (id !== null) return id;
          }
        }
        return null;
      }, camera);
    expect(await photo()).toBe("photo-1");
    await page.getByRole("switch", { name: "Cameras" }).click();
    expect(await photo()).toBeNull();
    expect(complaints).toEqual([]);
  });

  it("lists the photos for mouse and keyboard, and says when one is not there", async () => {
    const street = Array.from({ length: 40 }, (_, k): Taken => ({ eye: [k, -10, 1.7], target: [k, 0, 4] }));
    await show(1, (folder) => {
      addPhotos(folder, street);
      rmSync(join(folder, "pictures", "40.png"));
    });
    const list = page.getByRole("listbox", { name: "Photos" });
    expect(await list.getByRole("option").count()).toBeLessThan(25);
    await list.focus();
    for (const key of ["ArrowDown", "ArrowDown", "Enter"]) await page.keyboard.press(key);
    await settled(page);
    expect(await page.evaluate(() => window.veduta?.photo()?.name)).toBe("IMG_3.png");
    expect(await page.evaluate(() => window.veduta?.state().mode)).toBe("orbit");
    await page.keyboard.press("End");
    await page.getByRole("option", { name: "IMG_40.png" }).click();
    await page.getByText("pictures/40.png").waitFor();
    await page.keyboard.press("Escape");
    expect(complaints.every((words) => words.includes("404"))).toBe(true);
  });
});
