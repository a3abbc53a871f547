/** A worker that reads files of points, so that the page goes on being drawn. */
import { BufferAttribute } from "three";
import { faultOf } from "../core/fault.ts";
import { readPoints } from "./points.ts";

export interface PointsAsked {
  readonly id: number;
  readonly bytes: ArrayBuffer;
  readonly file: string;
  readonly count: number | null;
}

export interface Points {
  readonly id: number;
  readonly columns: readonly { readonly name: string; readonly array: ArrayBufferView; readonly size: number; readonly normalized: boolean }[];
  /** What is wrong with the file; null where it is read. */
  readonly fault: { readonly fault: string; readonly remedy: string } | null;
}

/** What this file uses of a worker's scope, which the types of pages do not have. */
interface Scope {
  postMessage(message: Points, moved: ArrayBufferLike[]): void;
  onmessage: ((event: MessageEvent<PointsAsked>) => void) | null;
}

const scope = globalThis as unknown as Scope;

scope.onmessage = ({ data: { id, bytes, file, count } }) => {
  try {
    const { attributes } = readPoints(bytes, { file, count });
    const columns = Object.entries(attributes).flatMap(([name, column]) =>
      column instanceof BufferAttribute
        ? [{ name, array: column.array, size: column.itemSize, normalized: column.normalized }]
        : [],
    );
    scope.postMessage({ id, columns, fault: null }, [...new Set(columns.map(({ array }) => array.buffer))]);
  } catch (error) {
    const { fault, remedy } = faultOf(error);
    scope.postMessage({ id, columns: [], fault: { fault, remedy } }, []);
  }
};
