/** A static server for the tests: the built studio with a place beside it. */
import { cpSync, existsSync, mkdtempSync, readFileSync, rmSync, statSync } from "node:fs";
import { createServer, type Server } from "node:http";
import type { AddressInfo } from "node:net";
import { tmpdir } from "node:os";
import { extname, join, normalize } from "node:path";
import { fileURLToPath } from "node:url";
import { makePlace } from "../fixture/make-place.mjs";

const STATIC = fileURLToPath(new URL("../../../python/veduta/studio/static", import.meta.url));
const TYPES: Readonly<Record<string, string>> = {
  ".html": "text/html",
  ".js": "text/javascript",
  ".css": "text/css",
  ".svg": "image/svg+xml",
  ".json": "application/json",
  ".png": "image/png",
  ".glb": "model/gltf-binary",
  ".woff2": "font/woff2",
};

export interface Site {
  readonly origin: string;
  /** The folder that is served; a test may damage its own. */
  readonly folder: string;
  /** The server ends, and is there again at the same address. */
  leave(): Promise<void>;
  comeBack(): Promise<void>;
  close(): Promise<void>;
}

export async function makeSite(houses = 1): Promise<Site> {
  if (!existsSync(join(STATIC, "index.html"))) {
    throw new Error(`${STATIC}: the studio has not been built. Run \`npm run build\` in studio/.`);
  }
  const folder = mkdtempSync(join(tmpdir(), "veduta-studio-"));
  cpSync(STATIC, folder, { recursive: true });
  makePlace(folder, houses);
  let server = serve(folder);
  const listen = async (at: number): Promise<void> => await new Promise((resolve) => server.listen(at, "127.0.0.1", resolve));
  await listen(0);
  const { port } = server.address() as AddressInfo;
  const leave = async (): Promise<void> => {
    server.closeAllConnections();
    await new Promise((resolve) => server.close(resolve));
  };
  return {
    origin: `http://127.0.0.1:${port}`,
    folder,
    leave,
    comeBack: async () => {
      server = serve(folder);
      await listen(port);
    },
    close: async () => {
      await leave();
      rmSync(folder, { recursive: true, force: true });
    },
  };
}

function serve(folder: string): Server {
  return createServer((request, response) => {
    const { pathname } = new URL(request.url ?? "/", "http://localhost");
    const name = pathname.endsWith("/") ? `${pathname}index.html` : pathname;
    const file = join(folder, normalize(decodeURIComponent(name)));
    if (!file.startsWith(folder) || !existsSync(file) || !statSync(file).isFile()) {
      response.writeHead(404).end("not there");
      return;
    }
    const content = readFileSync(file);
    response.writeHead(200, {
      "content-type": TYPES[extname(file)] ?? "application/octet-stream",
      "content-length": content.length,
    });
    response.end(content);
  });
}
