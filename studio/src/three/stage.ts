/** What is drawn: the place, its ground, and the sky, the sun and the plane around it. */
import { Box3, type Group, type PerspectiveCamera, Scene, Vector3, type WebGLRenderer } from "three";
import { type Box, boxOfPoints, cornersOf } from "../core/framing.ts";
import { cornersOfPlace, type Place } from "../core/place.ts";
import { boundsOfShots } from "../core/shots.ts";
import type { Vec3 } from "../core/vector.ts";
import { Appearance } from "./appearance.ts";
import type { Frusta } from "./frusta.ts";
import { layGround } from "./ground-material.ts";
import type { LoadedPart } from "./load.ts";
import { OpenSpace } from "./open-space.ts";
import { makeScenery, type Scenery } from "./scenery.ts";
import { Solid, soupOf } from "./solid.ts";
import type { Town } from "./town.ts";

/** Of a town only what is around the person throws shadows; they move when the person has gone far. */
const SHADE_RADIUS_M = 110;
const SHADE_STEP_M = 25;

export interface ViewerContent {
  readonly parts: readonly LoadedPart[];
  readonly town: Town | null;
  readonly clouds: Group;
  readonly frusta: Frusta | null;
}

export class Stage {
  readonly scene = new Scene();
  /** What one meets with: surfaces, or nothing but a space where there are photos alone. */
  readonly solid: Solid | Town | OpenSpace;
  readonly appearance: Appearance;
  /** The corners of what one comes to see, and the box around them; world frame. */
  readonly corners: readonly Vec3[];
  readonly seen: Box;
  readonly #town: Town | null;
  readonly #scenery: Scenery;
  #shaded = { centre: new Vector3(Infinity, 0, 0), tiles: -1 };

  constructor(place: Place, { parts, town, clouds, frusta }: ViewerContent) {
    this.#town = town;
    const ground = parts.filter(({ part }) => part.isGround);
    this.solid = town ?? solidOf(place, parts, ground);
    const told = cornersOfPlace(place);
    this.corners = told.length > 0 ? told : cornersOf(this.solid.bounds);
    this.seen = boxOfPoints(this.corners);
    const buildings = parts.filter(({ part }) => !part.isGround);
    const footprints = buildings.map(({ group }) => new Box3().setFromObject(group));
    const hasGround = place.parts.some(({ isGround }) => isGround);
    this.#scenery = makeScenery(this.seen, footprints, { hasGround, scaleKnown: place.scaleKnown });
    this.appearance = new Appearance(parts);
    for (const { meshes } of ground) for (const { mesh } of meshes) layGround(mesh);
    this.scene.add(this.#scenery.group, this.appearance.outline.group, clouds);
    for (const { group } of parts) this.scene.add(group);
    for (const own of [town, frusta]) if (own !== null) this.scene.add(own.group);
  }

  /** Whether something is still on its way, when it is seen from here. */
  update(camera: PerspectiveCamera, renderer: WebGLRenderer): boolean {
    this.#scenery.follow(camera);
    return this.#town !== null && this.#stream(this.#town, camera, renderer);
  }

  /** After something was shown or hidden. */
  redrawShadows(): void {
    this.#scenery.sun.shadow.needsUpdate = true;
  }

  /** Fetches what is seen from here, and keeps the shadows around the person. */
  #stream(town: Town, camera: PerspectiveCamera, renderer: WebGLRenderer): boolean {
    town.update(camera, renderer);
    if (town.tileCount !== this.#shaded.tiles || this.#shaded.centre.distanceTo(camera.position) > SHADE_STEP_M) {
      const ahead = camera.getWorldDirection(new Vector3()).setY(0).multiplyScalar(0.4 * SHADE_RADIUS_M);
      const centre = camera.position.clone().add(ahead).setY(0);
      this.#scenery.shadeAround(centre, SHADE_RADIUS_M);
      this.#shaded = { centre: camera.position.clone(), tiles: town.tileCount };
    }
    return town.isLoading;
  }
}

function solidOf(place: Place, parts: readonly LoadedPart[], ground: readonly LoadedPart[]): Solid | OpenSpace {
  if (parts.length === 0) return new OpenSpace(boundsOfShots(place.clouds, place.shots));
  return new Solid(soupOf(parts), ground.length > 0 ? new Solid(soupOf(ground)) : null);
}
