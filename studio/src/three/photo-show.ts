/**
 * The photos that lie on the place: the one that the person has chosen, or those that are much as the
 * visitor sees. They lie on its surfaces; where it shows none, each hangs on the plane of its points.
 */
import {
  BufferAttribute,
  BufferGeometry,
  type Camera,
  DoubleSide,
  Mesh,
  PlaneGeometry,
  Scene,
  ShaderMaterial,
  type WebGLRenderer,
} from "three";
import { drawnFromWorld } from "../core/frames.ts";
import { approached, chosenPhotos, nearestPhoto, type Vantage, type Visitor } from "../core/photo-choice.ts";
import { type Axes, axesOf } from "../core/pinhole.ts";
import type { Shot } from "../core/place.ts";
import { cornersOfProxy, focusOf, type Proxy, proxyOf } from "../core/proxy.ts";
import type { StudioState } from "../core/state.ts";
import { CHOSEN_PX, PASSING_PX, type PhotoTextures } from "./photo-textures.ts";
import { lightOf, makeProjection, setLights } from "./projection-material.ts";
import { Projector } from "./projector.ts";
import { SLOTS } from "./projection-shader.ts";

/** Photos between which a surface is parted; the last slot is for one that is going. */
const MOST_PASSING = SLOTS - 1;
const PASSING_S = 0.6;
const CHOSEN_S = 0.2;
/** How far a photo reaches, in sizes of the place. */
const FAR = 4;

interface Lamp {
  readonly index: number;
  readonly side_px: number;
  readonly isChosen: boolean;
  level: number;
  wanted: number;
  share: number;
  /** Null while the photo is on its way, or where it cannot be had. */
  projector: Projector | null;
  screen: Mesh<BufferGeometry, ShaderMaterial> | null;
}

interface Wanted {
  readonly index: number;
  readonly isChosen: boolean;
  readonly level: number;
  readonly share: number;
}

export interface ShownPhoto {
  readonly index: number;
  /** How far it has faded in, 0..1. */
  readonly level: number;
}

/** What the photos show. */
export interface Subject {
  /** Some of the place's points that have come: three numbers each, world frame. */
  readonly points: () => Float32Array;
  /** How large the place is. */
  readonly size: number;
  /** How deep the middle of a photo is, where points do not tell. */
  readonly depthOf: (axes: Axes) => number;
}

export class PhotoShow {
  readonly #shots: readonly Shot[];
  readonly #textures: PhotoTextures;
  readonly #surfaces: Scene;
  readonly #subject: Subject;
  readonly #onChange: () => void;
  readonly #material = makeProjection(DoubleSide);
  readonly #screens = new Scene();
  #lamps: Lamp[] = [];
  #proxies: readonly Proxy[] | null = null;
  #vantages: readonly Vantage[] = [];

  constructor(
    shots: readonly Shot[],
    textures: PhotoTextures,
    surfaces: Scene,
    subject: Subject,
    onChange: () => void,
  ) {
    this.#shots = shots;
    this.#textures = textures;
    this.#surfaces = surfaces;
    this.#subject = subject;
    this.#onChange = onChange;
  }

  get shown(): readonly ShownPhoto[] {
    return this.#lamps
      .filter(({ projector, level }) => projector !== null && level > 0)
      .map(({ index, level }) => ({ index, level }));
  }

