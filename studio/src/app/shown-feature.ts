/** What the panel says of the surface that is selected. */
import { standsAlone } from "../core/place.ts";
import type { FeatureRef } from "../core/state.ts";
import type { ShownFeature } from "./feature-panel.ts";
import type { Session } from "./session.ts";

/** Null where nothing is selected, or what was is no longer there. */
export function shownFeature(session: Session, selected: FeatureRef | null): ShownFeature | null {
  if (selected === null) return null;
  const table = session.tables[selected.part];
  const feature = table?.rows[selected.row];
  if (table === undefined || feature === undefined) return null;
  const part = session.place.parts[selected.part];
  return {
    feature,
    row: selected.row,
    table,
    partName: session.nameOf(selected),
    severalParts: session.town !== null || standsAlone(session.place.parts) === null,
    scaleKnown: session.place.scaleKnown,
    arrangementInvented: session.town === null && part?.arrangement === "invented",
    photoAddress: session.photoAddress(selected.part),
  };
}
