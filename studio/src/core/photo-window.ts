/** Which part of a photo to show around a rectangle of it. */
import type { PhotoRectangle } from "./features.ts";

export interface PhotoWindow {
  readonly x: number;
  readonly y: number;
  readonly width: number;
  readonly height: number;
}

/** Aspects (width over height) of the picture in the panel: between a tall and a wide one. */
const TALLEST = 0.9;
const WIDEST = 1.8;

/** The aspect that suits a rectangle. */
export function windowAspect(rectangle: PhotoRectangle): number {
  return Math.min(WIDEST, Math.max(TALLEST, rectangle[2] / Math.max(1, rectangle[3])));
}

/** Surroundings on each side, as a share of the rectangle. */
const SURROUNDINGS = 0.6;

/**
 * The smallest window of the given aspect (width over height) that holds the rectangle and its
 * surroundings; moved into the photo where it would reach beyond an edge, and centred on it
 * where the photo is smaller. All in pixels of the photo.
 */
export function photoWindow(
  rectangle: PhotoRectangle,
  photoWidth: number,
  photoHeight: number,
  aspect: number,
): PhotoWindow {
  const [x, y, w, h] = rectangle;
  const wanted = {
    width: Math.min(w * (1 + 2 * SURROUNDINGS), Math.max(w, photoWidth)),
    height: Math.min(h * (1 + 2 * SURROUNDINGS), Math.max(h, photoHeight)),
  };
  const width = Math.max(wanted.width, wanted.height * aspect);
  const height = width / aspect;
  return {
    x: placed(x + w / 2, width, photoWidth),
    y: placed(y + h / 2, height, photoHeight),
    width,
    height,
  };
}

function placed(centre: number, size: number, whole: number): number {
  if (size >= whole) return (whole - size) / 2;
  return Math.min(whole - size, Math.max(0, centre - size / 2));
}
