import { Group } from "three";
import { afterEach, describe, expect, it, vi } from "vitest";
import type { Layer } from "../../src/core/state.ts";
import type { Cloud } from "../../src/core/place.ts";
import { CloudArrivals, showClouds } from "../../src/three/clouds.ts";
import { readPoints } from "../../src/three/points.ts";
import { Fake } from "./surroundings.ts";

/** Which of the clouds of these layers are seen, some layers being off. */
function seen(layers: readonly Layer[], off: readonly Layer[]): boolean[] {
  const clouds = new Group();
  for (const layer of layers) {
    const cloud = new Group();
    cloud.userData.layer = layer;
    clouds.add(cloud);
  }
  showClouds(clouds, new Set(off));
  return clouds.children.map(({ visible }) => visible);
}

/** A text of so many points, of whose head it has more. */
function ply(points: number, told = points): ArrayBuffer {
  const head = ["ply", "format ascii 1.0", `element vertex ${told}`, "property float x", "property float y", "property float z", "end_header"];
  const lines = Array.from({ length: points }, (_, k) => `${k} 0 1`);
  return new TextEncoder().encode([...head, ...lines, ""].join("\n")).buffer;
}

describe("a file of points", () => {
  it("is read where it is whole", () => {
    expect(readPoints(ply(3), { file: "points.ply", count: 3 }).getAttribute("position").count).toBe(3);
    expect(readPoints(ply(3), { file: "points.ply", count: null }).getAttribute("position").count).toBe(3);
  });

  it("is refused where it is cut short, or is none", () => {
    expect(() => readPoints(ply(2, 3), { file: "points.ply", count: 3 })).toThrow("points.ply: the points cannot be read (it is cut short)");
    const other = new TextEncoder().encode("<html>").buffer;
    expect(() => readPoints(other, { file: "points.ply", count: 3 })).toThrow("not a PLY file");
  });
});

describe("clouds", () => {
  it("are seen unless they are off", () => {
    expect(seen(["points", "points"], [])).toEqual([true, true]);
    expect(seen(["points"], ["points"])).toEqual([false]);
  });

  it("show distances in place of the points", () => {
    expect(seen(["points", "distances"], ["distances"])).toEqual([true, false]);
    expect(seen(["points", "distances"], [])).toEqual([false, true]);
    expect(seen(["points", "distances"], ["points"])).toEqual([false, true]);
    expect(seen(["points", "distances"], ["points", "distances"])).toEqual([false, false]);
  });
});

describe("clouds on their way", () => {
  afterEach(() => vi.unstubAllGlobals());

  const cloud: Cloud = {
    file: "points.ply",
    layer: "points",
    worldFromPoints: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1],
    count: 3,
    bounds: { min: [0, 0, 0], max: [1, 1, 1] },
  };

  /** Clouds of a server that answers so, one after the other; the last for all that is asked later. */
  function arriving(answers: (() => Response)[]): { around: Fake; clouds: CloudArrivals; changes: () => number } {
    let asked = 0;
    vi.stubGlobal("fetch", () => {
      asked += 1;
      return Promise.resolve((answers[asked - 1] ?? answers.at(-1) ?? Response.error)());
    });
    let changes = 0;
    const around = new Fake();
    const clouds = new CloudArrivals([cloud], new URL("http://place/place.json"), () => (changes += 1), around);
    return { around, clouds, changes: () => changes };
  }

  it("are asked for again where they did not come", async () => {
    const { around, clouds, changes } = arriving([() => new Response(null, { status: 503 }), () => new Response(ply(3))]);
    await clouds.bring(() => undefined);
    expect(clouds.missing.map(({ file }) => file)).toEqual(["points.ply"]);
    expect(clouds.group.children).toHaveLength(0);
    around.wait();
    await vi.waitFor(() => expect(changes()).toBe(1));
    expect(clouds.missing).toEqual([]);
    expect(clouds.group.children).toHaveLength(1);
  });

  it("are not asked for twice at once, though another fails meanwhile", async () => {
    const open: ((answer: Response) => void)[] = [];
    const asked: string[] = [];
    vi.stubGlobal("fetch", (address: URL) => {
      asked.push(String(address).split("/").at(-1) ?? "");
      return new Promise<Response>((resolve) => open.push(resolve));
    });
    const around = new Fake();
    const two = [cloud, { ...cloud, file: "far.ply" }];
    const clouds = new CloudArrivals(two, new URL("http://place/place.json"), () => undefined, around);
    void clouds.bring(() => undefined);
    const answer = async (index: number, response: Response, then: number): Promise<void> => {
      open[index]?.(response);
      await vi.waitFor(() => expect(asked).toHaveLength(then));
    };
    await answer(0, new Response(null, { status: 503 }), 2);
    around.wait();
    expect(asked).toEqual(["points.ply", "far.ply", "points.ply"]);
    open[1]?.(new Response(null, { status: 503 }));
    await vi.waitFor(() => expect(clouds.missing).toHaveLength(2));
    around.wait();
    await vi.waitFor(() => expect(asked.slice(3)).toEqual(["far.ply"]));
    for (const index of [2, 3]) open[index]?.(new Response(ply(3)));
    await vi.waitFor(() => expect(clouds.missing).toEqual([]));
    expect([clouds.group.children.length, asked.length]).toEqual([2, 4]);
  });

  it("are not asked for again where they are broken", async () => {
    const { around, clouds } = arriving([() => new Response(ply(2, 3)), () => new Response(ply(3))]);
    await clouds.bring(() => undefined);
    expect(around.pauses).toEqual([]);
    expect(clouds.missing[0]?.fault.message).toContain("cut short");
    expect(clouds.waiting).toBe(0);
  });
});
