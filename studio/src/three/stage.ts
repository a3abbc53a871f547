/** What is drawn: the place, its ground, and the sky, the sun and the plane around it. */
import { Box3, type Group, type PerspectiveCamera, Scene, Vector3, type WebGLRenderer } from "three";
import type { Budget } from "../core/budget.ts";
import { daylightAt, type SunPath, sunPathOf } from "../core/daylight.ts";
import { beginsWithAnimal, type FirstLook, lookAtAnimals, standsOf, together } from "../core/animal-view.ts";
import { drawnFaces, drawnFromWorld, worldPoint } from "../core/frames.ts";
import { length, subtract, type Vec3 } from "../core/vector.ts";
import { type Box, boxOfPoints, cornersOf } from "../core/framing.ts";
import type { Axes } from "../core/pinhole.ts";
import { cornersOfPlace, lowestGround, type Place } from "../core/place.ts";
import { boundsOfShots, outlookOf } from "../core/shots.ts";
import { outlookOfFronts } from "../core/fronts.ts";
import { lookAlong } from "../core/long-view.ts";
import type { FeatureRef, StudioState } from "../core/state.ts";
import { type Body, DEFAULT_WALK, INDOOR_BODY, type Walker } from "../core/walking.ts";
import { Animals } from "./animals.ts";
import { Appearance } from "./appearance.ts";
import { Backdrop } from "./backdrop.ts";
import { samplePoints, showClouds, sizePoints } from "./clouds.ts";
import type { Frusta } from "./frusta.ts";
import type { MorphShow } from "./morph-show.ts";
import { Household, type LoadedHouse } from "./household.ts";
import { layGround } from "./ground-material.ts";
import { OpenSpace } from "./open-space.ts";
import type { PartSlot } from "./part-slot.ts";
import { PhotoShow } from "./photo-show.ts";
import type { PhotoTextures } from "./photo-textures.ts";
import { PlaceSolid } from "./place-solid.ts";
import { makeScenery, type Scenery } from "./scenery.ts";
import type { Recorded } from "./recorded.ts";
import type { Town } from "./town.ts";

/** Of a town only what is around the person throws shadows; they move when the person has gone far. */
const SHADE_RADIUS_M = 110;
const SHADE_STEP_M = 25;
/** Points that are looked at for what the photos show: of so many pairs in all, and of so many at most. */
const MOST_PAIRS = 1_500_000;
const MOST_POINTS = 6000;
const FEWEST_POINTS = 300;
/** How far away a photo's subject is taken to be where nothing tells; in shares of the place's size. */
const USUAL_DEPTH = 0.3;

export interface ViewerContent {
  readonly parts: readonly PartSlot[];
  readonly recorded: Recorded;
  readonly town: Town | null;
  readonly clouds: Group;
  readonly frusta: Frusta | null;
  readonly textures: PhotoTextures | null;
  readonly houses: readonly LoadedHouse[];
  readonly budget: Budget;
  /** The walks from view to view; null where the place has none. */
  readonly morphs: MorphShow | null;
}

export class Stage {
  readonly scene = new Scene();
  /** What one meets with: surfaces, or nothing but a space where there are photos alone. */
  readonly solid: PlaceSolid | Town | OpenSpace;
  readonly appearance: Appearance;
  /** The corners of what one comes to see, and the box around them and all parts; world frame. */
  readonly corners: readonly Vec3[];
  readonly seen: Box;
  /** Where the photos look to, or where the fronts are seen; null where they look all about. */
  readonly outlook: Vec3 | null;
  readonly household: Household;
  readonly animals: Animals;
  /** The photos that lie on the place; null where it has none. */
  readonly photos: PhotoShow | null;
  readonly #place: Place;
  readonly #content: ViewerContent;
  /** What photos can lie on. */
  readonly #surfaces = new Scene();
  readonly #town: Town | null;
  readonly #scenery: Scenery;
  #backdrop: Backdrop;
  readonly #sunPath: SunPath;
  #changes = 0;
  #shaded = { centre: new Vector3(Infinity, 0, 0), tiles: -1 };

