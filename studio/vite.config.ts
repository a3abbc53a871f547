import { defineConfig, type Plugin } from "vite";
import { notices } from "./notices.ts";

/**
 * The page may talk to its own origin only. Textures inside a GLB become blob: addresses
 * of this page, and screenshots are data made here, hence blob: and data:. The decoder of compressed
 * tiles is WebAssembly within the page's own script.
 */
const POLICY = [
  "default-src 'self'",
  "script-src 'self' 'wasm-unsafe-eval'",
  "img-src 'self' blob: data:",
  "connect-src 'self' blob:",
  "style-src 'self'",
  "object-src 'none'",
  "base-uri 'none'",
  "form-action 'none'",
].join("; ");

function contentSecurityPolicy(): Plugin {
  return {
    name: "veduta-content-security-policy",
    apply: "build",
    transformIndexHtml: () => [
      {
        tag: "meta",
        attrs: { "http-equiv": "Content-Security-Policy", content: POLICY },
        injectTo: "head-prepend",
      },
    ],
  };
}

/** What the page needs at once, though it asks for it only when it runs. */
const EARLY = new Set(["three", "drawing"]);

/** The page names all of its program, so that a browser does not learn of one piece from another. */
function earlyPieces(): Plugin {
  return {
    name: "veduta-early-pieces",
    apply: "build",
    transformIndexHtml: {
      order: "post",
      handler: (_, { bundle, filename }) =>
        filename.endsWith("index.html")
          ? Object.values(bundle ?? {})
              .filter((piece) => piece.type === "chunk" && EARLY.has(piece.name))
              .map(({ fileName }) => ({
                tag: "link",
                attrs: { rel: "modulepreload", crossorigin: true, href: `./${fileName}` },
                injectTo: "head",
              }))
          : [],
    },
  };
}

export default defineConfig({
  base: "./",
  plugins: [contentSecurityPolicy(), earlyPieces(), notices()],
  worker: { format: "es" },
  build: {
    outDir: "../python/veduta/studio/static",
    emptyOutDir: true,
    target: "es2022",
    modulePreload: { polyfill: false },
    chunkSizeWarningLimit: 800,
    rollupOptions: {
      input: { studio: "index.html", offline: "src/offline/worker.ts" },
      output: {
        // A service worker's address stays: the browser looks there for its next version.
        entryFileNames: ({ name }) => (name === "offline" ? "offline.js" : "assets/[name]-[hash].js"),
        manualChunks: (id) =>
          id.includes("node_modules/three") ? "three" : undefined,
      },
    },
  },
});
