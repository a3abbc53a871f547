// Pictures of the studio: node docs/screenshots.mjs ADDRESS CHROMIUM FOLDER
// Writes picked.png (a window selected), walking.png, bare.png (the building without panels), and
// ground.png (its ground floor in the colours of the classes).
import { FLIGHT_MS, picture, shoot, withStudio } from "./studio_page.mjs";

await withStudio(async (open) => {
  const page = await open({ viewport: { width: 1360, height: 850 } });
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
  await shoot(page, "picked.png");

  await page.keyboard.press("Escape");
  await page.keyboard.press("KeyL");
  await page.keyboard.press("Digit2");
  await page.keyboard.press("KeyR");
  await page.waitForTimeout(FLIGHT_MS);
  await page.keyboard.down("PageUp");
  await page.waitForTimeout(150);
  await page.keyboard.up("PageUp");
  await shoot(page, "walking.png");

  await page.setViewportSize({ width: 700, height: 850 });
  await page.keyboard.press("Digit1");
  await page.keyboard.press("KeyR");
  await page.waitForTimeout(FLIGHT_MS);
  await page.evaluate(() => {
    const studio = document.querySelector("veduta-studio");
    for (const part of studio.shadowRoot.querySelectorAll(".sheet, .hint")) part.style.display = "none";
  });
  await page.screenshot({ path: picture("bare.png") });

  // The ground floor in the colours of its classes, as large as the screen allows.
  const near = await open({ viewport: { width: 1360, height: 850 }, deviceScaleFactor: 2 });
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
  await near.screenshot({ path: picture("ground.png"), clip });
});
