/** What a map of a storey shows, as paths of SVG; metres, x to the east and y down. */
import type { Point, Room, Storey } from "./house.ts";

export interface MapBox {
  readonly x: number;
  readonly y: number;
  readonly width: number;
  readonly height: number;
}

/** Around the storey there is room for a visitor outside. */
const MARGIN_M = 1.2;

export function boxOfStorey(storey: Storey): MapBox {
  const points = [...storey.walls.flatMap(({ line }) => line), ...storey.rooms.flatMap(({ outline }) => outline)];
  let [x0, y0, x1, y1] = points.length === 0 ? [0, 0, 0, 0] : [Infinity, Infinity, -Infinity, -Infinity];
  for (const [x, y] of points) [x0, y0, x1, y1] = [Math.min(x0, x), Math.min(y0, -y), Math.max(x1, x), Math.max(y1, -y)];
  return { x: x0 - MARGIN_M, y: y0 - MARGIN_M, width: x1 - x0 + 2 * MARGIN_M, height: y1 - y0 + 2 * MARGIN_M };
}

/** The place on the map of somebody at a point of the world: on its rim if he is further out. */
export function onMap({ x, y, width, height }: MapBox, point: Point): Point {
  const inset = 0.4;
  const within = (value: number, low: number, size: number): number =>
    Math.min(low + size - inset, Math.max(low + inset, value));
  return [within(point[0], x, width), within(-point[1], y, height)];
}

export function lineOf(points: readonly Point[]): string {
  return points.map(([x, y], i) => `${i === 0 ? "M" : "L"}${round(x)} ${round(-y)}`).join("");
}

/** With its holes; to be filled even-odd. */
export function areaOf({ outline, holes }: Room): string {
  return [outline, ...holes].map((ring) => `${lineOf(ring)}Z`).join("");
}

function round(value: number): number {
  return Math.round(value * 1000) / 1000;
}
