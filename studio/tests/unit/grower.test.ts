import { BufferAttribute, BufferGeometry, Matrix4, Mesh } from "three";
import { beforeAll, describe, expect, it } from "vitest";
import { Grower } from "../../src/three/grower.ts";
import type { Help } from "../../src/three/hired.ts";
import { Solid } from "../../src/three/solid.ts";
import { soupOf, type Soupable } from "../../src/three/soup.ts";
import { helpHere } from "./worker-here.ts";

beforeAll(async () => {
  await import("../../src/three/soup-worker.ts");
});

/** Hills of (n - 1)^2 squares over 10 m, turned and moved. */
function hills(n: number): Soupable {
  const positions = new Float32Array(3 * n * n);
  for (let i = 0; i < n * n; i += 1) {
    const [x, z] = [(10 * (i % n)) / (n - 1), (10 * Math.floor(i / n)) / (n - 1)];
    positions.set([x, Math.sin(x) + Math.cos(2 * z), z], 3 * i);
  }
  const faces: number[] = [];
  for (let row = 0; row < n - 1; row += 1) {
    for (let at = row * n; at < row * n + n - 1; at += 1) faces.push(at, at + n, at + 1, at + 1, at + n, at + n + 1);
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(positions, 3));
  const mesh = new Mesh(geometry);
  mesh.matrixWorld.copy(new Matrix4().makeRotationY(0.4).setPosition(3, 1, -2));
  const rowOfFace = Uint32Array.from({ length: faces.length / 3 }, (_, face) => face % 7);
  return { meshes: [{ mesh, faces: Uint32Array.from(faces), rowOfFace }], instanced: [] };
}

function same(a: Solid | null, b: Solid): void {
  expect(a?.faceCount).toBe(b.faceCount);
  expect(a?.bounds).toEqual(b.bounds);
  for (let k = 0; k < 40; k += 1) {
    const [x, y] = [3 + (k % 8), -6 + Math.floor(k / 8)];
    const [one, other] = [a?.firstHit([x, y, 20], [0, 0, -1], () => true), b.firstHit([x, y, 20], [0, 0, -1], () => true)];
    expect(one?.feature).toEqual(other?.feature);
    expect(one?.distance_m ?? 0).toBeCloseTo(other?.distance_m ?? 0, 4);
  }
}

describe("solids of parts", () => {
  it("are the same from the worker as from the page", async () => {
    const help = helpHere();
    const part = hills(120);
    same(await new Grower(() => help).solidOf(part, 5), new Solid(soupOf([part], 5)));
    expect(help.asked).toEqual([1]);
  });

  it("are made at once where they are small", async () => {
    const help = helpHere();
    const part = hills(20);
    same(await new Grower(() => help).solidOf(part, 0), new Solid(soupOf([part])));
    expect(help.asked).toEqual([]);
  });

  it("are made by the page where there is no worker", async () => {
    const part = hills(110);
    same(await new Grower(() => null).solidOf(part, 0), new Solid(soupOf([part])));
  });

  it("are made by the page when the worker is lost, and it is not asked again", async () => {
    const help: Help = {
      onmessage: null,
      onerror: null,
      onmessageerror: null,
      terminate: () => undefined,
      postMessage: () => {
        queueMicrotask(() => {
          help.onerror?.call(undefined as never, new Event("error") as ErrorEvent);
        });
      },
    };
    let hired = 0;
    const grower = new Grower(() => {
      hired += 1;
      return help;
    });
    const part = hills(110);
    same(await grower.solidOf(part, 0), new Solid(soupOf([part])));
    same(await grower.solidOf(part, 0), new Solid(soupOf([part])));
    expect(hired).toBe(1);
  });

  it("are none of a part without faces", async () => {
    expect(await new Grower(() => null).solidOf({ meshes: [], instanced: [] }, 0)).toBeNull();
  });
});
