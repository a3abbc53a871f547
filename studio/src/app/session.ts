/** Opens the place that the page's address asks for. */
import type { FeatureTable } from "../core/features.ts";
import { STANDING } from "../core/animal.ts";
import { beginsWithAnimal } from "../core/animal-view.ts";
import type { Missing } from "../core/asking.ts";
import { budgetOf } from "../core/budget.ts";
import { type SunPath, sunPathOf } from "../core/daylight.ts";
import { Fault } from "../core/fault.ts";
import type { House } from "../core/house.ts";
import type { MorphState } from "../core/morph-walk.ts";
import { fileAddress, type Part, placeAddress, readPlace, type Place } from "../core/place.ts";
import type { FeatureRef, Layer, StudioState } from "../core/state.ts";
import type { Sight } from "../core/sight.ts";
import type { Store } from "../core/store.ts";
import { Wishes } from "../core/wishes.ts";
import { Arrivals } from "../three/arrivals.ts";
import { fetchBytes, fetchText } from "../three/fetch.ts";
import type { LoadedHouse } from "../three/household.ts";
import type { Town } from "../three/town.ts";
import type { Viewer } from "../three/viewer.ts";
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

/** A place of so few parts is shown when all have come: they belong together, as a house and its garden do. */
const FEW_PARTS = 4;

/** Nothing is left over of a place that cannot be opened: neither what asks for its files nor what draws it. */
export async function openPlace(
  page: URL,
  canvas: HTMLCanvasElement,
  store: Store<StudioState>,
  onProgress: (share: number, file: string) => void,
  onShown: () => void,
): Promise<Session> {
  const opened: Opened[] = [];
  try {
    return await open(page, canvas, store, onProgress, onShown, opened);
  } catch (error) {
    for (const one of opened.reverse()) one.dispose();
    throw error;
  }
}

interface Opened {
  dispose(): void;
}

