// Pictures of the studio: node docs/screenshots.mjs ADDRESS CHROMIUM FOLDER
// Writes picked.png (a window selected), walking.png, bare.png (the building without panels), and
// ground.png (its ground floor in the colours of the classes).
import { createRequire } from "node:module";
import { join } from "node:path";

const require = createRequire(new URL("../studio/package.json", import.meta.url));
const { chromium } = require("playwright-core");
const [address, executablePath, folder] = process.argv.slice(2);
const FLIGHT_MS = 2500;

const browser = await chromium.launch({ executablePath, args: ["--no-sandbox"] });
try {
  const page = await browser.newPage({ viewport: { width: 1360, height: 850 } });
  await page.goto(address);
  await page.waitForSelector("html[data-veduta=ready]", { timeout: 60_000 });
  // The frame that shows the keyboard's focus belongs to a person at the keyboard, not in a picture.
  await page.evaluate(() => {
    const studio = document.querySelector("veduta-studio");
    studio.shadowRoot.querySelector("canvas").style.outline = "none";
  });
  const shoot = async (name) => {
    await page.waitForTimeout(FLIGHT_MS);
    await page.screenshot({ path: join(folder, name) });
  };
  await page.waitForTimeout(FLIGHT_MS);

  const window = await page.evaluate(() => {
    const middle = [innerWidth / 2, innerHeight / 2];
    let best = null;
    for (let y = 150; y < 650; y += 6) {
      for (let x = 330; x < 1000; x += 6) {
        const off = Math.hypot(x - middle[0] - 60, y - middle[1]);
        const hit = best === null || off < best.off ? globalThis.veduta.under(x, y) : null;
        if (hit?.feature.class === "window") best = { x, y, off };
      }
    }
    return best;
  });
  if (window === null) throw new Error("no window to pick in the picture");
  await page.mouse.click(window.x, window.y);
  await page.mouse.move(10, 840);
  await page.keyboard.press("KeyR"); // the whole building again, beside the panel
  await shoot("picked.png");

  await page.keyboard.press("Escape");
  await page.keyboard.press("KeyL");
  await page.keyboard.press("Digit2");
  await page.keyboard.press("KeyR");
  await page.waitForTimeout(FLIGHT_MS);
  await page.keyboard.down("PageUp");
  await page.waitForTimeout(150);
  await page.keyboard.up("PageUp");
  await shoot("walking.png");

  await page.setViewportSize({ width: 700, height: 850 });
  await page.keyboard.press("Digit1");
  await page.keyboard.press("KeyR");
  await page.waitForTimeout(FLIGHT_MS);
  await page.evaluate(() => {
    const studio = document.querySelector("veduta-studio");
    for (const part of studio.shadowRoot.querySelectorAll(".sheet, .hint")) part.style.display = "none";
  });
  await page.screenshot({ path: join(folder, "bare.png") });

  // The ground floor in the colours of its classes, as large as the screen allows.
  const near = await browser.newPage({ viewport: { width: 1360, height: 850 }, deviceScaleFactor: 2 });
  await near.goto(address);
  await near.waitForSelector("html[data-veduta=ready]", { timeout: 60_000 });
  await near.keyboard.press("KeyP");
  await near.waitForTimeout(FLIGHT_MS);
  const clip = await near.evaluate(() => {
    const { min, max } = globalThis.veduta.bounds();
    const corners = [min[0], max[0]].flatMap((x) => [min[2], min[2] + 5].map((z) => [x, 0, z]));
    const points = corners.map((corner) => globalThis.veduta.project(corner));
    const [xs, ys] = [points.map((p) => p.x), points.map((p) => p.y)];
    const [x, y] = [Math.min(...xs), Math.min(...ys)];
    return { x, y, width: Math.max(...xs) - x, height: Math.max(...ys) - y };
  });
  await near.screenshot({ path: join(folder, "ground.png"), clip });
} finally {
  await browser.close();
}
