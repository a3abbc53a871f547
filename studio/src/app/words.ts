/** What the page says of itself: the title of the place, and what one can do. */
import { lengthOf } from "../core/morph-walk.ts";
import { standsAlone } from "../core/place.ts";
import type { StudioState } from "../core/state.ts";
import type { Session } from "./session.ts";

export function titleOf(session: Session): string {
  const { title } = session.place.about;
  if (title !== "") return title;
  if (session.town !== null) return "A town of many buildings";
  const { shots, scaleKnown, walks } = session.place;
  const walk = walks[0];
  if (walk !== undefined) return `A walk of ${lengthOf(walk)}`;
  const parts = session.place.parts.filter(({ layer }) => layer === "model");
  if (shots.length > 0 || parts.length === 0) {
    const photos = shots.length === 1 ? "1 photo" : `${shots.length} photos`;
    const all = parts.length > 1 ? `${parts.length} buildings, ${photos}` : photos;
    return scaleKnown ? all : `${all}, scale unknown`;
  }
  const first = parts[0]?.name ?? "";
  const alone = standsAlone(parts);
  if (alone !== null) return alone.name;
  return parts.length > 1 ? `${first} and ${parts.length - 1} more` : first;
}

export function hintOf(state: StudioState, coarse: boolean, hasPhotos: boolean): string {
  if (state.morph !== null) return coarse ? "Stick to walk on, drag to look" : "W and S or the wheel to walk · drag to look · 1 for the whole";
  if (state.projected !== null && !coarse) return "T takes the photo off the place · N and B throw the others";
  if (state.mode === "orbit" && hasPhotos) {
    return coarse ? "Drag to turn, tap a photo to look through it" : "Drag to turn · scroll to zoom · click a photo to look through it";
  }
  if (state.mode === "orbit") return coarse ? "Drag to turn, tap a surface to ask" : "Drag to turn · scroll to zoom · click a surface to ask";
  if (state.mouseLook) return "Move the mouse to look · click to ask · Esc lets go";
  return coarse ? "Stick to walk, drag to look" : "W A S D to walk · drag to look · Shift to run";
}
