/**
 * Plays a walk from end to end in Chromium and says in JSON what its frames cost.
 *
 *   node playing.mjs STUDIO_FOLDER ADDRESS [PICTURE.png]
 *
 * A frame's time is from one drawn picture to the next. At a key position: within NEAR of one, where models
 * come and go.
 */
import { createRequire } from "node:module";

const [studio, address, picture] = process.argv.slice(2);
const { chromium } = createRequire(`${studio}/package.json`)("playwright-core");
const PATIENCE_MS = 200_000;
const NEAR = 0.08;
/** A frame that takes longer is a hitch. */
const HITCH_MS = 100;

const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--no-sandbox", "--enable-unsafe-swiftshader", "--disable-background-networking", "--no-first-run",
    "--enable-precise-memory-info"],
});
try {
  const page = await (await browser.newContext({ viewport: { width: 960, height: 540 }, deviceScaleFactor: 0.5 })).newPage();
  await page.goto(address, { timeout: PATIENCE_MS });
  await page.waitForFunction(() => document.documentElement.dataset.veduta === "ready", undefined, { timeout: PATIENCE_MS });
  await page.waitForFunction(() => window.veduta.strollCost()?.waiting === 0, undefined, { timeout: PATIENCE_MS });
  await page.evaluate(watch);
  await page.keyboard.press("g");
  await page.waitForFunction(() => window.watched.done, undefined, { timeout: PATIENCE_MS, polling: 200 });
  const { frames, tasks, heap } = await page.evaluate(() => window.watched);
  if (picture) await page.screenshot({ path: picture });
  console.log(JSON.stringify(told(frames, tasks, heap)));
} finally {
  await browser.close();
}

/** In the page: each frame's time, where one is, and what it cost; and the tasks of over 50 ms. */
function watch() {
  const watched = { frames: [], tasks: [], heap: 0, done: false };
  window.watched = watched;
  let [before, begun] = [performance.now(), false];
  new PerformanceObserver((list) => {
    const at = window.veduta.stroll()?.at ?? 0;
    for (const { duration } of list.getEntries()) watched.tasks.push([at, duration]);
  }).observe({ entryTypes: ["longtask"] });
  const frame = (now) => {
    const { at, playing } = window.veduta.stroll();
    const { calls, triangles, bytes, held } = window.veduta.strollCost();
    if (begun) watched.frames.push([at, now - before, calls, triangles, bytes, held]);
    watched.heap = Math.max(watched.heap, performance.memory?.usedJSHeapSize ?? 0);
    before = now;
    if (begun && !playing) watched.done = true;
    else requestAnimationFrame(frame);
    begun ||= playing;
  };
  requestAnimationFrame(frame);
}

function told(frames, tasks, heap) {
  const column = (n) => frames.map((row) => row[n]);
  const sorted = column(1).sort((a, b) => a - b);
  const last = Math.max(...column(0));
  const isKey = (at) => Math.abs(at - Math.round(at)) < NEAR && at > NEAR && at < last - NEAR;
  const [atKeys, between] = [true, false].map((wanted) => frames.filter(([at]) => isKey(at) === wanted).map((row) => row[1]));
  const hitches = (values) => values.filter((value) => value > HITCH_MS).length;
  const most = (values) => (values.length === 0 ? 0 : Math.max(...values));
  return {
    frames: frames.length,
    median_ms: sorted[Math.floor(sorted.length / 2)],
    p95_ms: sorted[Math.floor(0.95 * sorted.length)],
    keys_crossed: Math.max(0, Math.round(last) - 1),
    most_at_keys_ms: most(atKeys),
    hitches_at_keys: hitches(atKeys),
    most_between_ms: most(between),
    hitches_between: hitches(between),
    longest_task_at_keys_ms: most(tasks.filter(([at]) => isKey(at)).map((row) => row[1])),
    draw_calls: most(column(2)),
    triangles: most(column(3)),
    transitions_held: most(column(5)),
    card_MB: most(column(4)) / 1e6,
    heap_MB: heap / 1e6,
  };
}
