/**
 * What a click costs in a town: a ray from each point of a grid over the picture, in milliseconds of the page.
 *
 *   node picking.mjs STUDIO_FOLDER ADDRESS VIEW
 *
 * VIEW is the part of a page's address after `#`. Each point is asked twice: the first time the library makes the
 * spheres and boxes of what it meets. Beside it stands how long a tree over as many triangles takes to grow, which a
 * pick by trees would have to wait for before its first answer. Prints a line of JSON.
 */
import { createRequire } from "node:module";

const [studio, address, view] = process.argv.slice(2);
const require = createRequire(`${studio}/package.json`);
const { chromium } = require("playwright-core");
const PATIENCE_MS = 300_000;
const STEP_PX = 100;

const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--no-sandbox", "--enable-unsafe-swiftshader", "--disable-background-networking", "--no-first-run"],
});
try {
  const page = await (await browser.newContext({ viewport: { width: 1280, height: 720 }, deviceScaleFactor: 0.2 })).newPage();
  page.setDefaultTimeout(PATIENCE_MS);
  await page.goto(`${address}#${view}`);
  await page.waitForFunction(() => document.documentElement.dataset.veduta === "ready");
  for (let still = 0; still < 6; ) {
    still = (await page.evaluate(() => window.veduta.stats().loading)) > 0 ? 0 : still + 1;
    await page.waitForTimeout(200);
  }
  const first = await page.evaluate(picked, STEP_PX);
  const again = await page.evaluate(picked, STEP_PX);
  const { triangles, tiles } = await page.evaluate(() => window.veduta.stats());
  const tree_ms = grown(Math.min(triangles, 200_000));
  console.log(JSON.stringify({ tiles, triangles, ...named("first", first), ...named("again", again), tree_of_200000_ms: tree_ms }));
} finally {
  await browser.close();
}

/** Runs in the page. */
function picked(step) {
  const took = [];
  let hits = 0;
  for (let y = step / 2; y < innerHeight; y += step) {
    for (let x = step / 2; x < innerWidth; x += step) {
      const begin = performance.now();
      hits += window.veduta.under(x, y) === null ? 0 : 1;
      took.push(performance.now() - begin);
    }
  }
  return { took: took.sort((a, b) => a - b), hits };
}

function named(when, { took, hits }) {
  const at = (share) => took[Math.min(took.length - 1, Math.floor(share * took.length))];
  return { rays: took.length, hits, [`${when}_median_ms`]: at(0.5), [`${when}_95_ms`]: at(0.95), [`${when}_worst_ms`]: at(1) };
}

/** Milliseconds for a tree over so many small triangles, as a town's are. */
function grown(count) {
  const { BufferAttribute, BufferGeometry } = require("three");
  const { MeshBVH } = require("three-mesh-bvh");
  const positions = new Float32Array(9 * count);
  for (let k = 0; k < count; k += 1) {
    const [x, y, z] = [100 * Math.random(), 100 * Math.random(), 20 * Math.random()];
    for (let c = 0; c < 3; c += 1) positions.set([x + Math.random(), y + Math.random(), z + Math.random()], 9 * k + 3 * c);
  }
  const geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(positions, 3));
  const begin = performance.now();
  new MeshBVH(geometry, { indirect: true });
  return performance.now() - begin;
}
