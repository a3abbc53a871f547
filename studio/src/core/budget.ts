/** How much of a place a machine is asked to draw. */
import type { Place } from "./place.ts";

/** What is known of the machine: a phone has less memory for pictures, and a smaller screen. */
export interface Machine {
  readonly isSmall: boolean;
}

export interface Budget {
  /** A tile is refined where its error is larger on the screen (pixels). */
  readonly tileError_px: number;
  /** Tiles that are not drawn are kept while the geometry of all takes less than this; bytes. */
  readonly keptTiles_bytes: number;
  /** No tile more is asked for while it takes so much. */
  readonly mostTiles_bytes: number;
  /** Larger pictures are made smaller before the card gets them: their longest side. */
  readonly mostTexture_px: number;
  /** The side of the shadow map (pixels) over a place of some radius (m). */
  shadowSide_px(radius_m: number): number;
}

/** Streets of some dozens of houses: all their windows cost less than a town's boxes. */
const SMALL_PLACE_M2 = 30_000;
const FINE_PX = 4;
const COARSE_PX = 14;
/** So much more may be wrong on a small screen, which is held at the same distance. */
const SMALL_SCREEN = 1.5;
/** Repeated windows are held once: a street of a town takes some 5 MB. What was left comes back from the browser's cache. */
const KEPT_BYTES = 12e6;
const MOST_BYTES = 400e6;
const SMALL_MOST_BYTES = 150e6;
/** Shadows of a wider place are too coarse on the smallest map; a map of twice the side costs four times the memory. */
const NARROW_M = 25;
const [SMALLEST_SHADOW_PX, SHADOW_PX] = [1024, 2048];
/** A phone's screen has about so many pixels along its longer side: a picture of 4,096² would take 89 MB of it, one of 2,048² 22 MB. */
const SMALL_TEXTURE_PX = 2048;

export function budgetOf(place: Pick<Place, "parts">, { isSmall }: Machine): Budget {
  const error_px = builtArea_m2(place) > SMALL_PLACE_M2 ? COARSE_PX : FINE_PX;
  return {
    tileError_px: isSmall ? SMALL_SCREEN * error_px : error_px,
    keptTiles_bytes: KEPT_BYTES,
    mostTiles_bytes: isSmall ? SMALL_MOST_BYTES : MOST_BYTES,
    mostTexture_px: isSmall ? SMALL_TEXTURE_PX : Infinity,
    shadowSide_px: (radius_m) => (isSmall && radius_m <= NARROW_M ? SMALLEST_SHADOW_PX : SHADOW_PX),
  };
}

/** The area that the boxes of the parts cover; infinite where one does not say its own. */
function builtArea_m2({ parts }: Pick<Place, "parts">): number {
  let area = 0;
  for (const { bounds, isGround, isBackdrop } of parts) {
    if (isGround || isBackdrop) continue;
    if (bounds === null) return Infinity;
    area += (bounds.max[0] - bounds.min[0]) * (bounds.max[1] - bounds.min[1]);
  }
  return area;
}
