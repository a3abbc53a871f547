/** Opens the place that the page's address asks for. */
import { STANDING } from "../core/animal.ts";
import { beginsWithAnimal } from "../core/animal-view.ts";
import type { Missing } from "../core/asking.ts";
import { type Budget, budgetOf } from "../core/budget.ts";
import { type SunPath, sunPathOf } from "../core/daylight.ts";
import { Fault } from "../core/fault.ts";
import type { FeatureTable } from "../core/features.ts";
import type { House } from "../core/house.ts";
import type { MorphState } from "../core/morph-walk.ts";
import { fileAddress, placeAddress, readPlace, type Place } from "../core/place.ts";
import type { FeatureRef, Layer, StudioState } from "../core/state.ts";
import type { Store } from "../core/store.ts";
import { fetchText } from "../three/fetch.ts";
import type { Town } from "../three/town.ts";
import type { Viewer } from "../three/viewer.ts";
import { Arriving, type Asked, type OnProgress } from "./arriving.ts";
import { firstOff, recordsOf } from "./first-layers.ts";
import { HeadStart } from "./head-start.ts";

export interface Session {
  readonly place: Place;
  readonly tables: readonly FeatureTable[];
  /** Those that one can walk in; empty where the place has none. */
  readonly houses: readonly House[];
  /** The sun over the place through its day. */
  readonly sunPath: SunPath;
  /** Whether there are lamps in them. */
  readonly hasLamps: boolean;
  /** Files that are on their way, those of which nobody is told since they come and go as one looks about, and those that did not come. */
  readonly onTheWay: { readonly waiting: number; readonly unseen: number; readonly missing: readonly Missing[] };
  /** Asks at once for what did not come. */
  askNow(): void;
  readonly viewer: Viewer;
  readonly loadSeconds: number;
  /** A place that is streamed; its tables grow as tiles arrive. */
  readonly town: Town | null;
  /** The layers that the place has beside its classes, in the order of the panel. */
  readonly records: readonly Layer[];
  /** Of the part, or of the building in a streamed place. */
  nameOf(ref: FeatureRef): string;
  photoAddress(part: number): string | null;
  /** A photo of the place, no larger than wanted. */
  readonly bitmap: (index: number, side_px: number) => Promise<ImageBitmap>;
}

/** Nothing is left over of a place that cannot be opened: neither what asks for its files nor what draws it. */
export async function openPlace(
  page: URL,
  canvas: HTMLCanvasElement,
  store: Store<StudioState>,
  onProgress: OnProgress,
  onShown: () => void,
): Promise<Session> {
  const begin = performance.now();
  checkWebGL();
  const asked = await ask(page, onProgress);
  const budget = budgetOf(asked.place, { isSmall: matchMedia("(pointer: coarse)").matches });
  const arriving = new Arriving(asked, budget, onShown);
  try {
    await arriving.begin(onProgress);
    const viewer = viewerOf(asked, arriving, budget, canvas, store);
    arriving.viewer = viewer;
    viewer.warm();
    await arriving.arrived();
    await viewer.prepare();
    onProgress(1, "");
    arriving.goOn();
    return sessionOf(asked, arriving, viewer, (performance.now() - begin) / 1000);
  } catch (error) {
    arriving.dispose();
    throw error;
  }
}

/** The place's index, and all that can be asked for meanwhile. */
async function ask(page: URL, onProgress: OnProgress): Promise<Asked> {
  const address = placeAddress(page);
  // The index of the place is asked for first: the program's pieces would stand before it in the browser's queue.
  const text = fetchText(address, "place.json");
  const drawing = import("./drawing.ts");
  onProgress(0, "place.json");
  const place = readPlace(await text, "place.json");
  const headStart = new HeadStart(place.tileset === null ? place.parts : [], address, (share, file) => onProgress(0.97 * share, file));
  return { place, address, drawing: await drawing, headStart };
}

function viewerOf({ place, address, drawing }: Asked, arriving: Arriving, budget: Budget, canvas: HTMLCanvasElement, store: Store<StudioState>): Viewer {
  const { MorphShow, PhotoTextures, Frusta } = drawing;
  const { parts, recorded, town, houses, wishes, clouds } = arriving;
  const invalidate = (): void => arriving.viewer?.invalidate();
  const textures = place.shots.length === 0 ? null : new PhotoTextures(place.shots, address, budget.mostTexture_px, wishes);
  const frusta = textures === null ? null : new Frusta(place, textures, invalidate);
  store.update({ animal: { ...STANDING, following: beginsWithAnimal(place) } });
  store.update({ off: firstOff(place), fading: !place.hidden.has("photos"), hour: sunPathOf(place.sun).firstHour });
  const morphs = place.walks.length === 0 ? null : new MorphShow(place.walks, address, budget.mostTexture_px, invalidate, wishes);
  if (morphs !== null) store.update({ morph: strollFrom(0) });
  return new drawing.Viewer(canvas, place, { parts, recorded, town, clouds: clouds.group, frusta, textures, houses, budget, morphs }, store);
}

function sessionOf({ place, address, drawing }: Asked, arriving: Arriving, viewer: Viewer, loadSeconds: number): Session {
  const { town, houses } = arriving;
  return {
    place,
    get tables() {
      return arriving.tables;
    },
    town,
    sunPath: sunPathOf(place.sun),
    get houses() {
      return houses.map(({ house }) => house);
    },
    get hasLamps() {
      return houses.some(({ house }) => house.storeys.some(({ lamps }) => lamps.length > 0));
    },
    get onTheWay() {
      return arriving.onTheWay;
    },
    askNow: () => arriving.askNow(),
    records: recordsOf(place, town !== null),
    nameOf: (ref) => town?.nameOf(ref) ?? place.parts[ref.part]?.name ?? "",
    viewer,
    bitmap: async (index, side_px) => {
      const shot = place.shots[index];
      if (shot === undefined) throw new Fault(`photo ${index}`, "the place has none of that number", "Reload the page.");
      return await drawing.bitmapOf(shot, address, side_px, "from-image");
    },
    loadSeconds,
    photoAddress: (index) => {
      const photo = town === null ? (place.parts[index]?.photo ?? null) : null;
      return photo === null ? null : fileAddress(photo, address).href;
    },
  };
}

/** The part, or the building in a streamed place: ids are of one of them alone. */
export function ownerOf(session: Session, ref: FeatureRef): string {
  return session.town === null ? (session.place.parts[ref.part]?.id ?? "") : session.nameOf(ref);
}

/** At the beginning of a walk; whoever wants less motion goes from view to view at once. */
export function strollFrom(which: number): MorphState {
  const instant = matchMedia("(prefers-reduced-motion: reduce)").matches;
  return { which, at: 0, playing: false, look: "picture", instant };
}

/** Nothing can be drawn in space. */
export class NoWebGL extends Fault {}

function checkWebGL(): void {
  const context = document.createElement("canvas").getContext("webgl2");
  if (context === null) {
    throw new NoWebGL(
      "This browser",
      "it offers no WebGL 2, with which the place is drawn",
      "Switch on hardware acceleration in the browser's settings, update the browser or the graphics driver, or try Firefox, Chrome, Edge or Safari on another machine.",
    );
  }
  context.getExtension("WEBGL_lose_context")?.loseContext();
}
