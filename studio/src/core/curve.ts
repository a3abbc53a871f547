/** A smooth curve through points, by its arc length: what an animal's body is bent along. */
import { add, length, scale, subtract, type Vec3 } from "./vector.ts";

export interface OnCurve {
  readonly point: Vec3;
  /** Unit vector along the curve. */
  readonly ahead: Vec3;
}

/** Pieces between two points. */
const PIECES = 12;

export class Curve {
  readonly length_m: number;
  readonly closed: boolean;
  readonly #points: readonly Vec3[];
  readonly #arcs: readonly number[];

  /** Two different points at least. A closed curve ends where it begins. */
  constructor(points: readonly Vec3[], closed: boolean) {
    const apart = points.filter((point, i) => i === 0 || distance(point, points[i - 1] ?? point) > 1e-9);
    const first = apart[0];
    const last = apart.at(-1);
    if (first === undefined || last === undefined || apart.length < 2) throw new RangeError("a curve needs two points");
    if (closed && distance(first, last) > 1e-9) apart.push(first);
    this.closed = closed;
    this.#points = smooth(apart, closed);
    const arcs = [0];
    for (let i = 1; i < this.#points.length; i += 1) {
      arcs.push((arcs[i - 1] ?? 0) + distance(this.#points[i] ?? first, this.#points[i - 1] ?? first));
    }
    this.#arcs = arcs;
    this.length_m = arcs.at(-1) ?? 0;
  }

  /** Where one is after so many metres; beyond the ends of an open curve it goes straight on. */
  at(arc_m: number): OnCurve {
    const arc = this.closed ? arc_m - this.length_m * Math.floor(arc_m / this.length_m) : arc_m;
    let [low, high] = [0, this.#arcs.length - 2];
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if ((this.#arcs[middle] ?? 0) <= arc) low = middle;
      else high = middle - 1;
    }
    const from = this.#points[low];
    const to = this.#points[low + 1];
    if (from === undefined || to === undefined) throw new RangeError("a curve without points");
    const [start, end] = [this.#arcs[low] ?? 0, this.#arcs[low + 1] ?? 0];
    const share = (arc - start) / (end - start);
    const point = add(from, scale(subtract(to, from), share));
    return { point, ahead: this.#heading(low, share) };
  }

  /** The tangent turns evenly from one piece to the next: no body has a kink. */
  #heading(piece: number, share: number): Vec3 {
    const here = this.#piece(piece);
    const inside = Math.min(1, Math.max(0, share));
    const other = this.#piece(inside < 0.5 ? piece - 1 : piece + 1);
    const weight = Math.abs(inside - 0.5);
    return unit(add(scale(here, 1 - weight), scale(other, weight)));
  }

  /** Direction of a piece; before the first and after the last, theirs or, where it is closed, each other's. */
  #piece(index: number): Vec3 {
    const count = this.#points.length - 1;
    const i = this.closed ? (index + count) % count : Math.min(count - 1, Math.max(0, index));
    return unit(subtract(this.#points[i + 1] ?? [0, 0, 0], this.#points[i] ?? [1, 0, 0]));
  }
}

/** Centripetal Catmull-Rom: no loops, however unevenly the points lie. */
function smooth(points: readonly Vec3[], closed: boolean): Vec3[] {
  const count = points.length;
  const point = (i: number): Vec3 => {
    if (closed) return points[(i + count - 1) % (count - 1)] ?? [0, 0, 0];
    const [first, second] = [points[0], points[1]];
    const [last, before] = [points[count - 1], points[count - 2]];
    if (i < 0 && first !== undefined && second !== undefined) return subtract(scale(first, 2), second);
    if (i >= count && last !== undefined && before !== undefined) return subtract(scale(last, 2), before);
    return points[i] ?? [0, 0, 0];
  };
  const found: Vec3[] = [point(0)];
  for (let i = 0; i + 1 < count; i += 1) {
    const around = [point(i - 1), point(i), point(i + 1), point(i + 2)] as const;
    for (let k = 1; k <= PIECES; k += 1) found.push(between(around, k / PIECES));
  }
  return found;
}

function between([a, b, c, d]: readonly [Vec3, Vec3, Vec3, Vec3], share: number): Vec3 {
  const t1 = Math.sqrt(distance(a, b));
  const t2 = t1 + Math.sqrt(distance(b, c));
  const t3 = t2 + Math.sqrt(distance(c, d));
  const t = t1 + share * (t2 - t1);
  const mix = (p: Vec3, q: Vec3, from: number, to: number): Vec3 =>
    add(scale(p, (to - t) / (to - from)), scale(q, (t - from) / (to - from)));
  const [ab, bc, cd] = [mix(a, b, 0, t1), mix(b, c, t1, t2), mix(c, d, t2, t3)];
  return mix(mix(ab, bc, 0, t2), mix(bc, cd, t1, t3), t1, t2);
}

function unit(vector: Vec3): Vec3 {
  const size = length(vector);
  return size < 1e-12 ? [1, 0, 0] : scale(vector, 1 / size);
}

function distance(a: Vec3, b: Vec3): number {
  return length(subtract(a, b));
}
