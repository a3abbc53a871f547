import { describe, expect, it } from "vitest";
import { packageFolder } from "../../notices.ts";

describe("packageFolder", () => {
  it("finds the package that a module is of", () => {
    expect(packageFolder("/a/node_modules/three/build/three.js")).toBe(
      "/a/node_modules/three",
    );
    expect(packageFolder("\0/a/node_modules/@lit/x/index.js?v=1")).toBe(
      "/a/node_modules/@lit/x",
    );
    expect(packageFolder("/a/node_modules/b/node_modules/c/d.js")).toBe(
      "/a/node_modules/b/node_modules/c",
    );
    expect(packageFolder("node_modules/@font/inter/a.woff2")).toBe(
      "node_modules/@font/inter",
    );
  });

  it("leaves the studio's own modules alone", () => {
    expect(packageFolder("/a/src/main.ts")).toBeUndefined();
  });
});