  /** `onChange` is called when something has arrived that is to be drawn. */
  constructor(place: Place, content: ViewerContent, onChange: () => void) {
    const { parts, town, clouds, frusta, textures, houses } = content;
    this.#place = place;
    this.#content = content;
    this.#town = town;
    this.#backdrop = new Backdrop(parts);
    this.#sunPath = sunPathOf(place.sun);
    const alive = new Set(place.animals.map(({ part }) => part));
    const told = cornersOfPlace(place);
    this.solid = town ?? solidOf(place, parts, alive, told);
    // A city model may go far beyond what the photos show.
    const shown = place.clouds.length * place.shots.length > 0 ? cornersOf(boundsOfShots(place.clouds, place.shots)) : told;
    this.corners = shown.length > 0 ? shown : cornersOf(this.solid.bounds);
    this.seen = boxOfPoints([...this.corners, ...told]);
    this.outlook = outlookOf(place.shots) ?? (place.shots.length > 0 ? null : outlookOfFronts(place));
    const buildings = parts.filter(({ part }, index) => !part.isGround && !part.isBackdrop && !alive.has(index));
    const footprints = buildings.flatMap(footprintOf);
    this.#scenery = makeScenery(this.seen, footprints, { lowest_m: lowestGround(place), scaleKnown: place.scaleKnown }, content.budget);
    const { solid } = this;
    const groundAt = solid instanceof PlaceSolid ? (x: number, y: number) => solid.groundAt(x, y) : () => null;
    this.animals = new Animals(place.animals, parts, groundAt, solid);
    this.appearance = new Appearance(parts);
    // After the tints: rooms light the colours that are shown.
    const doors = (): PlaceSolid["doors"] => (this.solid instanceof PlaceSolid ? this.solid.doors : null);
    this.household = new Household(houses, doors, place.tours);
    // A place that is nothing but its ground, such as a map, is looked at from far: without haze.
    if (buildings.length > 0 || town !== null) for (const slot of parts) layIfGround(slot);
    this.scene.add(this.#scenery.group, this.appearance.outline.group, clouds, this.#surfaces, this.household.group);
    for (const { group } of parts) this.#surfaces.add(group);
    if (town !== null) this.#surfaces.add(town.group);
    if (frusta !== null) this.scene.add(frusta.group);
    this.photos = textures === null ? null : this.#showOf(place, textures, onChange);
  }

  /**
   * What the place shows for photos to lie on. Walls that were found in the points are seldom all that
   * photos show.
   */
  get canvas(): "model" | "walls" | "nothing" {
    const { parts } = this.#content;
    const shown = parts.filter(({ group }) => group.visible);
    if (this.#town?.group.visible === true || shown.some(({ part }) => part.layer !== "walls" && !part.isBackdrop)) return "model";
    return shown.length > 0 ? "walls" : "nothing";
  }

  /** What the first picture shows instead of all: an animal that would be but a dot, or a stretch of a street. */
  get firstLook(): FirstLook | null {
    const { shots, start } = this.#place;
    if (!beginsWithAnimal(this.#place)) return shots.length > 0 ? null : lookAlong(this.seen, start);
    const stands = standsOf(this.#place).map((stand, which) => {
      const now = this.animals.goerOf(which);
      return now === null ? stand : { ...stand, at: now.place, ahead: now.ahead };
    });
    const sight = (from: Vec3, along: Vec3): number => this.solid.firstHit(from, along, () => true)?.distance_m ?? Infinity;
    return lookAtAnimals(together(stands), this.#place.start, sight);
  }

  /** Who walks here. */
  get body(): Body {
    return this.household.doors === null ? DEFAULT_WALK.body : INDOOR_BODY;
  }

  /** Clouds of points have come. */
  takeClouds(state: StudioState): void {
    this.photos?.hangAnew();
    this.showLayers(state);
  }

  /** The model of a part has come; the result is what is drawn of it. */
  take(index: number, state: StudioState): void {
    const { parts } = this.#content;
    const slot = parts[index];
    if (slot === undefined) return;
    this.appearance.take(index);
    layIfGround(slot);
    if (this.solid instanceof PlaceSolid) this.solid.take(index);
    this.animals.take(index);
    this.#backdrop = new Backdrop(parts);
    this.light(state.hour);
    this.appearance.tint(state);
    this.showLayers(state);
  }

  /** Shows what the person wants to see, and hides the rest. */
  showLayers(state: StudioState): void {
    const { parts, clouds, frusta, recorded } = this.#content;
    this.appearance.showLayers(state);
    if (!state.off.has("raw")) recorded.fetch();
    recorded.show(false);
    for (const { part, group } of parts) group.visible = part.layer === null || !state.off.has(part.layer);
    if (this.#town !== null) this.#town.group.visible = !state.off.has("model");
    if (frusta !== null) frusta.group.visible = state.shot !== null || !state.off.has("cameras");
    showClouds(clouds, state.off);
    sizePoints(clouds, state.point_px);
    this.photos?.lookAgain();
    this.#scenery.sun.shadow.needsUpdate = true;
  }

  /** What was recorded to the left, if it is wanted, and the place to the right. */
  draw(renderer: WebGLRenderer, camera: PerspectiveCamera, { off, wipe }: StudioState): void {
    if (off.has("raw")) renderer.render(this.scene, camera);
    else this.#content.recorded.draw(renderer, wipe, () => renderer.render(this.scene, camera));
  }

  /** Moves what moves by itself; true while something does. */
  advance(state: StudioState, walker: Walker, eye: Vec3, seconds: number): boolean {
    if (this.#town !== null) return false;
    const animals = this.animals.advance(state.animal, seconds);
    if (animals) this.#scenery.sun.shadow.needsUpdate = true;
    const { doors, lamps } = this.household.advance(state, walker, eye, seconds);
    if (doors) {
      this.#scenery.sun.shadow.needsUpdate = true;
      this.appearance.outlineSelected(state.selected);
    }
    return doors || lamps || animals;
  }

  /** True while a photo comes or goes. */
  fade(state: StudioState, pose: { readonly eye: Vec3; readonly direction: Vec3 }, seconds: number): boolean {
    const walks = state.mode === "walk" && state.shot === null && state.fading;
    const appears = this.#content.frusta?.advance(seconds, state.projected !== null) ?? false;
    return (this.photos?.advance(state, walks ? pose : null, seconds) ?? false) || appears;
  }

  outline(selected: FeatureRef | null): void {
    const { outline } = this.appearance;
    if (this.#town === null) {
      this.appearance.outlineSelected(selected);
      return;
    }
    const faces = selected === null ? null : this.#town.facesOf(selected);
    if (faces === null) outline.clear();
    else outline.showFaces(drawnFaces(faces));
  }

  /** Sets the time of the day; 0 to 24. */
  light(hour: number): void {
    const daylight = daylightAt(hour, this.#sunPath);
    this.#backdrop.light(this.#scenery.light(daylight));
    this.household.daylight = daylight;
  }

  /** Whether something is still on its way, when it is seen from here. */
  update(camera: PerspectiveCamera, renderer: WebGLRenderer): boolean {
    this.#scenery.follow(camera);
    return this.#town !== null && this.#stream(this.#town, camera, renderer);
  }

  dispose(): void {
    this.#town?.dispose();
    this.photos?.dispose();
    this.#content.frusta?.dispose();
    this.#content.morphs?.dispose();
  }

  #showOf(place: Place, textures: PhotoTextures, onChange: () => void): PhotoShow {
    const { clouds, shots } = place;
    const most = Math.max(FEWEST_POINTS, Math.min(MOST_POINTS, MOST_PAIRS / shots.length));
    const points = (): Float32Array => samplePoints(this.#content.clouds, most);
    const [seen, all] = [this.solid.bounds, boundsOfShots(clouds, shots)].map(({ min, max }) => length(subtract(max, min)));
    const size = Math.max(seen ?? 0, all ?? 0);
    const depthOf = ({ eye, ahead }: Axes): number =>
      this.solid.firstHit(eye, ahead, () => true)?.distance_m ?? USUAL_DEPTH * size;
    return new PhotoShow(shots, textures, this.#surfaces, { points, size, depthOf }, onChange);
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
    if (town.changes !== this.#changes) this.photos?.lookAgain();
    this.#changes = town.changes;
    return town.isLoading;
  }
}

/** Where a building stands, or will; drawn frame. */
function footprintOf({ part, group, isThere }: PartSlot): Box3[] {
  if (isThere) return [new Box3().setFromObject(group)];
  if (part.bounds === null) return [];
  const corners = cornersOf(part.bounds).map((corner) => new Vector3(...drawnFromWorld(worldPoint(part.worldFromPart, corner))));
  return [new Box3().setFromPoints(corners)];
}

/** What lives is nothing that one bumps into. */
function solidOf(place: Place, parts: readonly PartSlot[], alive: ReadonlySet<number>, seen: readonly Vec3[]): PlaceSolid | OpenSpace {
  if (parts.length === 0) return new OpenSpace(boundsOfShots(place.clouds, place.shots));
  return alive.size === parts.length ? new OpenSpace(boxOfPoints(seen)) : new PlaceSolid(parts, alive);
}

function layIfGround({ part, meshes }: PartSlot): void {
  if (part.isGround) for (const { mesh } of meshes) layGround(mesh);
}
