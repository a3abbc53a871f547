/**
 * All that can be done on the page, each by its name: keys, buttons, panels, links and tests go through
 * `do`. What is shown follows from the state that a command leaves behind.
 */
import type { AnimalState } from "../core/animal.ts";
import type { SemanticClass } from "../core/classes.ts";
import { changeBy, type HouseCommand } from "../core/house-keys.ts";
import type { Command } from "../core/input.ts";
import type { MorphState } from "../core/morph-walk.ts";
import { type Colouring, type FeatureRef, type Layer, NEXT_COLOURING, type StudioState, throughPhoto, withLayer } from "../core/state.ts";
import type { Store } from "../core/store.ts";
import { durationOf, NOT_BEGUN, type TourState } from "../core/tour.ts";
import type { Vec3 } from "../core/vector.ts";
import type { View } from "../core/view-link.ts";
import type { Choice } from "../three/choosing.ts";
import { savePicture, toggleFullscreen } from "./page-actions.ts";
import type { Session } from "./session.ts";
import { changeStroll, nextLook, playStroll, toggleStroll } from "./stroll.ts";

/** What a command is told; those of keys and buttons are told nothing. */
export interface Told extends Record<Command, undefined> {
  readonly "look-through": number | null;
  readonly "step-photo": number;
  readonly cover: number;
  readonly select: FeatureRef | null;
  readonly layer: { readonly kind: SemanticClass; readonly visible: boolean };
  readonly record: { readonly layer: Layer; readonly visible: boolean };
  readonly "point-size": number;
  readonly wipe: number;
  readonly fade: boolean;
  readonly colour: Colouring;
  readonly house: Partial<StudioState>;
  readonly go: readonly Vec3[];
  readonly stick: readonly [number, number];
  readonly "seek-tour": Partial<TourState>;
  readonly "play-tour": undefined;
  readonly animal: Partial<AnimalState>;
  readonly "play-walk": undefined;
  readonly headset: undefined;
  readonly "seek-walk": Partial<MorphState>;
  /** What a link says. */
  readonly view: Pick<View, "look" | "state">;
  readonly lead: { readonly which: number; readonly goal: Vec3 };
  readonly "ask-now": undefined;
}

/** What a command may ask of the page itself. */
export interface Page {
  say(words: string): void;
  toggleLayers(): void;
  closeLayersIfNarrow(): void;
  toggleHelp(): void;
  togglePalette(): void;
  /** The surface that a link chooses is waited for no longer. */
  dropLink(): void;
  /** The viewer learns which part of the picture the panels cover. */
  leaveFree(): void;
}

type Handlers = { readonly [Name in keyof Told]: (told: Told[Name]) => void };
type Toldless = { [Name in keyof Told]: undefined extends Told[Name] ? Name : never }[keyof Told];

export class Commands {
  readonly #session: Session;
  readonly #store: Store<StudioState>;
  readonly #page: Page;
  readonly #handlers: Handlers;
  /** The photo that was looked through or thrown last, while one stays with the photos. */
  #last: number | null = null;

  constructor(session: Session, store: Store<StudioState>, page: Page) {
    this.#session = session;
    this.#store = store;
    this.#page = page;
    this.#handlers = { ...this.#ofView(), ...this.#ofSurfaces(), ...this.#ofPhotos(), ...this.#ofHouse(), ...this.#ofMoving() };
    store.subscribe((now, before) => {
      // Whoever walks away from the photos means those that he comes to.
      if (now.mode !== before.mode) this.#last = null;
      this.#last = now.shot ?? now.projected ?? this.#last;
    });
  }

  do(name: Toldless): void;
  do<Name extends keyof Told>(name: Name, told: Told[Name]): void;
  do<Name extends keyof Told>(name: Name, told?: Told[Name]): void {
    const handler: (told: Told[Name]) => void = this.#handlers[name];
    (handler as (told?: Told[Name]) => void)(told);
  }

