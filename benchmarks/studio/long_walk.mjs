/**
 * Walks through a town for long, and visits places one after another: does the page grow?
 *
 *   node long_walk.mjs STUDIO_FOLDER MINUTES ADDRESS [ADDRESS ...]
 *
 * The first address is walked: as far as a person walks in MINUTES, in steps of `STEP_M` from street to
 * street, each waited for until it is drawn. Then all addresses are opened one after another in the same
 * page, and the first again. Prints a line of JSON.
 */
import { createRequire } from "node:module";

const [studio, minutes, ...addresses] = process.argv.slice(2);
const { chromium } = createRequire(`${studio}/package.json`)("playwright-core");
const PATIENCE_MS = 240_000;
const SPEED_M_S = 1.4;
const STEP_M = 25;
const EYE_M = 1.7;
/** Of a round through the town, after which the walk begins again where it began. */
const ROUND = 25;

const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--no-sandbox", "--enable-unsafe-swiftshader", "--disable-background-networking", "--no-first-run",
    "--disable-features=BackForwardCache"],
});
try {
  const page = await (await browser.newContext({ viewport: { width: 400, height: 260 }, deviceScaleFactor: 0.3 })).newPage();
  const walk = await walked(page, addresses[0]);
  const visits = [];
  for (const address of [...addresses, addresses[0]]) {
    await opened(page, address);
    visits.push(await heap_MB(page));
  }
  console.log(JSON.stringify({ ...walk, first_visit_MB: visits[0], last_visit_MB: visits.at(-1), places: addresses.length }));
} finally {
  await browser.close();
}

async function opened(page, address) {
  await page.goto("about:blank");
  await page.goto(address, { waitUntil: "commit", timeout: PATIENCE_MS });
  await page.waitForFunction(() => document.documentElement?.dataset.veduta, undefined, { timeout: PATIENCE_MS, polling: 100 });
  await calm(page);
}

async function calm(page) {
  await page.waitForFunction(() => (window.veduta.stats().loading ?? 0) === 0, undefined, { timeout: PATIENCE_MS, polling: 50 });
}

/** What the page holds after a forced collection. */
async function heap_MB(page) {
  const inner = await page.context().newCDPSession(page);
  for (let k = 0; k < 3; k += 1) await inner.send("HeapProfiler.collectGarbage");
  const { usedSize } = await inner.send("Runtime.getHeapUsage");
  await inner.detach();
  return usedSize / 1e6;
}

async function walked(page, address) {
  await opened(page, address);
  const steps = Math.round((60 * Number(minutes) * SPEED_M_S) / STEP_M);
  const { min, max } = await page.evaluate(() => window.veduta.bounds());
  const at = (step) => {
    // A round about the middle, at a third of the town's size.
    const turn = (2 * Math.PI * (step % ROUND)) / ROUND;
    const [x, y] = [0, 1].map((k) => (min[k] + max[k]) / 2 + ((max[k] - min[k]) / 3) * (k === 0 ? Math.cos(turn) : Math.sin(turn)));
    return { eye: [x, y, EYE_M], to: [x - Math.sin(turn), y + Math.cos(turn), EYE_M] };
  };
  const heaps = [];
  let frames = 0;
  for (let step = 0; step <= steps; step += 1) {
    const { eye, to } = at(step);
    const before = await page.evaluate(() => window.veduta.stats().frames);
    await page.evaluate((hash) => {
      location.hash = hash;
    }, `mode=walk&eye=${eye.join(",")}&to=${to.join(",")}&off=&hour=12`);
    await page.waitForFunction((n) => window.veduta.stats().frames > n, before, { timeout: PATIENCE_MS, polling: 50 });
    await calm(page);
    frames += 1;
    if (step % ROUND === 0 || step === steps) heaps.push(await heap_MB(page));
  }
  return {
    minutes: Number(minutes), steps: frames, begin_MB: heaps[0], rounds_MB: heaps.slice(1), most_MB: Math.max(...heaps),
  };
}
