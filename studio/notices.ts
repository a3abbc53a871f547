import { existsSync, readFileSync, readdirSync } from "node:fs";
import { join, sep } from "node:path";
import type { Plugin } from "vite";

/** What the bundle contains of others, with their licences, as a text beside it. */
const FILE = "licences.txt";
const HEAD =
  "The studio of Veduta (Apache-2.0) contains the following works of others.\n";

export function notices(): Plugin {
  return {
    name: "veduta-notices",
    apply: "build",
    generateBundle(_options, bundle) {
      const found = new Set<string>();
      for (const chunk of Object.values(bundle)) {
        const files =
          chunk.type === "chunk" ? chunk.moduleIds : chunk.originalFileNames;
        for (const file of files) {
          const folder = packageFolder(file);
          if (folder !== undefined) found.add(folder);
        }
      }
      const texts = [...found].map(notice).sort();
      this.emitFile({
        type: "asset",
        fileName: FILE,
        source: [HEAD, ...texts].join(`\n${"-".repeat(80)}\n\n`),
      });
    },
  };
}

/** The folder of the package that a module is of; nothing where it is the studio's own. */
export function packageFolder(file: string): string | undefined {
  const clean = file.replace(/^\0/, "").split("?")[0] ?? "";
  const marker = `${sep}node_modules${sep}`;
  const whole = clean.startsWith("node_modules") ? `${sep}${clean}` : clean;
  const at = whole.lastIndexOf(marker);
  if (at < 0) return undefined;
  const words = whole.slice(at + marker.length).split(sep);
  const name = words.slice(0, words[0]?.startsWith("@") ? 2 : 1);
  const folder = whole.slice(0, at + marker.length) + name.join(sep);
  return clean.startsWith("node_modules") ? folder.slice(1) : folder;
}

function notice(folder: string): string {
  const told = JSON.parse(
    readFileSync(join(folder, "package.json"), "utf8"),
  ) as { name: string; version: string; license?: string };
  const texts = existsSync(folder)
    ? readdirSync(folder)
        .filter((name) => /^(licen[cs]e|copying|notice)/i.test(name))
        .sort()
        .map((name) => readFileSync(join(folder, name), "utf8").trim())
    : [];
  const head = `${told.name} ${told.version} (${told.license ?? "see below"})`;
  return [head, ...texts].join("\n\n") + "\n";
}