  /** What a click on the place means. */
  choose(choice: Choice): void {
    this.#page.dropLink();
    if (choice.kind === "photo") this.do("look-through", choice.shot);
    else if (choice.kind === "surface") this.do("select", choice.feature);
    else this.do("lead", choice);
  }

  #ofView(): Pick<Handlers, "view" | "ask-now" | "palette" | "orbit" | "walk" | "reset" | "layers" | "screenshot" | "fullscreen" | "mouse-look" | "help" | "close"> {
    const { place, viewer } = this.#session;
    const page = this.#page;
    return {
      orbit: () => this.#store.update({ mode: "orbit", shot: null, morph: null }),
      walk: () => (place.walks.length > 0 ? changeStroll(this.#store, {}) : this.#store.update({ mode: "walk", shot: null })),
      reset: () => {
        page.leaveFree();
        viewer.resetView();
      },
      layers: () => page.toggleLayers(),
      screenshot: () => void savePicture(this.#session).then((words) => page.say(words)),
      fullscreen: () => void toggleFullscreen().then((words) => page.say(words)),
      "mouse-look": () => void this.#toggleMouseLook(),
      help: () => page.toggleHelp(),
      palette: () => page.togglePalette(),
      view: (view) => this.#show(view),
      "ask-now": () => this.#session.askNow(),
      close: () => this.#close(),
    };
  }

  #ofSurfaces(): Pick<Handlers, "colouring" | "colour" | "select" | "layer" | "record" | "point-size" | "wipe"> {
    return {
      colouring: () => {
        const colouring = NEXT_COLOURING[this.#store.value.colouring];
        this.#store.update({ colouring });
        this.#page.say(`Colours: ${colouring}`);
      },
      colour: (colouring) => this.#store.update({ colouring }),
      select: (selected) => this.#store.update({ selected }),
      layer: (change) => this.#layer(change),
      record: ({ layer, visible }) => this.#store.update({ off: withLayer(this.#store.value.off, layer, visible), selected: null }),
      "point-size": (point_px) => this.#store.update({ point_px }),
      wipe: (wipe) => this.#store.update({ wipe }),
    };
  }

  #ofPhotos(): Pick<Handlers, "look-through" | "step-photo" | "next-photo" | "previous-photo" | "project" | "fading" | "fade" | "cover"> {
    return {
      "look-through": (shot) => this.#lookThrough(shot),
      "step-photo": (step) => this.#stepPhoto(step),
      "next-photo": () => this.#stepPhoto(1),
      "previous-photo": () => this.#stepPhoto(-1),
      project: () => this.#toggleProjection(),
      fading: () => this.#toggleFading(),
      fade: (fading) => this.#store.update({ fading }),
      cover: (cover) => this.#store.update({ cover }),
    };
  }

  #ofHouse(): Pick<Handlers, HouseCommand | "house"> {
    return {
      daylight: () => this.#changeHouse("daylight"),
      lights: () => this.#changeHouse("lights"),
      doors: () => this.#changeHouse("doors"),
      map: () => this.#changeHouse("map"),
      house: (change) => this.#store.update(change),
    };
  }

