/** An exported folder within a page of somebody else: the view of its address, full screen where it is allowed. */
import { createServer, type Server } from "node:http";
import type { AddressInfo } from "node:net";
import type { Browser, Frame, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { launch, MISSING } from "./chromium.ts";
import { makeSite, type Site } from "./site.ts";

describe.skipIf(MISSING !== null)("an exported folder in a frame", () => {
  let browser: Browser;
  let site: Site;
  let host: Server;
  let origin: string;

  beforeAll(async () => {
    [browser, site] = [await launch(), await makeSite(2)];
    // Another port is another origin.
    const frame = (allow: string, path: string): string =>
      `<iframe title="A street" ${allow} src="${site.origin}/${path}" style="width: 640px; height: 400px"></iframe>`;
    const view = "#mode=walk&eye=4,-9,1.7&to=4,0,3&colours=class&hour=14";
    const pages: Record<string, string> = {
      "/": `<!doctype html><title>Host</title><p>Read on.</p>${frame('allow="fullscreen; xr-spatial-tracking"', view)}`,
      "/plain": `<!doctype html><title>Host</title>${frame("", view)}`,
    };
    host = createServer((request, response) => {
      response.writeHead(200, { "content-type": "text/html" }).end(pages[request.url ?? ""] ?? "");
    });
    await new Promise<void>((resolve) => host.listen(0, "127.0.0.1", resolve));
    origin = `http://127.0.0.1:${(host.address() as AddressInfo).port}`;
  });
  afterAll(async () => {
    await browser.close();
    host.close();
    await site.close();
  });

  async function embedded(path: string): Promise<{ page: Page; frame: Frame }> {
    const page = await (await browser.newContext({ viewport: { width: 900, height: 600 }, deviceScaleFactor: 0.5 })).newPage();
    await page.goto(`${origin}${path}`);
    const frame = page.frames()[1];
    if (frame === undefined) throw new Error("there is no frame");
    await frame.waitForFunction(() => document.documentElement.dataset.veduta !== undefined);
    return { page, frame };
  }

  it("shows the view that its address says, and leaves the address of the page alone", async () => {
    const { page, frame } = await embedded("/");
    expect(await frame.evaluate(() => document.documentElement.dataset.veduta)).toBe("ready");
    expect(await frame.evaluate(() => window.veduta?.state())).toMatchObject({ mode: "walk", colouring: "class", hour: 14 });
    const eye = await frame.evaluate(() => window.veduta?.camera().eye);
    expect(eye?.[0]).toBeCloseTo(4, 1);
    expect(eye?.[1]).toBeCloseTo(-9, 1);
    await frame.locator("canvas").first().click({ position: { x: 320, y: 100 } });
    await page.keyboard.press("p");
    await frame.waitForFunction(() => location.hash.includes("colours=provenance"));
    expect(page.url()).toBe(`${origin}/`);
    await page.context().close();
  });

  it("goes to full screen where the page allows it, and says so where it does not", async () => {
    const { page, frame } = await embedded("/");
    await frame.getByRole("button", { name: "Full screen" }).click();
    await frame.waitForFunction(() => document.fullscreenElement !== null);
    await page.context().close();
    const { page: other, frame: plain } = await embedded("/plain");
    await plain.getByRole("button", { name: "Full screen" }).click();
    await plain.getByText("does not allow full screen here").waitFor();
    await other.context().close();
  });
});
