/** Opening the studio in a page, and looking at what it draws. */
import type { Browser, BrowserContextOptions, Page } from "playwright-core";
import type {} from "../../src/app/inspect.ts";

export interface OpenedPage {
  readonly page: Page;
  /** Errors of the page and requests that left its origin. */
  readonly complaints: string[];
}

const DESKTOP = { width: 1280, height: 720 };
/** Without a graphics card drawing takes its time, pixel by pixel: a quarter of them show all that the tests look at. */
const SHARPNESS = 0.5;

export async function open(
  browser: Browser,
  url: string,
  context: BrowserContextOptions = {},
  device: () => void = () => undefined,
): Promise<OpenedPage> {
  const page = await (await browser.newContext({ viewport: DESKTOP, deviceScaleFactor: SHARPNESS, serviceWorkers: "block", ...context })).newPage();
  await page.addInitScript(device);
  const complaints: string[] = [];
  const { origin } = new URL(url);
  page.on("pageerror", (error) => complaints.push(`error: ${error.message}`));
  page.on("console", (message) => {
    if (message.type() === "error") complaints.push(`console: ${message.text()}`);
  });
  page.on("request", (request) => {
    const to = request.url();
    if (!to.startsWith(`${origin}/`) && !/^(blob|data):/.test(to)) complaints.push(`request: ${to}`);
  });
  await page.goto(url);
  await page.waitForFunction(() => document.documentElement.dataset.veduta !== undefined);
  return { page, complaints };
}

export async function stateOf(page: Page): Promise<string | undefined> {
  return await page.evaluate(() => document.documentElement.dataset.veduta);
}

/** Calls the page's inspection API; `null` where it is not there. */
export type Inspection = NonNullable<Window["veduta"]>;

export async function picked(page: Page): Promise<ReturnType<Inspection["picked"]>> {
  return await page.evaluate(() => window.veduta?.picked() ?? null);
}

export async function walkState(page: Page): Promise<ReturnType<Inspection["walk"]>> {
  const state = await page.evaluate(() => window.veduta?.walk());
  if (state === undefined) throw new Error("window.veduta is not there");
  return state;
}

/** Where a point of the world is on the page, CSS pixels. */
export async function project(page: Page, point: readonly [number, number, number]): Promise<{ x: number; y: number }> {
  const at = await page.evaluate((p) => window.veduta?.project(p as [number, number, number]) ?? null, point);
  if (at === null) throw new Error(`the camera does not see ${point.join(", ")}`);
  return at;
}

export async function settled(page: Page): Promise<void> {
  await page.waitForFunction(() => window.veduta?.state().flying === false);
  // Two frames: the one that is due, and the one that it may ask for.
  await page.evaluate(
    () => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))),
  );
}

/** Takes the graphics card away from the page; the result gives it back. */
export async function loseContext(page: Page): Promise<() => Promise<void>> {
  const taker = await page.evaluateHandle(() => {
    const canvas = document.querySelector("veduta-studio")?.shadowRoot?.querySelector("canvas");
    const found = canvas?.getContext("webgl2")?.getExtension("WEBGL_lose_context");
    if (found === null || found === undefined) throw new Error("there is no card to take away");
    found.loseContext();
    return found;
  });
  return async () => await taker.evaluate((one) => one.restoreContext());
}

export interface Look {
  /** Standard deviation of the luminance, 0..255. */
  readonly spread: number;
  readonly mean: readonly [number, number, number];
}

/** Statistics of a region of the page as the person sees it. */
export async function look(page: Page, clip: Clip): Promise<Look> {
  return lookOf(await pixelsOf(page, clip));
}

/** Pixels that are darker or brighter than all four neighbours by so much (luminance, 0..255), as a share of all. */
export async function specks(page: Page, clip: Clip, by: number): Promise<number> {
  const { width, luminance } = await pixelsOf(page, clip);
  let found = 0;
  for (let at = width; at < luminance.length - width; at += 1) {
    const own = luminance[at] ?? 0;
    const others = [at - 1, at + 1, at - width, at + width].map((one) => own - (luminance[one] ?? 0));
    if (others.every((more) => more > by) || others.every((more) => more < -by)) found += 1;
  }
  return found / luminance.length;
}

interface Clip {
  readonly x: number;
  readonly y: number;
  readonly width: number;
  readonly height: number;
}

/** Pixels by rows. */
interface Pixels {
  readonly width: number;
  readonly luminance: readonly number[];
  readonly mean: readonly [number, number, number];
}

async function pixelsOf(page: Page, clip: Clip): Promise<Pixels> {
  const png = (await page.screenshot({ clip })).toString("base64");
  // A page of its own: the studio's content policy need not allow what the test does.
  const helper = await page.context().newPage();
  try {
    return await helper.evaluate(readPixels, png);
  } finally {
    await helper.close();
  }
}

async function readPixels(png: string): Promise<Pixels> {
  const bytes = Uint8Array.from(atob(png), (c) => c.charCodeAt(0));
  const bitmap = await createImageBitmap(new Blob([bytes], { type: "image/png" }));
  const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
  const context = canvas.getContext("2d");
  if (context === null) throw new Error("no 2D canvas");
  context.drawImage(bitmap, 0, 0);
  const { data } = context.getImageData(0, 0, bitmap.width, bitmap.height);
  const sums: [number, number, number] = [0, 0, 0];
  const luminance: number[] = [];
  for (let i = 0; i < data.length; i += 4) {
    const [r, g, b] = [data[i] ?? 0, data[i + 1] ?? 0, data[i + 2] ?? 0];
    luminance.push(0.2126 * r + 0.7152 * g + 0.0722 * b);
    sums[0] += r;
    sums[1] += g;
    sums[2] += b;
  }
  const n = luminance.length;
  return { width: bitmap.width, luminance, mean: [sums[0] / n, sums[1] / n, sums[2] / n] };
}

function lookOf({ luminance, mean }: Pixels): Look {
  const n = luminance.length;
  const middle = luminance.reduce((sum, one) => sum + one, 0) / n;
  return { spread: Math.sqrt(luminance.reduce((sum, one) => sum + (one - middle) ** 2, 0) / n), mean };
}

/** A square of the page around a point. */
export function around(at: { x: number; y: number }, size = 12): Clip {
  return { x: at.x - size / 2, y: at.y - size / 2, width: size, height: size };
}
