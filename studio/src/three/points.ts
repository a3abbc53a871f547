/** Reads a file of points, in this thread or in a worker. */
import { BufferAttribute, BufferGeometry, type TypedArray } from "three";
import { PLYLoader } from "three/examples/jsm/loaders/PLYLoader.js";
import { Fault } from "../core/fault.ts";
import type { Cloud } from "../core/place.ts";
import { type Help, Helper, hired } from "./hired.ts";
import type { Points, PointsAsked } from "./points-worker.ts";

const MAGIC = "ply";
const REMEDY = "Write the place again, for example with `veduta photos`.";
/** Some 40,000 points: they are read within two frames of a slow machine. */
const SMALL_BYTES = 600_000;

/** The points of a file; a fault where it has others than the place says. */
export function readPoints(bytes: ArrayBuffer, { file, count }: Pick<Cloud, "file" | "count">): BufferGeometry {
  const magic = new TextDecoder().decode(bytes.slice(0, MAGIC.length));
  if (magic !== MAGIC) throw new Fault(file, "it is not a PLY file", REMEDY);
  try {
    const geometry = new PLYLoader().parse(bytes);
    if (!geometry.hasAttribute("position")) throw new Error("it has no points");
    const read = geometry.getAttribute("position");
    const isWhole = read.array.every((value) => Number.isFinite(value));
    if (!isWhole || (count !== null && read.count < count)) throw new Error("it is cut short");
    return geometry;
  } catch (error) {
    const words = error instanceof Error ? error.message : String(error);
    throw new Fault(file, `the points cannot be read (${words})`, REMEDY);
  }
}

/** Small clouds are read at once, large ones in a worker while the page goes on. */
export class PointReader {
  readonly #helper: Helper<PointsAsked, Points>;

  /** `hire` starts a worker; null where there can be none. */
  constructor(hire: () => Help | null = startWorker) {
    this.#helper = new Helper(hire);
  }

  async read(bytes: ArrayBuffer, { file, count }: Pick<Cloud, "file" | "count">): Promise<BufferGeometry> {
    const points = bytes.byteLength < SMALL_BYTES ? null : await this.#helper.ask({ bytes, file, count });
    if (points === null) return readPoints(bytes, { file, count });
    if (points.fault !== null) throw new Fault(file, points.fault.fault, points.fault.remedy);
    const geometry = new BufferGeometry();
    for (const { name, array, size, normalized } of points.columns) {
      geometry.setAttribute(name, new BufferAttribute(array as TypedArray, size, normalized));
    }
    return geometry;
  }

  dispose(): void {
    this.#helper.dispose();
  }
}

function startWorker(): Help | null {
  return hired(() => new Worker(new URL("./points-worker.ts", import.meta.url), { type: "module" }));
}
