/**
 * `window.veduta`: what the page shows, for tests and for the curious. `do` is the bus of commands.
 * All else only tells. Lengths in metres, world frame (x east, y north, z up); angles in
 * degrees. The page says that it is ready (or failed) in `<html data-veduta="ready|error">`.
 */
import type { Feature } from "../core/features.ts";
import type { MorphState } from "../core/morph-walk.ts";
import type { StrollCost } from "../three/morph-show.ts";
import { roomsOf } from "../core/room-map.ts";
import type { StudioState } from "../core/state.ts";
import { stretchAt } from "../core/tour.ts";
import type { Store } from "../core/store.ts";
import type { Vec3 } from "../core/vector.ts";
import { roomTitle } from "../core/whereabouts.ts";
import type { ViewerStats } from "../three/viewer.ts";
import type { Commands, Told } from "./commands.ts";
import { ownerOf, type Session } from "./session.ts";

export interface Inspection {
  /** Does what a key, a button or a panel would; told what the command of that name is told. */
  do<Name extends keyof Told>(name: Name, told: Told[Name]): void;
  /** Mode, colours, hidden classes, the hour (0..24), and layers that are off. */
  state(): { mode: string; colouring: string; hidden: string[]; hour: number; off: string[]; flying: boolean };
  camera(): { eye: Vec3; direction: Vec3; fov_deg: number };
  walk(): { feet: Vec3; velocity: Vec3; grounded: boolean; blocked: boolean };
  /** The doors of the place: the feature, where it is, and how far it is open (0..1). */
  doors(): { id: string; name: string; foot: Vec3; share: number }[];
  /** The room in which the walker is, of its house, and the rooms whose lamps are on. */
  room(): { storey: string; id: string; name: string } | null;
  litRooms(): string[];
  /** The selected feature and the part that it belongs to. */
  picked(): (Feature & { part: string }) | null;
  features(): (Feature & { part: string })[];
  /** What a click there would pick; CSS pixels of the canvas. */
  under(x: number, y: number): { feature: Feature; point: Vec3; distance_m: number } | null;
  /** Where a point of the world is on the canvas, CSS pixels; null behind the camera. */
  project(point: Vec3): { x: number; y: number } | null;
  /** The photo that is looked through. */
  photo(): { id: string; name: string } | null;
  /** The photos that lie on the place, and how far each has faded in (0..1). */
  photosShown(): { id: string; level: number }[];
  /** The photo whose pyramid a click there would choose; CSS pixels of the canvas. */
  photoUnder(x: number, y: number): string | null;
  /** Where the guided tour is; null before it was begun. */
  tour(): { time_s: number; playing: boolean; room: string } | null;
  /** The animals, where they are, and how far each is on its pace (0..1). */
  animals(): { id: string; place: Vec3; pace: number }[];
  /** Where one is on a walk from view to view; null where one is on none. */
  stroll(): MorphState | null;
  /** What the last frame of that walk cost, and what is held for it; null where one is on none. */
  strollCost(): StrollCost | null;
  bounds(): { min: Vec3; max: Vec3 };
  /** `loading`: files on their way; `missing`: those that did not come; `held_MB`: what is kept of tiles, drawn or not. */
  stats(): ViewerStats & { load_s: number; loading: number; missing: string[]; held_MB: number };
}

declare global {
  interface Window {
    veduta?: Inspection;
  }
}

export function inspect(session: Session, store: Store<StudioState>, commands: Commands): Inspection {
  const { viewer, place, tables } = session;
  const name = (part: number, row = 0): string => ownerOf(session, { part, row });
  return {
    do: (name, told) => commands.do(name, told),
    state: () => ({
      mode: store.value.mode,
      colouring: store.value.colouring,
      hidden: [...store.value.hidden],
      hour: store.value.hour,
      off: [...store.value.off],
      flying: viewer.isFlying,
    }),
    camera: () => viewer.pose,
    walk: () => {
      const { feet, velocity, grounded, blocked } = viewer.walker;
      return { feet, velocity, grounded, blocked };
    },
    doors: () =>
      viewer.household.doors?.states.map(({ feature, foot, share }) => {
        const row = tables[feature.part]?.rows[feature.row];
        return { id: row?.id ?? "", name: row?.name ?? "", foot, share };
      }) ?? [],
    room: () => {
      const where = viewer.household.whereabouts(viewer.walker.feet);
      const storey = where === null ? undefined : session.houses[where.house]?.storeys[where.storey];
      const room = storey?.rooms[where?.room ?? -1];
      return storey === undefined || room === undefined ? null : { storey: storey.name, id: room.id, name: roomTitle(room) };
    },
    litRooms: () =>
      session.houses.flatMap((house, index) => {
        const levels = viewer.household.levelsOf(index);
        return roomsOf(house).flatMap(({ room }, number) => ((levels[number] ?? 0) > 0.5 ? [room.id] : []));
      }),
    picked: () => {
      const { selected } = store.value;
      const feature = selected === null ? undefined : tables[selected.part]?.rows[selected.row];
      return selected === null || feature === undefined
        ? null
        : { ...feature, part: name(selected.part, selected.row) };
    },
    features: () =>
      tables.flatMap((table, part) =>
        table.rows.map((feature, row) => ({ ...feature, part: name(part, row) })),
      ),
    under: (x, y) => {
      const hit = viewer.picker.hitAt(x, y);
      const feature = hit === null ? undefined : tables[hit.feature.part]?.rows[hit.feature.row];
      return hit === null || feature === undefined
        ? null
        : { feature, point: hit.point, distance_m: hit.distance_m };
    },
    project: (point) => viewer.picker.project(point),
    photo: () => {
      const shot = place.shots[store.value.shot ?? -1];
      return shot === undefined ? null : { id: shot.id, name: shot.name };
    },
    photosShown: () =>
      viewer.shownPhotos.map(({ index, level }) => ({ id: place.shots[index]?.id ?? "", level })),
    photoUnder: (x, y) => place.shots[viewer.picker.shotAt(x, y) ?? -1]?.id ?? null,
    tour: () => {
      const { tour: at } = store.value;
      const tour = place.tours[at?.which ?? 0];
      return at === null || tour === undefined
        ? null
        : { ...at, room: stretchAt(tour, at.time_s)?.name ?? "" };
    },
    animals: () => viewer.animals.states,
    stroll: () => store.value.morph,
    strollCost: () => viewer.strollCost,
    bounds: () => viewer.solid.bounds,
    stats: () => {
      const { waiting, unseen, missing } = session.onTheWay;
      const loading = waiting + unseen + (session.town?.isLoading === true ? 1 : 0);
      const held_MB = (session.town?.heldBytes ?? 0) / 1e6;
      return { ...viewer.stats, load_s: session.loadSeconds, loading, missing: missing.map(({ file }) => file), held_MB };
    },
  };
}