  /** The photo that shows most of what the visitor sees. */
  nearest(visitor: Visitor): number | null {
    return nearestPhoto(visitor, this.#places());
  }

  /** `visitor` is null unless photos are to fade in. True while something still changes. */
  advance(state: StudioState, visitor: Visitor | null, seconds: number): boolean {
    this.#want(this.#wantedBy(state, visitor));
    let moves = false;
    for (const lamp of this.#lamps) {
      if (lamp.projector === null) continue;
      const level = approached(lamp.level, lamp.wanted, seconds, lamp.isChosen ? CHOSEN_S : PASSING_S);
      moves ||= level !== lamp.level;
      lamp.level = level;
    }
    for (const lamp of this.#lamps.filter(({ level, wanted }) => level === 0 && wanted === 0)) this.#drop(lamp);
    return moves;
  }

  /** The surfaces are others than they were: what hides what is to be found anew. */
  lookAgain(): void {
    for (const { projector } of this.#lamps) projector?.lookAgain();
  }

  /** More of the points has come: where photos hang is to be found anew. */
  hangAnew(): void {
    this.#proxies = null;
    for (const lamp of this.#lamps) {
      lamp.screen?.geometry.dispose();
      lamp.screen?.material.dispose();
      lamp.screen = null;
    }
  }

  /**
   * Over the picture that has just been drawn. `canvas` is what there is to lie on: on walls alone the
   * one that is chosen lies, and those in passing are hung up whole. `isThrough`: one looks through
   * the photo, so that nothing may stand before it.
   */
  draw(renderer: WebGLRenderer, camera: Camera, canvas: "model" | "walls" | "nothing", isThrough: boolean): void {
    const lit = this.#lamps.filter(({ projector, level }) => projector !== null && level > 0);
    if (lit.length === 0) return;
    const laid = lit.filter(({ isChosen }) => canvas === "model" || (canvas === "walls" && isChosen));
    const hung = lit.filter((lamp) => !laid.includes(lamp));
    const { autoClear } = renderer;
    for (const { projector } of laid) projector?.look(renderer, this.#surfaces);
    renderer.autoClear = false;
    if (laid.length > 0) {
      setLights(this.#material, laid.map(lightOfLamp));
      this.#surfaces.overrideMaterial = this.#material;
      renderer.render(this.#surfaces, camera);
      this.#surfaces.overrideMaterial = null;
    }
    if (hung.length > 0) {
      this.#hang(hung, isThrough);
      renderer.render(this.#screens, camera);
    }
    renderer.autoClear = autoClear;
  }

  dispose(): void {
    for (const lamp of [...this.#lamps]) this.#drop(lamp);
    this.#material.dispose();
    this.#textures.dispose();
  }

  #wantedBy(state: StudioState, visitor: Visitor | null): Wanted[] {
    const { projected, cover } = state;
    if (projected !== null) return [{ index: projected, isChosen: true, level: cover, share: 1 }];
    if (visitor === null) return [];
    const shown = new Set(this.#lamps.filter(({ wanted }) => wanted > 0).map(({ index }) => index));
    return chosenPhotos(visitor, this.#places(), shown, MOST_PASSING).map((photo) => ({ ...photo, isChosen: false }));
  }

  #want(wishes: readonly Wanted[]): void {
    for (const lamp of this.#lamps) lamp.wanted = 0;
    for (const { index, isChosen, level, share } of wishes) {
      let lamp = this.#lamps.find((known) => known.index === index && known.isChosen === isChosen);
      if (lamp === undefined) {
        // One that is asked for has no time to wait until another has gone.
        if (this.#lamps.length >= SLOTS && isChosen) this.#drop(this.#lamps[0]);
        if (this.#lamps.length >= SLOTS) continue;
        lamp = this.#light(index, isChosen);
      }
      lamp.wanted = level;
      lamp.share = share;
    }
  }

  #light(index: number, isChosen: boolean): Lamp {
    const side_px = isChosen ? CHOSEN_PX : PASSING_PX;
    const lamp: Lamp = { index, side_px, isChosen, level: 0, wanted: 0, share: 1, projector: null, screen: null };
    this.#lamps.push(lamp);
    void this.#textures.acquire(index, side_px).then((texture) => {
      const shot = this.#shots[index];
      if (texture === null || shot === undefined || !this.#lamps.includes(lamp)) return;
      lamp.projector = new Projector(shot, texture, FAR * this.#subject.size);
      this.#onChange();
    });
    return lamp;
  }

  #drop(lamp: Lamp | undefined): void {
    if (lamp === undefined) return;
    this.#lamps = this.#lamps.filter((other) => other !== lamp);
    this.#textures.release(lamp.index, lamp.side_px);
    lamp.projector?.dispose();
    lamp.screen?.geometry.dispose();
    lamp.screen?.material.dispose();
  }

  /** The plane of each photo, in the order in which they are drawn: the nearest last. */
  #hang(lit: readonly Lamp[], isThrough: boolean): void {
    this.#screens.clear();
    for (const [order, lamp] of lit.toSorted((a, b) => a.share - b.share).entries()) {
      lamp.screen ??= this.#screenOf(lamp);
      lamp.screen.renderOrder = order;
      // A visitor sees the photo instead of the points; one that is chosen hangs among them.
      lamp.screen.material.depthTest = lamp.isChosen && !isThrough;
      setLights(lamp.screen.material, [lightOfLamp(lamp)]);
      this.#screens.add(lamp.screen);
    }
  }

  #screenOf(lamp: Lamp): Mesh<BufferGeometry, ShaderMaterial> {
    this.#places();
    const shot = this.#shots[lamp.index];
    const proxy = this.#proxies?.[lamp.index];
    const geometry = new PlaneGeometry(1, 1);
    const corners = shot === undefined || proxy === undefined ? [] : cornersOfProxy(shot, proxy);
    const position = new Float32Array(12);
    for (const [k, corner] of corners.entries()) position.set(drawnFromWorld(corner), 3 * k);
    geometry.setAttribute("position", new BufferAttribute(position, 3));
    geometry.computeBoundingSphere();
    return new Mesh(geometry, makeProjection(DoubleSide));
  }

  /** Found when they are first wanted: a place is shown before anybody knows whether they will be. */
  #places(): readonly Vantage[] {
    if (this.#proxies !== null) return this.#vantages;
    const { points, depthOf } = this.#subject;
    const sampled = points();
    const proxies = this.#shots.map((shot) => proxyOf(shot, sampled, depthOf));
    this.#proxies = proxies;
    this.#vantages = this.#shots.flatMap((shot, k) => {
      const proxy = proxies[k];
      return proxy === undefined ? [] : [{ eye: axesOf(shot).eye, focus: focusOf(shot, proxy) }];
    });
    return this.#vantages;
  }
}

function lightOfLamp({ projector, level, share, isChosen }: Lamp): ReturnType<typeof lightOf> {
  return lightOf(projector, level, share, isChosen);
}
