/** A way on foot round what stands between two places, in straight pieces. */

export type Spot = readonly [number, number];
/** Whether nothing stands there. */
export type Free = (x: number, y: number) => boolean;

/** No more places are looked at: a click is answered at once. */
const MOST_LOOKED_AT = 12_000;
/** Beside the straight way one looks no farther than this (m) and than its own length. */
const ASIDE_M = 12;
const STEPS: readonly Spot[] = [[1, 0], [-1, 0], [0, 1], [0, -1], [1, 1], [1, -1], [-1, 1], [-1, -1]];

/**
 * The corners of a way to a place, which is the last of them; null where none was found. `cell` is how
 * closely (m) one looks.
 */
export function wayRound(from: Spot, to: Spot, isFree: Free, cell: number): Spot[] | null {
  if (!isFree(to[0], to[1])) return null;
  if (isClear(from, to, isFree, cell)) return [to];
  const found = cellsTo(from, to, isFree, cell);
  return found === null ? null : tightened([from, ...found, to], isFree, cell);
}

/** Whether the straight way is free, but for where one is: that has been looked at. */
export function isClear(from: Spot, to: Spot, isFree: Free, cell: number): boolean {
  const long = Math.hypot(to[0] - from[0], to[1] - from[1]);
  const steps = Math.max(1, Math.ceil(long / (0.5 * cell)));
  for (let i = 1; i <= steps; i++) {
    const share = i / steps;
    if (!isFree(from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1]))) return false;
  }
  return true;
}

interface Reached {
  readonly column: number;
  readonly row: number;
  readonly cost: number;
  readonly before: Reached | null;
}

/** The shortest way over cells about `from` (A*), without both ends. */
function cellsTo(from: Spot, to: Spot, isFree: Free, cell: number): Spot[] | null {
  const place = (column: number, row: number): Spot => [from[0] + column * cell, from[1] + row * cell];
  const long = Math.hypot(to[0] - from[0], to[1] - from[1]);
  const most = 0.5 * long + Math.max(ASIDE_M, long);
  const middle: Spot = [0.5 * (from[0] + to[0]), 0.5 * (from[1] + to[1])];
  const known = new Map<string, boolean>();
  const free = (column: number, row: number): boolean => {
    const key = `${column} ${row}`;
    const told = known.get(key);
    if (told !== undefined) return told;
    const [x, y] = place(column, row);
    const answer = Math.hypot(x - middle[0], y - middle[1]) <= most && isFree(x, y);
    known.set(key, answer);
    return answer;
  };
  const rest = ({ column, row }: Pick<Reached, "column" | "row">): number => {
    const [x, y] = place(column, row);
    return Math.hypot(to[0] - x, to[1] - y);
  };
  const open = new Heap();
  open.push({ column: 0, row: 0, cost: 0, before: null }, long);
  const done = new Set<string>();
  for (let at = open.pop(); at !== undefined; at = open.pop()) {
    if (known.size > MOST_LOOKED_AT) return null;
    const key = `${at.column} ${at.row}`;
    if (done.has(key)) continue;
    done.add(key);
    if (rest(at) <= 1.5 * cell && isClear(place(at.column, at.row), to, isFree, cell)) return back(at, place);
    for (const [dx, dy] of STEPS) {
      const [column, row] = [at.column + dx, at.row + dy];
      // Not across the corner of what stands there.
      if (!free(column, row) || (dx !== 0 && dy !== 0 && !(free(at.column, row) && free(column, at.row)))) continue;
      const next = { column, row, cost: at.cost + Math.hypot(dx, dy) * cell, before: at };
      open.push(next, next.cost + rest(next));
    }
  }
  return null;
}

function back(last: Reached, place: (column: number, row: number) => Spot): Spot[] {
  const spots: Spot[] = [];
  for (let at: Reached = last; at.before !== null; at = at.before) spots.push(place(at.column, at.row));
  return spots.reverse();
}

/** Of a way the corners that it needs, without the first: from each as far as one sees. */
function tightened(way: readonly Spot[], isFree: Free, cell: number): Spot[] {
  const corners: Spot[] = [];
  for (let at = 0; at < way.length - 1;) {
    let next = way.length - 1;
    const here = way[at] ?? [0, 0];
    while (next > at + 1 && !isClear(here, way[next] ?? here, isFree, cell)) next--;
    corners.push(way[next] ?? here);
    at = next;
  }
  return corners;
}

/** What costs the least comes first. */
class Heap {
  readonly #items: { readonly value: Reached; readonly cost: number }[] = [];

  push(value: Reached, cost: number): void {
    const items = this.#items;
    items.push({ value, cost });
    for (let at = items.length - 1; at > 0;) {
      const above = (at - 1) >> 1;
      if ((items[above]?.cost ?? 0) <= cost) break;
      this.#swap(at, above);
      at = above;
    }
  }

  pop(): Reached | undefined {
    const items = this.#items;
    const first = items[0];
    const last = items.pop();
    if (first === undefined || last === undefined || items.length === 0) return first?.value;
    items[0] = last;
    for (let at = 0; ;) {
      const below = 2 * at + 1;
      const cost = (index: number): number => items[index]?.cost ?? Infinity;
      const least = cost(below + 1) < cost(below) ? below + 1 : below;
      if (cost(least) >= cost(at)) break;
      this.#swap(at, least);
      at = least;
    }
    return first.value;
  }

  #swap(one: number, two: number): void {
    const items = this.#items;
    const [first, second] = [items[one], items[two]];
    if (first === undefined || second === undefined) return;
    items[one] = second;
    items[two] = first;
  }
}
