/** An animal that goes behind a house: the first picture shows it, and it is seen to move. */
import type { Page } from "playwright-core";
import { describe, expect } from "vitest";
import { ANIMAL, addAnimal } from "../fixture/animal.mjs";
import { HOUSE } from "../fixture/house.mjs";
import { MISSING } from "./chromium.ts";
import { around, look, project, settled } from "./page.ts";
import { visits } from "./visits.ts";

const it = visits(addAnimal);

type Point = readonly [number, number, number];

const place = async (page: Page): Promise<Point> => {
  const [animal] = await page.evaluate(() => window.veduta?.animals() ?? []);
  if (animal === undefined) throw new Error("there is no animal");
  return animal.place;
};

/** Lets it stand, so that what is asked of it is what the picture shows. */
const stand = async (page: Page): Promise<Point> => {
  await page.getByRole("button", { name: "Let Bar stand" }).click();
  await page.waitForFunction(() => window.veduta?.animals()[0]?.pace === 0);
  await settled(page);
  return await place(page);
};

/** How much redder than all else the picture is where the animal's middle is. */
const redness = async (page: Page, [x, y]: Point): Promise<number> => {
  const { mean } = await look(page, around(await project(page, [x, y, ANIMAL.height / 2]), 6));
  return mean[0] - Math.max(mean[1], mean[2]);
};

describe.skipIf(MISSING !== null)("a place with an animal", () => {
  it("shows it at first, though it is behind the house, and as large as it takes", async ({ page }) => {
    const at = await stand(page);
    expect(await redness(page, at)).toBeGreaterThan(60);
    const [foot, top] = [await project(page, at), await project(page, [at[0], at[1], ANIMAL.height])];
    expect(foot.y - top.y).toBeGreaterThan(25);
  });

  it("moves, and the camera with it", async ({ page }) => {
    const before = await stand(page);
    await page.getByRole("button", { name: "Let Bar go" }).click();
    await page.waitForFunction(([x, y]) => {
      const now = window.veduta?.animals()[0]?.place ?? [x, y];
      return Math.hypot(now[0] - x, now[1] - y) > 1;
    }, before);
    expect(await redness(page, await stand(page))).toBeGreaterThan(60);
    expect(await redness(page, before)).toBeLessThan(30);
  });

  it("is led round the house, and not through it", { timeout: 90_000 }, async ({ page }) => {
    await stand(page);
    const goal: Point = [HOUSE.width / 2, -2.5, 0];
    await page.evaluate((at) => window.veduta?.do("lead", { which: 0, goal: at }), goal);
    await page.getByRole("button", { name: "Let Bar go" }).click();
    const way: Point[] = [];
    for (let n = 0; n < 400; n += 1) {
      const at = await place(page);
      way.push(at);
      if (Math.hypot(at[0] - goal[0], at[1] - goal[1]) < 0.1) break;
      await page.waitForTimeout(150);
    }
    const within = way.filter(([x, y]) => x > 0 && x < HOUSE.width && y > 0 && y < HOUSE.depth);
    expect(within).toEqual([]);
    const [x, y] = way.at(-1) ?? [0, 0];
    expect(Math.hypot(x - goal[0], y - goal[1])).toBeLessThan(0.1);
    // Within the wall nobody stands: it is said, and it stays where it is.
    await page.evaluate((at) => window.veduta?.do("lead", { which: 0, goal: at }), [0, HOUSE.depth / 2, 0] as Point);
    await page.getByText("It finds no way there").waitFor();
  });
});
