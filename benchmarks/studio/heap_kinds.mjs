/**
 * What grows in a page while one walks through a town: objects by their kinds at the end of each street.
 *
 *   node heap_kinds.mjs STUDIO_FOLDER ADDRESS STREETS OUT.json
 *
 * Streets of 300 m, 40 m apart, the first at y = 34 m; a picture every 60 m. After each the heap is collected three times
 * and written down by kind: how many there are, and their own bytes. The page is a phone's (see `long_walk.mjs`).
 */
import { writeFileSync } from "node:fs";
import { createRequire } from "node:module";

const [studio, address, streets, target] = process.argv.slice(2);
const { chromium } = createRequire(`${studio}/package.json`)("playwright-core");
const [LENGTH_M, STEP_M, FIRST_M, PITCH_M, EYE_M] = [300, 60, 34, 40, 1.7];
const PATIENCE_MS = 600_000;
/** Kinds that differ in their texts alone are one. */
const SAME = { string: "text", "concatenated string": "text", "sliced string": "text", code: "code", number: "number" };

const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--no-sandbox", "--enable-unsafe-swiftshader", "--disable-background-networking", "--no-first-run"],
});
const context = await browser.newContext({ viewport: { width: 240, height: 156 }, deviceScaleFactor: 0.5, hasTouch: true, isMobile: true });
context.setDefaultTimeout(PATIENCE_MS);
const page = await context.newPage();
await page.goto(address);
await page.waitForFunction(() => document.documentElement?.dataset.veduta, undefined, { polling: 200 });
let turns = 0;
const stops = [];
for (let street = 0; street < Number(streets); street += 1) {
  const isEastward = street % 2 === 0;
  for (let walked = 0; walked <= LENGTH_M; walked += STEP_M) await shown(isEastward ? walked : LENGTH_M - walked, street, isEastward ? 1 : -1);
  await calm();
  stops.push({ street, ...(await held()) });
  console.error(new Date().toISOString(), street, stops.at(-1).heap_MB);
  writeFileSync(target, JSON.stringify(stops));
}
await browser.close();

async function calm() {
  for (let still = 0; still < 8; ) {
    const isLoading = await page.evaluate(() => (window.veduta?.stats().loading ?? 0) > 0);
    still = isLoading ? 0 : still + 1;
    await page.waitForTimeout(150);
  }
}

/** A hash that is there already changes nothing, so each ask turns the head a little. */
async function shown(x, street, ahead) {
  const y = FIRST_M + PITCH_M * street;
  const before = await page.evaluate(() => window.veduta.stats().frames);
  for (let asked = 0; asked < 20; asked += 1) {
    turns += 1;
    const hash = `mode=walk&eye=${x},${y},${EYE_M}&to=${x + ahead},${y + 1e-3 * (turns % 7)},${EYE_M}&off=&hour=12`;
    await page.evaluate((one) => (location.hash = one), hash);
    const drawn = page.waitForFunction((n) => window.veduta.stats().frames > n, before, { timeout: 8000, polling: 100 });
    if (await drawn.then(() => true, () => false)) return;
  }
}

async function held() {
  const inner = await context.newCDPSession(page);
  for (let k = 0; k < 3; k += 1) await inner.send("HeapProfiler.collectGarbage");
  const { usedSize } = await inner.send("Runtime.getHeapUsage");
  const parts = [];
  inner.on("HeapProfiler.addHeapSnapshotChunk", ({ chunk }) => parts.push(chunk));
  await inner.send("HeapProfiler.takeHeapSnapshot", { reportProgress: false });
  await inner.detach();
  const { tiles, held_MB } = await page.evaluate(() => window.veduta.stats());
  return { heap_MB: Number((usedSize / 1e6).toFixed(2)), tiles_MB: Number(held_MB.toFixed(2)), tiles, kinds: kindsOf(JSON.parse(parts.join(""))) };
}

function kindsOf({ snapshot: { meta }, nodes, strings }) {
  const width = meta.node_fields.length;
  const [type, name, size] = ["type", "name", "self_size"].map((field) => meta.node_fields.indexOf(field));
  const kinds = {};
  for (let at = 0; at < nodes.length; at += width) {
    const kind = meta.node_types[0][nodes[at + type]];
    const key = SAME[kind] ?? `${kind} ${strings[nodes[at + name]].slice(0, 60)}`;
    kinds[key] ??= { count: 0, bytes: 0 };
    kinds[key].count += 1;
    kinds[key].bytes += nodes[at + size];
  }
  return kinds;
}