  #ofMoving(): Pick<Handlers, "go" | "stick" | "tour" | "play-tour" | "seek-tour" | "stroll" | "morph-look" | "play-walk" | "headset" | "seek-walk" | "animal" | "lead"> {
    const { place, viewer } = this.#session;
    return {
      go: (places) => viewer.goTo(places),
      stick: ([x, y]) => viewer.setStick(x, y),
      tour: () => (place.walks.length > 0 ? playStroll(this.#session, this.#store) : this.#toggleTour()),
      "play-tour": () => this.#toggleTour(),
      "seek-tour": (change) =>
        this.#store.update({ mode: "walk", shot: null, tour: { ...(this.#store.value.tour ?? NOT_BEGUN), ...change } }),
      stroll: () => toggleStroll(this.#session, this.#store),
      "morph-look": () => nextLook(this.#store),
      "play-walk": () => playStroll(this.#session, this.#store),
      headset: () => void this.#enterHeadset(),
      "seek-walk": (change) => changeStroll(this.#store, change),
      lead: ({ which, goal }) => {
        if (!viewer.animals.lead(which, goal)) this.#page.say("It finds no way there");
        viewer.invalidate();
      },
      animal: (change) => this.#store.update({ animal: { ...this.#store.value.animal, ...change } }),
    };
  }

  /** A link that says nothing of an animal follows none. */
  #show({ look, state }: Told["view"]): void {
    const animal = { ...this.#store.value.animal, following: false };
    this.#store.update({ animal, selected: null, ...state });
    if (look !== null && (state.shot ?? null) === null) this.#session.viewer.lookFrom(look);
  }

  async #enterHeadset(): Promise<void> {
    if (this.#store.value.morph === null) changeStroll(this.#store, {});
    const words = (await this.#session.viewer.headset?.enter()) ?? null;
    if (words !== null) this.#page.say(words);
  }

  /** First what lies over the picture, then the photo on the surfaces. */
  #close(): void {
    this.#page.dropLink();
    const { selected, shot } = this.#store.value;
    if (selected === null && shot === null) this.#store.update({ projected: null });
    else this.#store.update({ selected: null, shot: null });
  }

  #layer({ kind, visible }: Told["layer"]): void {
    const { hidden, selected } = this.#store.value;
    const row = selected === null ? undefined : this.#session.tables[selected.part]?.rows[selected.row];
    this.#store.update({
      hidden: withLayer(hidden, kind, visible),
      selected: !visible && row?.class === kind ? null : selected,
    });
  }

  #lookThrough(shot: number | null): void {
    // On a narrow page the layers lie over the photo.
    this.#page.closeLayersIfNarrow();
    this.#store.update(throughPhoto(this.#store.value, shot));
  }

  #stepPhoto(step: number): void {
    const count = this.#session.place.shots.length;
    if (count === 0) return;
    const { shot, projected } = this.#store.value;
    const now = shot ?? projected;
    this.#lookThrough(now === null ? (step > 0 ? 0 : count - 1) : (now + step + count) % count);
  }

  /** The photo that one looks or looked through, or else the one that shows most of what is seen. */
  #toggleProjection(): void {
    const { place, viewer } = this.#session;
    if (place.shots.length === 0) return;
    const { projected, shot } = this.#store.value;
    this.#store.update({ projected: projected === null ? (shot ?? this.#last ?? viewer.nearestPhoto ?? 0) : null });
  }

  #toggleFading(): void {
    if (this.#session.place.shots.length === 0) return;
    const fading = !this.#store.value.fading;
    this.#store.update({ fading });
    this.#page.say(fading ? "Photos fade in as you walk past" : "Photos do not fade in");
  }

  #changeHouse(command: HouseCommand): void {
    if (this.#session.houses.length === 0) return;
    const { change, words } = changeBy(command, this.#store.value, this.#session.sunPath);
    this.#store.update(change);
    this.#page.say(words);
  }

  /** Plays on from where it was left, from its beginning after its end. */
  #toggleTour(): void {
    const at = this.#store.value.tour ?? NOT_BEGUN;
    const tour = this.#session.place.tours[at.which];
    if (tour === undefined) return;
    const time_s = at.time_s >= durationOf(tour) ? 0 : at.time_s;
    this.#store.update({ mode: "walk", shot: null, selected: null, tour: { ...at, time_s, playing: !at.playing } });
  }

  async #toggleMouseLook(): Promise<void> {
    const { viewer } = this.#session;
    if (this.#store.value.mode !== "walk") this.#store.update({ mode: "walk" });
    if (this.#store.value.mouseLook) viewer.pointer.release();
    else if (!(await viewer.pointer.capture())) this.#page.say("The browser keeps the mouse; drag to look around");
  }
}
