/**
 * Walks through a town for long, and visits places one after another: does the page grow?
 *
 *   node long_walk.mjs STUDIO_FOLDER MINUTES STREETS ADDRESS [ADDRESS ...] [--kept FILE] [--most MINUTES]
 *
 * The first address is walked as far as a person walks in MINUTES: along one street, over to the next, back along
 * that, and so on; a picture every `STEP_M`, waited for. STREETS says where they are: `X0,X1,Y0,PITCH,COUNT` (m), the
 * ends of each, where the first one lies, how far it is to the next, and how many there are. What the page holds is
 * asked for (after a forced collection) at each end, and where the walk began at the beginning and at the end. Then
 * all addresses are opened one after another in one page, twice. Prints a line of JSON; how it goes to stderr.
 * The page is a phone's: without a graphics card each pixel and each triangle is work of the processor.
 *
 * A slow machine may take longer than a person: after `--most` minutes the walk ends where it is, and says how far it
 * came. `--kept` writes down after each street how it went. A browser that dies, or that draws nothing for a
 * quarter of an hour, is begun anew in the same street: its heap is then no longer that of one page, so each life of a
 * browser is told apart.
 */
import { writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { parseArgs } from "node:util";

const { values: options, positionals } = parseArgs({
  allowPositionals: true,
  options: { kept: { type: "string" }, most: { type: "string", default: "1e9" } },
});
const [studio, minutes, streets, ...addresses] = positionals;
const { chromium } = createRequire(`${studio}/package.json`)("playwright-core");
const PATIENCE_MS = 900_000;
const SPEED_M_S = 1.4;
const STEP_M = 30;
/** Where no picture comes for so long, one is asked for again. */
const ASK_AGAIN_MS = 20_000;
const EYE_M = 1.7;
/** So often a browser is begun anew. */
const LIVES = 4;

let turns = 0;
const walk = Number(minutes) > 0 ? await walked(addresses[0]) : {};
console.log(JSON.stringify({ ...walk, visits_MB: await visited(addresses) }));

async function launched() {
  const browser = await chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    timeout: PATIENCE_MS,
    args: ["--no-sandbox", "--enable-unsafe-swiftshader", "--disable-background-networking", "--no-first-run",
      "--disable-features=BackForwardCache"],
  });
  const context = await browser.newContext({ viewport: { width: 240, height: 156 }, deviceScaleFactor: 0.5, hasTouch: true, isMobile: true });
  context.setDefaultTimeout(PATIENCE_MS);
  return { browser, page: await context.newPage() };
}

async function visited(all) {
  const { browser, page } = await launched();
  const rounds = [[], []];
  try {
    for (const round of rounds) {
      for (const address of all) {
        await opened(page, address);
        round.push(await heap_MB(page));
        console.error("visited", address, round.at(-1));
      }
    }
  } finally {
    await browser.close();
  }
  return rounds;
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
    const isLoading = await within(page.evaluate(() => (window.veduta?.stats().loading ?? 0) > 0));
    still = isLoading ? 0 : still + 1;
    await page.waitForTimeout(200);
  }
}

/** A page that does not answer at all is given up. */
async function within(answer) {
  let timer;
  const late = new Promise((_, reject) => (timer = setTimeout(() => reject(new Error("the page does not answer")), PATIENCE_MS)));
  try {
    return await Promise.race([answer, late]);
  } finally {
    clearTimeout(timer);
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
  const before = await within(page.evaluate(() => window.veduta.stats().frames));
  for (let asked = 0; asked < PATIENCE_MS / ASK_AGAIN_MS; asked += 1) {
    turns += 1;
    const to = [eye[0] + ahead[0] + 1e-3 * (turns % 7), eye[1] + ahead[1], eye[2]];
    const hash = `mode=walk&eye=${eye.join(",")}&to=${to.join(",")}&off=&hour=12`;
    await within(page.evaluate((one) => (location.hash = one), hash));
    const isDrawn = await page
      .waitForFunction((n) => window.veduta.stats().frames > n, before, { timeout: ASK_AGAIN_MS, polling: 200 })
      .then(() => true, () => false);
    if (isDrawn) return;
  }
  throw new Error(`no picture at ${eye.join(", ")}`);
}

async function walked(address) {
  const begin = Date.now();
  const lives = [];
  const all = { metres: 0, steps: 0 };
  for (let life = 0; life < LIVES && !isOver(all, begin); life += 1) {
    const own = { from_m: all.metres, ends: [] };
    lives.push(own);
    const { browser, page } = await launched();
    try {
      await lived(page, address, { begin, all, own, lives });
    } catch (error) {
      console.error(new Date().toISOString(), "begun anew:", String(error).split("\n")[0]);
      own.died = String(error).split("\n")[0];
    } finally {
      await browser.close().catch(() => undefined);
    }
  }
  return told(all, begin, lives);
}

function isOver({ metres }, begin) {
  return metres >= 60 * Number(minutes) * SPEED_M_S || Date.now() - begin > 60_000 * Number(options.most);
}

function told({ metres, steps }, begin, lives) {
  return { minutes: Number(minutes), took_min: Math.round((Date.now() - begin) / 60_000), metres, steps, lives };
}

/** The walk goes on in a page of its own until it is over, or the page fails. */
async function lived(page, address, { begin, all, own, lives }) {
  const first = along(all.metres);
  await opened(page, address);
  await shown(page, first);
  own.begin = await state(page);
  let street = first.at;
  for (; !isOver(all, begin); all.metres += STEP_M) {
    const here = along(all.metres);
    await shown(page, here);
    all.steps += 1;
    if (all.steps % 5 === 0) console.error(new Date().toISOString(), all.metres, "m");
    if (here.at === street) continue;
    street = here.at;
    own.ends.push({ street, metres: all.metres, ...(await state(page)) });
    console.error(new Date().toISOString(), JSON.stringify(own.ends.at(-1)));
    if (options.kept) writeFileSync(options.kept, JSON.stringify(told(all, begin, lives)));
  }
  await shown(page, first);
  await page.waitForTimeout(5000);
  own.end = await state(page);
  console.error("walked", all.metres, own.begin, own.end);
}

/** What the page holds where it stands, when all is there. */
async function state(page) {
  await calm(page);
  const held = await heap_MB(page);
  const { frames, tiles, held_MB, triangles } = await page.evaluate(() => window.veduta.stats());
  return { heap_MB: held, tiles_MB: Number(held_MB.toFixed(2)), tiles, triangles, frames };
}
