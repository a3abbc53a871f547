/** Chromium for the tests: which one, with which flags, and why there may be none. */
import { existsSync } from "node:fs";
import { type Browser, chromium } from "playwright-core";

const EXECUTABLE = process.env.CHROMIUM ?? "/usr/bin/chromium";

/** Why the browser tests cannot run; null where they can. */
export const MISSING = existsSync(EXECUTABLE)
  ? null
  : `no Chromium at ${EXECUTABLE}: install the package "chromium", or set CHROMIUM to its path`;

if (MISSING !== null) console.warn(`Browser tests SKIPPED: ${MISSING}`);

// The profile is a new empty folder: Playwright makes one for each launch.
const FLAGS = [
  "--no-sandbox",
  "--disable-background-networking",
  "--disable-component-update",
  "--disable-sync",
  "--no-first-run",
  "--disable-quic",
];
const SOFTWARE_GL = ["--enable-unsafe-swiftshader"];
const NO_GL = ["--disable-gpu", "--disable-3d-apis"];

export async function launch(options: { webgl: boolean } = { webgl: true }): Promise<Browser> {
  return await chromium.launch({
    executablePath: EXECUTABLE,
    args: [...FLAGS, ...(options.webgl ? SOFTWARE_GL : NO_GL)],
  });
}
