/** Opens the place that the page's address asks for. */
import type { FeatureTable } from "../core/features.ts";
import { Fault } from "../core/fault.ts";
import { fileAddress, placeAddress, readPlace, type Place } from "../core/place.ts";
import type { FeatureRef, StudioState } from "../core/state.ts";
import type { Store } from "../core/store.ts";
import type { Town } from "../three/town.ts";
import type { Viewer } from "../three/viewer.ts";

export interface Session {
  readonly place: Place;
  readonly tables: readonly FeatureTable[];
  readonly viewer: Viewer;
  readonly loadSeconds: number;
  /** A place that is streamed; its tables grow as tiles arrive. */
  readonly town: Town | null;
  /** Of the part, or of the building in a streamed place. */
  nameOf(ref: FeatureRef): string;
  photoAddress(part: number): string | null;
}

export async function openPlace(
  page: URL,
  canvas: HTMLCanvasElement,
  store: Store<StudioState>,
  onProgress: (share: number, file: string) => void,
  onShown: () => void,
  onFault: (fault: Fault) => void,
): Promise<Session> {
  const begin = performance.now();
  checkWebGL();
  const address = placeAddress(page);
  // three.js is most of the program; it arrives while the place does.
  const drawing = Promise.all([
    import("../three/clouds.ts"),
    import("../three/fetch.ts"),
    import("../three/frusta.ts"),
    import("../three/load.ts"),
    import("../three/town.ts"),
    import("../three/viewer.ts"),
  ]);
  onProgress(0, "place.json");
  const [{ loadClouds }, { fetchText }, { Frusta }, { loadParts }, { Town }, { Viewer }] = await drawing;
  const place = readPlace(await fetchText(address, "place.json"), "place.json");
  const { tileset } = place;
  const grounds = place.parts.filter(({ isGround }) => isGround).map(({ model }) => fileAddress(model, address));
  let viewer: Viewer | null = null;
  const town =
    tileset === null
      ? null
      : new Town(fileAddress(tileset, address), grounds, () => viewer?.invalidate(), onShown);
  const parts =
    tileset === null
      ? await loadParts(place, address, (share, file) => onProgress(0.97 * share, file))
      : [];
  await town?.open((share) => onProgress(share, "tileset.json"));
  const clouds = await loadClouds(place.clouds, address, (share, file) => onProgress(0.97 * share, file));
  const frusta =
    place.shots.length === 0 ? null : new Frusta(place, address, () => viewer?.invalidate(), onFault);
  viewer = new Viewer(canvas, place, { parts, town, clouds, frusta }, store);
  await viewer.prepare();
  onProgress(1, "");
  return {
    place,
    tables: town?.tables ?? parts.map(({ table }) => table),
    town,
    nameOf: (ref) => town?.nameOf(ref) ?? place.parts[ref.part]?.name ?? "",
    viewer,
    loadSeconds: (performance.now() - begin) / 1000,
    photoAddress: (index) => {
      const photo = town === null ? (place.parts[index]?.photo ?? null) : null;
      return photo === null ? null : fileAddress(photo, address).href;
    },
  };
}

function checkWebGL(): void {
  const context = document.createElement("canvas").getContext("webgl2");
  if (context === null) {
    throw new Fault(
      "This browser",
      "it offers no WebGL 2, with which the place is drawn",
      "Switch on hardware acceleration in the browser's settings, update the browser or the graphics driver, or try Firefox, Chrome, Edge or Safari on another machine.",
    );
  }
  context.getExtension("WEBGL_lose_context")?.loseContext();
}