async function open(
  page: URL,
  canvas: HTMLCanvasElement,
  store: Store<StudioState>,
  onProgress: (share: number, file: string) => void,
  onShown: () => void,
  opened: Opened[],
): Promise<Session> {
  const begin = performance.now();
  checkWebGL();
  const address = placeAddress(page);
  // The index of the place is asked for first: the program's pieces would stand before it in the browser's queue.
  const text = fetchText(address, "place.json");
  const drawing = import("./drawing.ts");
  onProgress(0, "place.json");
  const place = readPlace(await text, "place.json");
  const { tileset } = place;
  const wanted = tileset === null ? place.parts : [];
  const shares = wanted.map(() => 0);
  const fetchPart = async ({ model }: Part, index: number): Promise<ArrayBuffer> => {
    return await fetchBytes(fileAddress(model, address), model, (got, total) => {
      shares[index] = total === null ? 0.5 : got / total;
      onProgress(0.97 * Math.max(0.02, mean(shares)), model);
    });
  };
  const headStart = new HeadStart(wanted.length <= FEW_PARTS ? wanted : [], fetchPart);
  const { CloudArrivals, Frusta, Grower, bringHouse, readPart, MorphShow, PartSlot, stillOf, SharedImages, bitmapOf, PhotoTextures, bringingBy, Recorded, Town, Viewer } =
    await drawing;
  const budget = budgetOf(place, { isSmall: matchMedia("(pointer: coarse)").matches });
  let viewer: Viewer | null = null;
  const town =
    tileset === null
      ? null
      : new Town(fileAddress(tileset, address), budget, () => viewer?.invalidate(), onShown);
  // A viewer lets go of what it draws.
  opened.push({
    dispose: () => {
      (viewer ?? town)?.dispose();
      viewer = null; // for what comes after that
    },
  });
  const parts = wanted.map((part) => new PartSlot(part));
  const images = new SharedImages(budget.mostTexture_px);
  // What is asked for as one looks about: pictures, models of a walk, documents.
  const wishes = new Wishes(() => {
    viewer?.invalidate();
    onShown();
  });
  const alive = new Set(place.animals.map(({ part }) => part));
  const grower = new Grower();
  opened.push(wishes, grower);
  const houses: LoadedHouse[] = [];
  let tables: readonly FeatureTable[] = parts.map(({ table }) => table);
  const sight = (): Sight => viewer?.sight ?? { eye: place.start.eye, direction: null, half_rad: 0 };
  const bring = async (index: number): Promise<void> => {
    const slot = parts[index];
    if (slot === undefined) return;
    const loaded = await readPart(slot.part, await headStart.bytesOf(slot.part, index), images);
    loaded.group.updateMatrixWorld(true);
    const meets = !slot.part.isBackdrop && !alive.has(index);
    const taken = (meets ? grower.solidOf(stillOf(loaded), index) : Promise.resolve(null)).then((solid) => {
      slot.take(loaded, solid);
      tables = [...tables]; // the panels count anew
      viewer?.take(index);
    });
    // Its document comes while the worker builds what one bumps into.
    const house = bringHouse(loaded, address, houses.length, wishes, taken, (one) => {
      houses.push({ house: one, part: slot });
      viewer?.household.take({ house: one, part: slot });
    });
    await Promise.all([taken, house]);
    viewer?.warm(slot.group); // not before: with its rooms a house is drawn by other programs
  };
  const arrivals = new Arrivals(wanted, sight, bring, onShown);
  opened.push(arrivals);
  arrivals.start();
  await town?.open((share) => onProgress(share, "tileset.json"));
  const isSized = parts.every(({ part }) => part.bounds !== null);
  const arrived = async (): Promise<void> => {
    await (parts.length <= FEW_PARTS || !isSized ? arrivals.tried() : arrivals.first());
    const [firstMissing] = arrivals.missing;
    if (firstMissing !== undefined && !parts.some(({ isThere }) => isThere)) throw firstMissing.fault;
  };
  if (!isSized) await arrived();
  const showClouds = (): void => {
    viewer?.takeClouds();
    onShown();
  };
  const clouds = new CloudArrivals(place.clouds, address, showClouds);
  opened.push(clouds);
  // Points are waited for where there is nothing else to see.
  const isCloudAlone = place.parts.length + place.walks.length === 0 && town === null;
  if (isCloudAlone) await clouds.bring((share, file) => onProgress(0.97 * share, file));
  const [firstCloud] = clouds.missing;
  if (firstCloud !== undefined && clouds.group.children.length === 0) throw firstCloud.fault;
  const textures = place.shots.length === 0 ? null : new PhotoTextures(place.shots, address, budget.mostTexture_px, wishes);
  const frusta = textures === null ? null : new Frusta(place, textures, () => viewer?.invalidate());
  const sunPath = sunPathOf(place.sun);
  store.update({ animal: { ...STANDING, following: beginsWithAnimal(place) } });
  store.update({ off: firstOff(place), fading: !place.hidden.has("photos"), hour: sunPath.firstHour });
  const morphs = place.walks.length === 0 ? null : new MorphShow(place.walks, address, budget.mostTexture_px, () => viewer?.invalidate(), wishes);
  if (morphs !== null) store.update({ morph: strollFrom(0) });
  const recorded = new Recorded(
    parts,
    async (part) => {
      const bytes = await fetchBytes(fileAddress(part.model, address), part.model, () => undefined);
      return (await readPart(part, bytes, images)).group.children;
    },
    () => {
      viewer?.invalidate();
      onShown();
    },
    bringingBy(sight),
  );
  opened.push(recorded);
  viewer = new Viewer(canvas, place, { parts, recorded, town, clouds: clouds.group, frusta, textures, houses, budget, morphs }, store);
  viewer.warm();
  await arrived();
  await viewer.prepare();
  onProgress(1, "");
  if (!isCloudAlone) void clouds.bring(() => undefined).then(showClouds);
  return {
    place,
    get tables() {
      return town?.tables ?? tables;
    },
    town,
    sunPath,
    get houses() {
      return houses.map(({ house }) => house);
    },
    get hasLamps() {
      return houses.some(({ house }) => house.storeys.some(({ lamps }) => lamps.length > 0));
    },
    get onTheWay() {
      const missing = [...(town?.missing ?? arrivals.missing), ...recorded.missing, ...clouds.missing, ...wishes.missing];
      return { waiting: arrivals.waiting + recorded.waiting + clouds.waiting, unseen: wishes.waiting, missing };
    },
    askNow: () => {
      arrivals.askNow();
      recorded.askNow();
      clouds.askNow();
      wishes.askNow();
      town?.askNow();
    },
    records: recordsOf(place, town !== null),
    nameOf: (ref) => town?.nameOf(ref) ?? place.parts[ref.part]?.name ?? "",
    viewer,
    bitmap: async (index, side_px) => {
      const shot = place.shots[index];
      if (shot === undefined) throw new Fault(`photo ${index}`, "the place has none of that number", "Reload the page.");
      return await bitmapOf(shot, address, side_px, "from-image");
    },
    loadSeconds: (performance.now() - begin) / 1000,
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

function mean(values: readonly number[]): number {
  return values.reduce((sum, value) => sum + value, 0) / Math.max(1, values.length);
}

/** What lies in one another is not seen at once: first the model, and points in their own colours. */
function firstOff({ parts, clouds, tileset, hidden }: Place): ReadonlySet<Layer> {
  const hasModel = tileset !== null || parts.some(({ layer }) => layer === "model");
  const asked = (["points", "cameras"] as const).filter((layer) => hidden.has(layer));
  const doubled = clouds.some(({ layer }) => layer === "distances") ? (["distances"] as const) : [];
  const recorded = parts.some(({ raw }) => raw !== null) ? (["raw"] as const) : [];
  return new Set<Layer>([...(hasModel ? (["walls"] as const) : []), ...doubled, ...recorded, ...asked]);
}

function recordsOf({ parts, clouds, shots }: Place, hasTown: boolean): Layer[] {
  const isRecorded = !hasTown && parts.some(({ raw }) => raw !== null);
  if (clouds.length + shots.length === 0 && !isRecorded) return [];
  const has: Readonly<Record<Layer, boolean>> = {
    model: hasTown || parts.some(({ layer }) => layer === "model"),
    walls: !hasTown && parts.some(({ layer }) => layer === "walls"),
    points: clouds.some(({ layer }) => layer === "points"),
    distances: clouds.some(({ layer }) => layer === "distances"),
    cameras: shots.length > 0,
    raw: isRecorded,
    backdrop: false, // a switch of the house's own panel
  };
  return (["model", "raw", "walls", "points", "distances", "cameras"] as const).filter((layer) => has[layer]);
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
