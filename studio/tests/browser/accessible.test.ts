/** The page for those who use a keyboard or a screen reader: axe finds nothing in any of its states. */
import { mkdirSync } from "node:fs";
import { join } from "node:path";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { addAnimal } from "../fixture/animal.mjs";
import { makePlace } from "../fixture/make-place.mjs";
import { addPhotos, addPoints, editPlace } from "../fixture/photos.mjs";
import { makeRaster } from "../fixture/raster.mjs";
import { makeRooms } from "../fixture/rooms.mjs";
import { addWalk } from "../fixture/walk.mjs";
import { findings, foundAtOnce } from "./axe.ts";
import { launch, MISSING } from "./chromium.ts";
import { loseContext, open } from "./page.ts";
import { makeSite, type Site } from "./site.ts";

function addTour(folder: string): void {
  const stretches = [{ room: null, name: "The street", start_s: 0, end_s: 20 }];
  const tour = { id: "tour", name: "Tour", times_s: [0, 20], eyes: [[-4, -9, 1.7], [6, -9, 1.7]], directions: [[0, 1, 0], [0, 1, 0]], stretches };
  editPlace(folder, (place) => Object.assign(place, { tours: [tour] }));
}

/** What was recorded is here what was made of it. */
function keepRecord(folder: string): void {
  editPlace(folder, ({ parts }) => {
    for (const part of parts) part.raw = part.model;
  });
}

/** Of photos alone: points and cameras, and nothing that was made of them. */
function keepPointsAlone(folder: string): void {
  addPoints(folder, [[0, 0, 0], [4, 0, 0], [4, 0, 3], [0, 0, 3]]);
  editPlace(folder, (place) => Object.assign(place, { parts: [], scale: "unknown" }));
}

describe.skipIf(MISSING !== null)("axe", () => {
  let site: Site;
  let browser: Browser;
  let page: Page;

  beforeAll(async () => {
    [site, browser] = [await makeSite(2), await launch()];
    addPhotos(site.folder, [{ eye: [5, -14, 1.7], target: [5, 0, 5] }]);
    makeRooms(join(site.folder, "rooms"));
    makeRaster(join(site.folder, "raster"));
    for (const [name, add] of [["animal", addAnimal], ["stroll", addWalk], ["tour", addTour], ["recorded", keepRecord], ["points", keepPointsAlone]] as const) {
      const folder = join(site.folder, name);
      mkdirSync(folder);
      makePlace(folder);
      add(folder);
    }
    ({ page } = await open(browser, `${site.origin}/`));
  });

  afterAll(async () => {
    await browser.close();
    await site.close();
  });

  it("finds nothing in the place from outside", async () => {
    expect(await findings(page)).toEqual([]);
  });

  it("finds nothing in the help, nor with the layers closed", async () => {
    await page.keyboard.press("h");
    expect(await findings(page)).toEqual([]);
    await page.keyboard.press("Escape");
    await page.keyboard.press("l");
    expect(await findings(page)).toEqual([]);
    await page.keyboard.press("l");
  });

  it("finds nothing where a surface is chosen", async () => {
    const id = await page.evaluate(() => window.veduta?.features().find((one) => one.class === "window")?.id);
    const { page: other } = await open(browser, `${site.origin}/#mode=orbit&pick=${id ?? ""}`);
    await other.locator("veduta-feature-panel [data-field=name]").waitFor();
    expect(await findings(other)).toEqual([]);
    await other.context().close();
  });

  it("finds nothing while one looks through a photo", async () => {
    await page.keyboard.press("n");
    await page.waitForFunction(() => window.veduta?.photo() !== null);
    expect(await findings(page)).toEqual([]);
    await page.keyboard.press("Escape");
  });

  it("finds nothing while one walks", async () => {
    await page.keyboard.press("2");
    expect(await findings(page)).toEqual([]);
  });

  it("finds nothing in a house with its map, its lamps and its doors", async () => {
    const { page: house } = await open(browser, `${site.origin}/?place=rooms/#mode=walk`);
    expect(await findings(house)).toEqual([]);
    await house.context().close();
  });

  it("finds nothing on a phone", async () => {
    const phone = { viewport: { width: 390, height: 780 }, hasTouch: true, isMobile: true };
    const { page: small } = await open(browser, `${site.origin}/#mode=walk`, phone);
    expect(await findings(small)).toEqual([]);
    await small.context().close();
  });

  it("finds nothing while a photo lies on the place", async () => {
    const { page: other } = await open(browser, `${site.origin}/`);
    await other.keyboard.press("t");
    await other.waitForFunction(() => (window.veduta?.photosShown().length ?? 0) > 0);
    expect(await findings(other)).toEqual([]);
    await other.context().close();
  });

  it("finds nothing by night, in the colours of the classes and of what is known", async () => {
    for (const colours of ["class", "provenance"]) {
      const { page: night } = await open(browser, `${site.origin}/#mode=orbit&hour=23&colours=${colours}`);
      expect(await night.evaluate(() => window.veduta?.state())).toMatchObject({ hour: 23, colouring: colours });
      expect(await findings(night), colours).toEqual([]);
      await night.context().close();
    }
  });

  it("finds nothing while what was recorded is compared with the model", async () => {
    const { page: other } = await open(browser, `${site.origin}/?place=recorded/`);
    await other.getByRole("switch", { name: "As recorded" }).click();
    await other.getByRole("slider", { name: "as recorded" }).waitFor();
    expect(await findings(other)).toEqual([]);
    await other.context().close();
  });

  it("finds nothing while the graphics card is taken away, nor when it is back", async () => {
    const { page: other } = await open(browser, `${site.origin}/`);
    const giveBack = await loseContext(other);
    await other.getByText("took the graphics card away").waitFor();
    expect(await findings(other)).toEqual([]);
    await giveBack();
    await other.getByText("The picture is back").waitFor();
    expect(await findings(other)).toEqual([]);
    await other.context().close();
  });

  it("finds nothing where something has not come", async () => {
    const { page: other } = await open(browser, `${site.origin}/`);
    await other.route("**/house-2/model.glb", (route) => route.abort());
    await other.reload();
    await other.waitForFunction(() => (window.veduta?.stats().missing.length ?? 0) > 0);
    expect(await findings(other)).toEqual([]);
    await other.context().close();
  });

  it("finds nothing beside an animal, on a tour, and on a walk from view to view", async () => {
    for (const path of ["animal", "tour", "stroll"]) {
      const { page: other } = await open(browser, `${site.origin}/?place=${path}/`);
      if (path === "tour") await other.keyboard.press("g");
      expect(await findings(other), path).toEqual([]);
      await other.context().close();
    }
  });

  it("finds nothing in a place of points alone, nor on a raster", async () => {
    for (const path of ["points", "raster"]) {
      const { page: other } = await open(browser, `${site.origin}/?place=${path}/`);
      expect(await findings(other), path).toEqual([]);
      await other.context().close();
    }
  });

  it("finds nothing where there is no WebGL", async () => {
    const without = await launch({ webgl: false });
    for (const path of ["", "?place=stroll/"]) {
      const { page: plain } = await open(without, `${site.origin}/${path}`);
      expect(await foundAtOnce(plain)).toEqual([]);
    }
    await without.close();
  });

  it("finds nothing in the card of a place that cannot be shown", async () => {
    editPlace(site.folder, (place) => {
      place.version = "something else";
    });
    const { page: broken } = await open(browser, `${site.origin}/`);
    expect(await foundAtOnce(broken)).toEqual([]);
    await broken.context().close();
  });
});
