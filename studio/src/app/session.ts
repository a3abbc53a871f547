/** Opens the place that the page's address asks for. */
import type { FeatureTable } from "../core/features.ts";
import { Fault } from "../core/fault.ts";
import { fileAddress, placeAddress, readPlace, type Place } from "../core/place.ts";
import type { StudioState } from "../core/state.ts";
import type { Store } from "../core/store.ts";
import type { Viewer } from "../three/viewer.ts";

export interface Session {
  readonly place: Place;
  readonly tables: readonly FeatureTable[];
  readonly viewer: Viewer;
  readonly loadSeconds: number;
  photoAddress(part: number): string | null;
}

export async function openPlace(
  page: URL,
  canvas: HTMLCanvasElement,
  store: Store<StudioState>,
  onProgress: (share: number, file: string) => void,
): Promise<Session> {
  const begin = performance.now();
  checkWebGL();
  const address = placeAddress(page);
  // three.js is most of the program; it arrives while the place does.
  const drawing = Promise.all([
    import("../three/fetch.ts"),
    import("../three/load.ts"),
    import("../three/viewer.ts"),
  ]);
  onProgress(0, "place.json");
  const [{ fetchText }, { loadParts }, { Viewer }] = await drawing;
  const place = readPlace(await fetchText(address, "place.json"), "place.json");
  const parts = await loadParts(place, address, (share, file) => onProgress(0.97 * share, file));
  const viewer = new Viewer(canvas, place, parts, store);
  await viewer.prepare();
  onProgress(1, "");
  return {
    place,
    tables: parts.map(({ table }) => table),
    viewer,
    loadSeconds: (performance.now() - begin) / 1000,
    photoAddress: (index) => {
      const photo = place.parts[index]?.photo ?? null;
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
