import { readFileSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import type { Browser } from "playwright-core";
import { afterAll, afterEach, beforeAll, beforeEach, describe, expect, it } from "vitest";
import { launch, MISSING } from "./chromium.ts";
import { open, stateOf } from "./page.ts";
import { makeSite, type Site } from "./site.ts";

describe.skipIf(MISSING !== null)("what the studio says when it cannot show a place", () => {
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

  async function card(path = "/", using: Browser = browser): Promise<string> {
    const { page } = await open(using, `${site.origin}${path}`);
    expect(await stateOf(page)).toBe("error");
    const text = (await page.getByRole("alert").textContent()) ?? "";
    expect(await page.getByRole("button", { name: "Try again" }).isVisible()).toBe(true);
    await page.context().close();
    return text.replaceAll(/\s+/g, " ");
  }

  const model = (): string => join(site.folder, "house-1", "model.glb");

  it("names a place that is not there", async () => {
    rmSync(join(site.folder, "place.json"));
    const text = await card();
    expect(text).toContain("place.json");
    expect(text).toContain("not there");
    expect(text).toContain("veduta facade");
  });

  it("names a model that is not there", async () => {
    rmSync(model());
    const text = await card();
    expect(text).toContain("house-1/model.glb");
    expect(text).toContain("not there");
  });

  it("names a place that is no JSON", async () => {
    writeFileSync(join(site.folder, "place.json"), "<html>");
    expect(await card()).toContain("not JSON");
  });

  it("names a model that is cut short", async () => {
    writeFileSync(model(), readFileSync(model()).subarray(0, 4000));
    expect(await card()).toContain("cut short");
  });

  it("names a model that is broken inside", async () => {
    const bytes = readFileSync(model());
    bytes.fill(0x20, 20, 400);
    writeFileSync(model(), bytes);
    const text = await card();
    expect(text).toContain("house-1/model.glb");
    expect(text).toContain("broken");
  });

  it("refuses a place from another server", async () => {
    expect(await card("/?place=http://127.0.0.1:9/place.json")).toContain("only from the server");
  });

  it("asks for a web server when it is opened from the disk", async () => {
    const page = await (await browser.newContext()).newPage();
    await page.goto(pathToFileURL(join(site.folder, "index.html")).href);
    expect(await page.getByRole("main").textContent()).toContain("python3 -m http.server");
    expect(await stateOf(page)).toBe("error");
    await page.context().close();
  });

  it("says so when there is no WebGL, and what to do", async () => {
    const without = await launch({ webgl: false });
    try {
      const text = await card("/", without);
      expect(text).toContain("WebGL 2");
      expect(text).toContain("hardware acceleration");
    } finally {
      await without.close();
    }
  });
});
