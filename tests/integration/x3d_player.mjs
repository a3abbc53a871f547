// Plays house.x3d in X_ITE: node x3d_player.mjs MODULES FILE CHROMIUM PICTURE
// Prints what happened as JSON: complaints of the page, and what sensors did to doors and lamps.
import { createServer } from "node:http";
import { existsSync, readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join, normalize } from "node:path";

const [modules, file, executablePath, picture] = process.argv.slice(2);
const { chromium } = createRequire(join(modules, "..", "package.json"))("playwright-core");
const PAGE = `<!doctype html><script src="/x_ite/x_ite.min.js"></script>
<link rel="icon" href="data:,">
<style>html, body { margin: 0; height: 100% } x3d-canvas { width: 100%; height: 100%; display: block }</style>
<x3d-canvas src="/house.x3d" antialiased="false" textureQuality="LOW"></x3d-canvas>`;
const TYPES = { ".js": "text/javascript", ".html": "text/html", ".x3d": "model/x3d+xml" };

const server = createServer((request, response) => {
  const { pathname } = new URL(request.url, "http://localhost");
  const answer = (type, content) => response.writeHead(200, { "content-type": type }).end(content);
  if (pathname === "/") return answer(TYPES[".html"], PAGE);
  if (pathname === "/house.x3d") return answer(TYPES[".x3d"], readFileSync(file));
  const own = join(modules, "x_ite", "dist", normalize(pathname.replace("/x_ite/", "/")));
  if (!existsSync(own)) return response.writeHead(404).end();
  return answer(TYPES[own.slice(own.lastIndexOf("."))] ?? "application/octet-stream", readFileSync(own));
});
await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
const browser = await chromium.launch({ executablePath, args: ["--no-sandbox", "--enable-unsafe-swiftshader"] });
try {
  const page = await browser.newPage({ viewport: { width: 240, height: 160 } });
  const complaints = [];
  page.on("pageerror", (error) => complaints.push(error.message));
  page.on("console", (message) => {
    // Without a graphics card, the browser tells that it waits for the picture.
    if (/error|warning/.test(message.type()) && !/ReadPixels|GPU stall/.test(message.text())) complaints.push(message.text());
  });
  await page.goto(`http://127.0.0.1:${server.address().port}/`);
  const field = (name, key) => page.evaluate(([name, key]) => {
    const value = document.querySelector("x3d-canvas").browser.currentScene.getNamedNode(name)[key];
    return value?.angle ?? value;
  }, [name, key]);
  const until = (name, key, low, high) => page.waitForFunction(([name, key, low, high]) => {
    try {
      const value = document.querySelector("x3d-canvas").browser.currentScene.getNamedNode(name)[key];
      const number = Number(value?.angle ?? value);
      return low <= number && number <= high;
    } catch { return false; }
  }, [name, key, low, high], { timeout: 90_000, polling: 100 });
  const set = (name, key) => page.evaluate(([name, key]) => {
    document.querySelector("x3d-canvas").browser.currentScene.getNamedNode(name)[key] = true;
  }, [name, key]);
  const [leaf, lamp] = ["ground-floor-door-front-front-leaf", "ground-floor-light-l1"];
  await until("house", "visible", 1, 1);
  const before = { angle: await field(leaf, "rotation"), lamp: await field(lamp, "on") };
  await set("view-Door", "set_bind");
  await until(leaf, "rotation", 1.4, 1.7);
  await set("view-Living--ground-floor-", "set_bind");
  await until(lamp, "on", 1, 1);
  // The way there is shown, too: the picture is of its end.
  await page.evaluate(() => new Promise((resolve) => {
    let frames = 12;
    const next = () => (frames-- > 0 ? requestAnimationFrame(next) : resolve());
    next();
  }));
  await page.waitForTimeout(2000);
  await page.screenshot({ path: picture, timeout: 90_000 });
  await set("ground-floor-living-switch", "set_boolean");
  await until(lamp, "on", 0, 0);
  await set("view-Away", "set_bind");
  await until(leaf, "rotation", 0, 0.05);
  console.log(JSON.stringify({ before, complaints }));
} finally {
  await browser.close();
  server.close();
}
