/** In which room each place of a house is: a grid of room numbers for each storey, for the shader. */
import type { House, Point, Room } from "./house.ts";

export interface RoomMap {
  /** World frame: the corner of the first cell. */
  readonly corner: Point;
  readonly cell_m: number;
  /** Cells of a storey. */
  readonly columns: number;
  readonly rows: number;
  /** 0 where there is none, else the room's number over all storeys plus one; storey by storey. */
  readonly cells: Uint16Array;
}

/** Finer than half a thin wall, so that no room reaches through to the other side. */
const LEAST_CELL_M = 0.05;
const MOST_CELLS = 1_500_000;
/** What two bytes hold beside 0: more rooms than a document may have in three storeys. */
const MOST_ROOMS = 65_535;

/** The rooms of a house, the lowest storey's first, each with its storey. */
export function roomsOf(house: House): { readonly room: Room; readonly storey: number }[] {
  return house.storeys.flatMap(({ rooms }, storey) => rooms.map((room) => ({ room, storey })));
}

export function roomMapOf(house: House): RoomMap {
  const rooms = roomsOf(house);
  const corners = rooms.flatMap(({ room }) => room.outline);
  const [x0, x1] = endsOf(corners.map(([x]) => x));
  const [y0, y1] = endsOf(corners.map(([, y]) => y));
  const area = (x1 - x0) * (y1 - y0) * house.storeys.length;
  const cell_m = Math.max(LEAST_CELL_M, Math.sqrt(area / MOST_CELLS));
  // A cell more on each side, into which the rooms grow.
  const corner: Point = [x0 - 2 * cell_m, y0 - 2 * cell_m];
  const columns = Math.ceil((x1 - x0) / cell_m) + 4;
  const rows = Math.ceil((y1 - y0) / cell_m) + 4;
  const cells = new Uint16Array(columns * rows * house.storeys.length);
  const map = { corner, cell_m, columns, rows, cells };
  for (const [index, { room, storey }] of rooms.entries()) {
    if (index < MOST_ROOMS) fill(map, room, storey * rows, index + 1);
  }
  return { ...map, cells: grown(map) };
}

function endsOf(values: readonly number[]): [number, number] {
  if (values.length === 0) return [0, 1];
  return values.reduce<[number, number]>(
    ([low, high], value) => [Math.min(low, value), Math.max(high, value)],
    [Infinity, -Infinity],
  );
}

/** Row by row between the sides of the room, even-odd. */
function fill({ corner, cell_m, columns, rows, cells }: RoomMap, room: Room, firstRow: number, value: number): void {
  const rings = [room.outline, ...room.holes];
  for (let row = 0; row < rows; row += 1) {
    const y = corner[1] + (row + 0.5) * cell_m;
    const cuts = rings.flatMap((ring) => cutsOf(ring, y)).toSorted((a, b) => a - b);
    for (let i = 0; i + 1 < cuts.length; i += 2) {
      const from = Math.max(0, Math.ceil(((cuts[i] ?? 0) - corner[0]) / cell_m - 0.5));
      const to = Math.min(columns, Math.ceil(((cuts[i + 1] ?? 0) - corner[0]) / cell_m - 0.5));
      if (to > from) cells.fill(value, (firstRow + row) * columns + from, (firstRow + row) * columns + to);
    }
  }
}

function cutsOf(ring: readonly Point[], y: number): number[] {
  return ring.flatMap(([x, cornerY], i) => {
    const [nextX, nextY] = ring[(i + 1) % ring.length] ?? [x, cornerY];
    if (cornerY > y === nextY > y) return [];
    return [x + ((y - cornerY) / (nextY - cornerY)) * (nextX - x)];
  });
}

/** Each room takes the free cells beside it: faces of walls lie on its very edge. */
function grown({ columns, rows, cells }: RoomMap): Uint16Array {
  const wider = cells.slice();
  for (let at = 0; at < cells.length; at += 1) {
    if (cells[at] !== 0) continue;
    const [column, row] = [at % columns, Math.floor(at / columns) % rows];
    const left = column > 0 ? cells[at - 1] : 0;
    const right = column + 1 < columns ? cells[at + 1] : 0;
    const below = row > 0 ? cells[at - columns] : 0;
    const above = row + 1 < rows ? cells[at + columns] : 0;
    wider[at] = [left, right, below, above].find((value) => value !== 0) ?? 0;
  }
  return wider;
}
