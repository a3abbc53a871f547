/** Which layers a place has beside its classes, and which are not shown at first. */
import type { Place } from "../core/place.ts";
import type { Layer } from "../core/state.ts";

/** What lies in one another is not seen at once: first the model, and points in their own colours. */
export function firstOff({ parts, clouds, tileset, hidden }: Place): ReadonlySet<Layer> {
  const hasModel = tileset !== null || parts.some(({ layer }) => layer === "model");
  const asked = (["points", "cameras"] as const).filter((layer) => hidden.has(layer));
  const doubled = clouds.some(({ layer }) => layer === "distances") ? (["distances"] as const) : [];
  const recorded = parts.some(({ raw }) => raw !== null) ? (["raw"] as const) : [];
  return new Set<Layer>([...(hasModel ? (["walls"] as const) : []), ...doubled, ...recorded, ...asked]);
}

/** In the order of the panel. */
export function recordsOf({ parts, clouds, shots }: Place, hasTown: boolean): Layer[] {
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
