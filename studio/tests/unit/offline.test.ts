import { createHash } from "node:crypto";
import { describe, expect, it } from "vitest";
import { hexOf, nameOf, readRecord } from "../../src/offline/record.ts";

const DIGEST = "ab".repeat(32);

describe("the record of an exported folder", () => {
  it("says which files there are", () => {
    const record = readRecord(JSON.stringify({ schema: "veduta/web", version: 1, files: { "a b.glb": DIGEST, "x.js": 7, y: "ab" } }));
    expect([...(record ?? [])]).toEqual([["a b.glb", DIGEST]]);
  });

  it.each([["", "null", "[]", "{}", '{"schema":"veduta/web"}', '{"schema":"other","files":{}}']].flat())("is none in %s", (text) => {
    expect(readRecord(text)).toBeNull();
  });

  it("names what lies in the folder, and nothing else", () => {
    const folder = new URL("https://example.org/places/rue/");
    const name = (path: string): string | null => nameOf(new URL(path, folder), folder);
    expect(name("parts/a%20b.glb?x=1")).toBe("parts/a b.glb");
    expect(name("./")).toBe("index.html");
    expect(name("../other/place.json")).toBeNull();
    expect(name("https://elsewhere.org/places/rue/place.json")).toBeNull();
    expect(name("%ff.glb")).toBeNull();
  });

  it("writes digests as they are written there", async () => {
    const bytes = new TextEncoder().encode("veduta");
    expect(hexOf(await crypto.subtle.digest("SHA-256", bytes))).toBe(createHash("sha256").update(bytes).digest("hex"));
  });
});
