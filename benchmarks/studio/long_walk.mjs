/**
 * Walks through a town for long, and visits places one after another: does the page grow?
 *
 *   node long_walk.mjs STUDIO_FOLDER MINUTES STREETS ADDRESS [ADDRESS ...]
 *
 * The first address is walked as far as a person walks in MINUTES: along one street, over to the next, back along
 * that, and so on; a picture every `STEP_M`, waited for. STREETS says where they are: `X0,X1,Y0,PITCH,COUNT` (m), the
 * ends of each, where the first one lies, how far it is to the next, and how many there are. What the page holds is
 * asked for (after a forced collection) at each end, and where the walk began at the beginning and at the end. Then
 * all addresses are opened one after another in one page, twice. Prints a line of JSON; how it goes to stderr.
 * The page is a phone's: without a graphics card each pixel and each triangle is work of the processor.
 */
import { createRequire } from "node:module";

const [studio, minutes, streets, ...addresses] = process.argv.slice(2);
const { chromium } = createRequire(`${studio}/package.json`)("playwright-core");
const PATIENCE_MS = 900_000;
const SPEED_M_S = 1.4;
const STEP_M = 30;
/** Where no picture comes for so long, one is asked for again. */
const ASK_AGAIN_MS = 20_000;
const EYE_M = 1.7;

let turns = 0;
const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--no-sandbox", "--enable-unsafe-swiftshader", "--disable-background-networking", "--no-first-run",
    "--disable-features=BackForwardCache"],
});
try {
  const context = await browser.newContext({ viewport: { width: 400, height: 260 }, deviceScaleFactor: 0.3, hasTouch: true, isMobile: true });
  const walk = Number(minutes) > 0 ? await walked(await context.newPage(), addresses[0]) : {};
  const visitor = await context.newPage();
  const rounds = [[], []];
  for (const round of rounds) {
    for (const address of addresses) {
      await opened(visitor, address);
      round.push(await heap_MB(visitor));
      console.error("visited", address, round.at(-1));
    }
  }
  console.log(JSON.stringify({ ...walk, visits_MB: rounds }));
} finally {
  await browser.close();
}

async function opened(page, address) {
  await page.goto("about:blank");
  await page.goto(address, { waitUntil: "commit", timeout: PATIENCE_MS });
  await page.waitForFunction(() => document.documentElement?.dataset.veduta, undefined, { timeout: PATIENCE_MS, polling: 200 });
  await calm(page);
}

/** Waits until nothing has been on its way for a while. */
async function calm(page) {
  for (let still = 0; still < 10; ) {
    const isLoading = await page.evaluate(() => (window.veduta?.stats().loading ?? 0) > 0);
    still = isLoading ? 0 : still + 1;
    await page.waitForTimeout(200);
  }
}

/** What the page holds after a forced collection. */
async function heap_MB(page) {
  const inner = await page.context().newCDPSession(page);
  for (let k = 0; k < 3; k += 1) await inner.send("HeapProfiler.collectGarbage");
  const { usedSize } = await inner.send("Runtime.getHeapUsage");
  await inner.detach();
  return Number((usedSize / 1e6).toFixed(2));
}

/** Where one is after so many metres, which way one walks, and along which street. */
function along(metres) {
  const [west, east, south, pitch, count] = streets.split(",").map(Number);
  const leg = east - west + pitch;
  const at = Math.floor(metres / leg);
  const [street, rest] = [at % count, metres - at * leg];
  const isEastward = at % 2 === 0;
  const y = south + pitch * street;
  const walked_m = Math.min(rest, east - west);
  const x = isEastward ? west + walked_m : east - walked_m;
  if (rest > east - west) return { at, eye: [x, y + rest - (east - west), EYE_M], ahead: [0, 1] };
  return { at, eye: [x, y, EYE_M], ahead: [isEastward ? 1 : -1, 0] };
}

/** A picture from there; a hash that is there already changes nothing, so each ask turns the head a little. */
async function shown(page, { eye, ahead }) {
  const before = await page.evaluate(() => window.veduta.stats().frames);
  for (let asked = 0; asked < PATIENCE_MS / ASK_AGAIN_MS; asked += 1) {
    turns += 1;
    const to = [eye[0] + ahead[0] + 1e-3 * (turns % 7), eye[1] + ahead[1], eye[2]];
    await page.evaluate((hash) => (location.hash = hash), `mode=walk&eye=${eye.join(",")}&to=${to.join(",")}&off=&hour=12`);
    const isDrawn = await page
      .waitForFunction((n) => window.veduta.stats().frames > n, before, { timeout: ASK_AGAIN_MS, polling: 200 })
      .then(() => true, () => false);
    if (isDrawn) return;
  }
  throw new Error(`no picture at ${eye.join(", ")}`);
}

async function walked(page, address) {
  await opened(page, address);
  await shown(page, along(0));
  await calm(page);
  const begin_MB = await heap_MB(page);
  const begin = Date.now();
  const ends_MB = [];
  const most_m = 60 * Number(minutes) * SPEED_M_S;
  let [steps, street, metres] = [0, 0, 0];
  for (; metres < most_m; metres += STEP_M) {
    const here = along(metres);
    await shown(page, here);
    steps += 1;
    if (here.at === street) continue;
    street = here.at;
    await calm(page);
    ends_MB.push(await heap_MB(page));
    console.error(new Date().toISOString(), "street", street, ends_MB.at(-1), await page.evaluate(() => JSON.stringify(window.veduta.stats())));
  }
  const frames = await page.evaluate(() => window.veduta.stats().frames);
  await shown(page, along(0));
  await calm(page);
  await page.waitForTimeout(5000);
  const end_MB = await heap_MB(page);
  console.error("walked", metres, begin_MB, end_MB);
  return {
    minutes: Number(minutes), took_min: Math.round((Date.now() - begin) / 60_000), metres: Math.round(metres),
    steps, frames, begin_MB, end_MB, ends_MB,
  };
}
