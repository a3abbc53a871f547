import type { BufferGeometry } from "three";
import { beforeAll, describe, expect, it } from "vitest";
import { PointReader, readPoints } from "../../src/three/points.ts";
import { helpHere } from "./worker-here.ts";

beforeAll(async () => {
  await import("../../src/three/points-worker.ts");
});

/** A binary cloud in colours; `told` of its points in the head. */
function ply(points: number, told = points): ArrayBuffer {
  const columns = [...["x", "y", "z"].map((name) => `property float ${name}`), ...["red", "green", "blue"].map((name) => `property uchar ${name}`)];
  const head = new TextEncoder().encode(["ply", "format binary_little_endian 1.0", `element vertex ${told}`, ...columns, "end_header", ""].join("\n"));
  const bytes = new Uint8Array(head.length + 15 * points);
  bytes.set(head);
  const view = new DataView(bytes.buffer, head.length);
  for (let k = 0; k < points; k += 1) {
    for (const axis of [0, 1, 2]) view.setFloat32(15 * k + 4 * axis, Math.sin(k + axis), true);
    for (const channel of [0, 1, 2]) view.setUint8(15 * k + 12 + channel, (7 * k + channel) % 256);
  }
  return bytes.buffer;
}

const columnsOf = ({ attributes }: BufferGeometry): unknown =>
  Object.fromEntries(Object.entries(attributes).map(([name, { array, itemSize, normalized }]) => [name, { array, itemSize, normalized }]));

describe("a cloud of points", () => {
  const large = 50_000;

  it("is the same from a worker as from this thread", async () => {
    const help = helpHere();
    const cloud = { file: "points.ply", count: large };
    const read = await new PointReader(() => help).read(ply(large), cloud);
    expect(help.asked).toEqual([1]);
    expect(columnsOf(read)).toEqual(columnsOf(readPoints(ply(large), cloud)));
  }, 30_000);

  it("is read at once where it is small, and here where there is no worker", async () => {
    const help = helpHere();
    expect((await new PointReader(() => help).read(ply(30), { file: "points.ply", count: 30 })).getAttribute("position").count).toBe(30);
    expect(help.asked).toEqual([]);
    const alone = await new PointReader(() => null).read(ply(large), { file: "points.ply", count: large });
    expect(alone.getAttribute("position").count).toBe(large);
  });

  it("is refused by a worker in the same words", async () => {
    const cloud = { file: "points.ply", count: large + 5 };
    await expect(new PointReader(helpHere).read(ply(large), cloud)).rejects.toThrow("points.ply: the points cannot be read (it is cut short)");
    const other = new Uint8Array(700_000).buffer;
    await expect(new PointReader(helpHere).read(other, cloud)).rejects.toThrow("points.ply: it is not a PLY file");
  });
});
