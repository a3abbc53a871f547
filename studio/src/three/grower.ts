/** Makes solids of parts: small ones at once, large ones in a worker while the page goes on. */
import { type Help, Helper, hired } from "./hired.ts";
import { Solid } from "./solid.ts";
import { boxesOf, ownersOf, piecesOf, type Soupable, soupOf } from "./soup.ts";
import type { Asked, Grown } from "./soup-worker.ts";

/** A tree over so many faces takes about two frames of a slow machine. */
const SMALL_FACES = 20_000;

export class Grower {
  readonly #helper: Helper<Asked, Grown>;

  /** `hire` starts a worker; null where there can be none. */
  constructor(hire: () => Help | null = hireForSolids) {
    this.#helper = new Helper(hire);
  }

  /** The solid of a part with this number; null where it has no faces. */
  async solidOf(part: Soupable, index: number): Promise<Solid | null> {
    const owners = ownersOf([part], index);
    if (owners.rowOfFace.length === 0) return null;
    const grown =
      owners.firstBoxFace < SMALL_FACES ? null : await this.#helper.ask({ pieces: piecesOf([part]), more: boxesOf([part]) });
    if (grown === null) return new Solid(soupOf([part], index));
    return new Solid({ ...owners, positions: grown.positions }, null, grown.tree);
  }

  dispose(): void {
    this.#helper.dispose();
  }
}

/** A worker that makes what a solid is made of. */
export function hireForSolids(): Help | null {
  return hired(() => new Worker(new URL("./soup-worker.ts", import.meta.url), { type: "module" }));
}
