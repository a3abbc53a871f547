/**
 * Opens a place in Chromium and says in JSON what it cost.
 *
 *   node visit.mjs STUDIO_FOLDER ADDRESS MBIT_S [PICTURE.png]
 *
 * MBIT_S 0: as fast as the machine is. The picture is small: without a graphics card each pixel is
 * work of the processor, and what is counted here does not depend on it.
 */
import { createRequire } from "node:module";
import { countGl } from "./count-gl.mjs";

const [studio, address, mbit, picture] = process.argv.slice(2);
const { chromium } = createRequire(`${studio}/package.json`)("playwright-core");
const PATIENCE_MS = 240_000;
const CALM_MS = 2500;
const LATENCY_MS = 100;
const TURNS_MS = 2500;

const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--no-sandbox", "--enable-unsafe-swiftshader", "--disable-background-networking", "--no-first-run",
    "--enable-precise-memory-info", "--js-flags=--expose-gc"],
});
try {
  console.log(JSON.stringify(await visit()));
} finally {
  await browser.close();
}

async function visit() {
  const context = await browser.newContext({ viewport: { width: 700, height: 450 }, deviceScaleFactor: 0.4 });
  const page = await context.newPage();
  await page.addInitScript(countGl);
  await page.addInitScript(watchTasks);
  const network = await context.newCDPSession(page);
  await network.send("Network.enable");
  if (Number(mbit) > 0) {
    const rate = (Number(mbit) * 1e6) / 8;
    await network.send("Network.emulateNetworkConditions",
      { offline: false, latency: LATENCY_MS, downloadThroughput: rate, uploadThroughput: rate });
  }
  const seen = { bytes: 0, requests: 0, last: Date.now() };
  network.on("Network.loadingFinished", ({ encodedDataLength }) => {
    seen.bytes += encodedDataLength;
    seen.requests += 1;
    seen.last = Date.now();
  });
  const begin = Date.now();
  await page.goto(address, { waitUntil: "commit", timeout: PATIENCE_MS });
  const ready = () => document.documentElement?.dataset.veduta;
  await page.waitForFunction(ready, undefined, { timeout: PATIENCE_MS, polling: 50 });
  const first_s = (Date.now() - begin) / 1000;
  const state = await page.evaluate(ready);
  if (state !== "ready") return { state, first_s };
  while (Date.now() - seen.last < CALM_MS || (await page.evaluate(() => window.veduta.stats().loading ?? 0)) > 0) {
    await page.waitForTimeout(100);
  }
  const whole_s = Math.max(first_s, (seen.last - begin) / 1000);
  if (picture) await page.screenshot({ path: picture, timeout: PATIENCE_MS });
  const look = () => ({ ...window.countedGl(), frames: window.veduta.stats().frames });
  const still = await page.evaluate(look);
  await page.keyboard.down("KeyQ");
  await page.waitForTimeout(TURNS_MS);
  await page.keyboard.up("KeyQ");
  const turned = await page.evaluate(look);
  const frames = Math.max(1, turned.frames - still.frames);
  const stuck_s = await page.evaluate(() => window.longestTask_ms / 1000);
  const heap = await page.evaluate(() => (window.gc?.(), performance.memory.usedJSHeapSize));
  return {
    state, first_s, whole_s, requests: seen.requests, sent_MB: seen.bytes / 1e6,
    textures: turned.textures, card_MB: turned.texture_bytes / 1e6,
    draws: (turned.draws - still.draws) / frames, triangles: Math.round((turned.triangles - still.triangles) / frames),
    heap_MB: heap / 1e6, stuck_s, frames,
  };
}

/** Runs in the page: for how long it did not answer at worst. */
function watchTasks() {
  window.longestTask_ms = 0;
  new PerformanceObserver((list) => {
    for (const { duration } of list.getEntries()) window.longestTask_ms = Math.max(window.longestTask_ms, duration);
  }).observe({ type: "longtask", buffered: true });
}
