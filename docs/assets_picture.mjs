// A picture of a place from the front: node docs/assets_picture.mjs ADDRESS CHROMIUM FOLDER
// Writes sheet.png, without panels.
import { createRequire } from "node:module";
import { join } from "node:path";

const require = createRequire(new URL("../studio/package.json", import.meta.url));
const { chromium } = require("playwright-core");
const [address, executablePath, folder] = process.argv.slice(2);
const FLIGHT_MS = 3000;

const browser = await chromium.launch({ executablePath, args: ["--no-sandbox"] });
try {
  const page = await browser.newPage({ viewport: { width: 2600, height: 1700 } });
  await page.goto(address);
  await page.waitForSelector("html[data-veduta=ready]", { timeout: 60_000 });
  await page.evaluate(() => {
    const studio = document.querySelector("veduta-studio");
    studio.shadowRoot.querySelector("canvas").style.outline = "none";
  });
  await page.keyboard.press("KeyL");
  await page.keyboard.press("Digit2");
  await page.waitForTimeout(FLIGHT_MS);
  await page.screenshot({ path: join(folder, "sheet.png") });
} finally {
  await browser.close();
}
