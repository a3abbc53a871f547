// The studio in Chromium, for the scripts that take its pictures: node SCRIPT ADDRESS CHROMIUM FOLDER
import { createRequire } from "node:module";
import { join } from "node:path";

const require = createRequire(new URL("../studio/package.json", import.meta.url));
const { chromium } = require("playwright-core");
const [address, executablePath, folder] = process.argv.slice(2);

// How long the camera flies to another view, and a little more.
export const FLIGHT_MS = 3000;

/** Where the picture of that name belongs. */
export function picture(name) {
  return join(folder, name);
}

/** A picture of the page, once its camera has arrived. */
export async function shoot(page, name) {
  await page.waitForTimeout(FLIGHT_MS);
  await page.screenshot({ path: picture(name) });
}

/** Calls `work` with a function that opens a page with the loaded place, and closes the browser. */
export async function withStudio(work) {
  const browser = await chromium.launch({ executablePath, args: ["--no-sandbox"] });
  try {
    await work((options) => loaded(browser, options));
  } finally {
    await browser.close();
  }
}

async function loaded(browser, options) {
  const page = await browser.newPage(options);
  await page.goto(address);
  await page.waitForSelector("html[data-veduta=ready]", { timeout: 60_000 });
  // The frame that shows the keyboard's focus belongs to a person at the keyboard, not in a picture.
  await page.evaluate(() => {
    const studio = document.querySelector("veduta-studio");
    studio.shadowRoot.querySelector("canvas").style.outline = "none";
  });
  return page;
}
