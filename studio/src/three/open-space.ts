/** A place without surfaces: nobody bumps into points, and a click goes through them. */
import type { Box } from "../core/framing.ts";
import type { Vec3 } from "../core/vector.ts";
import type { Obstacles } from "../core/walking.ts";
import type { Hit } from "./solid.ts";

export class OpenSpace implements Obstacles {
  readonly bounds: Box;
  readonly faceCount = 0;

  constructor(bounds: Box) {
    this.bounds = bounds;
  }

  pushOut(): Vec3 | null {
    return null;
  }

  firstHit(): Hit | null {
    return null;
  }
}
