/**
 * Plays a walk from end to end in Chromium and says in JSON what its frames cost.
 *
 *   node playing.mjs STUDIO_FOLDER ADDRESS [PICTURE.png] [--ahead] [--card]
 *
 * A frame's time is from one drawn picture to the next. At a key position: within NEAR of one, where models
 * come and go. processor: what all of the browser spent in a frame, its renderer in software included;
 * unlike the clock's, that time does not grow when other programs want the cores. --ahead: the browser
 * goes before these, which needs root. --card: drawn by the machine's graphics card, through Vulkan.
 */
import { readdirSync, readFileSync } from "node:fs";
import { setPriority } from "node:os";
import { createRequire } from "node:module";

const ahead = process.argv.includes("--ahead");
const onCard = process.argv.includes("--card");
const [studio, address, picture] = process.argv.slice(2).filter((word) => !word.startsWith("--"));
const { chromium } = createRequire(`${studio}/package.json`)("playwright-core");
const PATIENCE_MS = 900_000;
const NEAR = 0.08;
/** So long after a key position what is next on the way is read. */
const READ = 0.5;
/** A frame that takes longer is a hitch. */
const HITCH_MS = 100;
const SAMPLE_MS = 10;
const RENDERER = onCard
  ? ["--use-angle=vulkan", "--enable-features=Vulkan", "--ignore-gpu-blocklist", "--disable-vulkan-surface"]
  : ["--enable-unsafe-swiftshader"];
/** Before all other programs. */
const FIRST = -18;

const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--no-sandbox", ...RENDERER, "--disable-background-networking", "--no-first-run",
    "--enable-precise-memory-info"],
});
try {
  const page = await (await browser.newContext({ viewport: { width: 960, height: 540 }, deviceScaleFactor: 0.5 })).newPage();
  await page.goto(address, { timeout: PATIENCE_MS });
  await page.waitForFunction(() => document.documentElement.dataset.veduta === "ready", undefined, { timeout: PATIENCE_MS });
  await page.waitForFunction(() => window.veduta.strollCost()?.waiting === 0, undefined, { timeout: PATIENCE_MS });
  await page.evaluate(watch);
  const spent = await meter();
  await page.keyboard.press("g");
  await page.waitForFunction(() => window.watched.done, undefined, { timeout: PATIENCE_MS, polling: 200 });
  const { frames, tasks, heap, origin } = await page.evaluate(() => ({ ...window.watched, origin: performance.timeOrigin }));
  const costs = spent.between(frames.map((row) => [origin + row[6] - row[1], origin + row[6]]));
  if (picture) await page.screenshot({ path: picture });
  console.log(JSON.stringify(told(frames, tasks, heap, costs)));
} finally {
  await browser.close();
}

/** Samples, until it is asked, the processor's time of all processes and threads of the browser (ms). */
async function meter() {
  const session = await browser.newBrowserCDPSession();
  const pids = (await session.send("SystemInfo.getProcessInfo")).processInfo.map(({ id }) => id);
  const ofThreads = (tell) => {
    let sum = 0;
    for (const pid of pids) {
      try {
        for (const task of readdirSync(`/proc/${pid}/task`)) sum += tell(pid, task);
      } catch {
        continue; // it ended just now
      }
    }
    return sum;
  };
  // Chromium gives its threads priorities of its own: whoever began it first has no say in them.
  if (ahead) ofThreads((_, task) => setPriority(Number(task), FIRST) ?? 0);
  const spent = () =>
    ofThreads((pid, task) => Number(readFileSync(`/proc/${pid}/task/${task}/schedstat`, "utf8").split(" ")[0])) / 1e6;
  const samples = [];
  const take = () => samples.push([performance.timeOrigin + performance.now(), spent()]);
  take();
  const timer = setInterval(take, SAMPLE_MS);
  const at = (time) => {
    const after = samples.findIndex(([when]) => when >= time);
    if (after <= 0) return samples.at(after)[1];
    const [[t0, s0], [t1, s1]] = [samples[after - 1], samples[after]];
    return s0 + ((s1 - s0) * (time - t0)) / (t1 - t0);
  };
  const between = (spans) => {
    clearInterval(timer);
    take();
    return spans.map(([begin, end]) => at(end) - at(begin));
  };
  return { between };
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
    if (begun) watched.frames.push([at, now - before, calls, triangles, bytes, held, now]);
    watched.heap = Math.max(watched.heap, performance.memory?.usedJSHeapSize ?? 0);
    before = now;
    if (begun && !playing) watched.done = true;
    else requestAnimationFrame(frame);
    begun ||= playing;
  };
  requestAnimationFrame(frame);
}

function told(frames, tasks, heap, costs) {
  const column = (n) => frames.map((row) => row[n]);
  const sorted = column(1).sort((a, b) => a - b);
  const spent = [...costs].sort((a, b) => a - b);
  const last = Math.max(...column(0));
  const isKey = (at) => Math.abs(at - Math.round(at)) < NEAR && at > NEAR && at < last - NEAR;
  const parted = (values) => [true, false].map((wanted) => values.filter((_, n) => isKey(frames[n][0]) === wanted));
  const [atKeys, between] = parted(column(1));
  const [spentAtKeys, spentBetween] = parted(costs);
  const afterKeys = frames.filter(([at]) => at > 1 && at < last - NEAR && at % 1 < READ).map((row) => row[1]);
  const hitches = (values) => values.filter((value) => value > HITCH_MS).length;
  const most = (values) => (values.length === 0 ? 0 : Math.max(...values));
  return {
    frames: frames.length,
    median_ms: sorted[Math.floor(sorted.length / 2)],
    p95_ms: sorted[Math.floor(0.95 * sorted.length)],
    keys_crossed: Math.max(0, Math.round(last) - 1),
    most_at_keys_ms: most(atKeys),
    hitches_at_keys: hitches(atKeys),
    most_after_keys_ms: most(afterKeys),
    hitches_after_keys: hitches(afterKeys),
    most_between_ms: most(between),
    hitches_between: hitches(between),
    processor_median_ms: spent[Math.floor(spent.length / 2)],
    processor_p95_ms: spent[Math.floor(0.95 * spent.length)],
    processor_most_at_keys_ms: most(spentAtKeys),
    processor_most_between_ms: most(spentBetween),
    longest_task_at_keys_ms: most(tasks.filter(([at]) => isKey(at)).map((row) => row[1])),
    draw_calls: most(column(2)),
    triangles: most(column(3)),
    transitions_held: most(column(5)),
    card_MB: most(column(4)) / 1e6,
    heap_MB: heap / 1e6,
  };
}
