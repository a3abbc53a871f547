/** The page: the canvas and the panels over it. */
import { html, LitElement, nothing, type TemplateResult } from "lit";
import { keyed } from "lit/directives/keyed.js";
import { faultOf, Fault } from "../core/fault.ts";
import { type Command, commandOf, holdOf } from "../core/input.ts";
import type { SemanticClass } from "../core/classes.ts";
import { type Colouring, INITIAL_STATE, type Layer, NEXT_COLOURING, type StudioState, throughPhoto, withLayer } from "../core/state.ts";
import { Store } from "../core/store.ts";
import { changeBy, type HouseCommand } from "../core/house-keys.ts";
import { daylightAt } from "../core/daylight.ts";
import type { Vec3 } from "../core/vector.ts";
import { durationOf, NOT_BEGUN, type TourState } from "../core/tour.ts";
import { Address } from "./address.ts";
import { fillHead } from "./head.ts";
import type { AnimalState } from "../core/animal.ts";
import "./animal-panel.ts";
import "./feature-panel.ts";
import { insetsOf, isNarrow } from "./free-space.ts";
import type { HelpDialog } from "./help-dialog.ts";
import "./help-dialog.ts";
import { inspect } from "./inspect.ts";
import "./house-panel.ts";
import "./joystick.ts";
import "./layers-panel.ts";
import type { Counted } from "./layers-panel.ts";
import "./loading-screen.ts";
import "./message-card.ts";
import "./missing-panel.ts";
import "./minimap.ts";
import type { Minimap } from "./minimap.ts";
import { savePicture, toggleFullscreen } from "./page-actions.ts";
import "./photo-list.ts";
import "./photo-panel.ts";
import "./records-panel.ts";
import { openPlace, type Session } from "./session.ts";
import { shownFeature } from "./shown-feature.ts";
import { changeStroll, nextLook, playStroll, strollPanel, toggleStroll, wheelOn } from "./stroll.ts";
import { studioStyles } from "./studio-styles.ts";
import { theme } from "./theme.ts";
import "./toolbar.ts";
import "./tour-panel.ts";
import { isTyping } from "./typing.ts";
import { hintOf, titleOf } from "./words.ts";

const LOST = "The browser took the graphics card away from this page; the picture comes back with it";

export class Studio extends LitElement {
  static override properties = {
    fault: { state: true },
    session: { state: true },
    progress: { state: true },
    layersOpen: { state: true },
    notice: { state: true },
  };
  declare fault: Fault | null;
  declare session: Session | null;
  declare progress: { share: number; file: string };
  declare layersOpen: boolean;
  declare notice: string;
  readonly #store = new Store<StudioState>(INITIAL_STATE);
  #noticeTimer = 0;
  #last: number | null = null;

  static override styles = [theme, studioStyles];

  constructor() {
    super();
    this.fault = null;
    this.session = null;
    this.progress = { share: 0, file: "" };
    this.layersOpen = matchMedia("(min-width: 900px)").matches;
    this.notice = "";
    this.#store.subscribe((now, before) => {
      this.requestUpdate();
      // Whoever walks away from the photos means those that he comes to.
      if (now.mode !== before.mode) this.#last = null;
      this.#last = now.shot ?? now.projected ?? this.#last;
      const opened = now.selected !== null && before.selected === null;
      const closed = now.selected === null && before.selected !== null;
      if (opened || closed) void this.#makeRoom();
    });
  }

  override firstUpdated(): void {
    addEventListener("keydown", (event) => this.#onKey(event, true));
    addEventListener("keyup", (event) => this.#onKey(event, false));
    addEventListener("blur", () => this.session?.viewer.releaseKeys());
    this.#canvas.addEventListener("webglcontextlost", (event) => {
      event.preventDefault(); // else it is not given back
      this.notice = LOST;
    });
    this.#canvas.addEventListener("webglcontextrestored", () => {
      this.session?.viewer.restore();
      this.#say("The picture is back");
    });
    void this.#open();
  }

  get #canvas(): HTMLCanvasElement {
    const canvas = this.renderRoot.querySelector("canvas");
    if (canvas === null) throw new Fault("Veduta studio", "its canvas is gone", "Reload the page.");
    return canvas;
  }

  async #open(): Promise<void> {
    try {
      const session = await openPlace(
        new URL(location.href),
        this.#canvas,
        this.#store,
        (share, file) => {
          this.progress = { share, file };
        },
        () => this.requestUpdate(),
        (fault) => this.#say(fault.message),
      );
      this.session = session;
      const address = new Address(session, this.#store);
      session.viewer.onDrawn = () => {
        address.changed();
        if (session.houses.length > 0) this.#drawMap(session);
      };
      fillHead(session);
      window.veduta = inspect(session, this.#store);
      await this.updateComplete;
      this.#leaveFree(session);
      session.viewer.goHome();
      address.show(location.hash);
      document.documentElement.dataset.veduta = "ready";
    } catch (error) {
      this.#fail(error);
    }
  }

  /** On a narrow page the panel covers the place's lower half: move the place up, and back. */
  async #makeRoom(): Promise<void> {
    if (this.session === null || !isNarrow()) return;
    await this.updateComplete;
    this.#leaveFree(this.session);
    this.session.viewer.recentre();
  }

  /** Tells the viewer which part of the picture the panels cover. */
  #leaveFree(session: Session): void {
    session.viewer.setInsets(insetsOf(this.renderRoot, this.#canvas));
  }

  #fail(error: unknown): void {
    this.fault = faultOf(error);
    console.error(error);
    document.documentElement.dataset.veduta = "error";
  }

  override render(): TemplateResult {
    return html`
      <canvas aria-label="The place in 3D" tabindex="0" ?inert=${this.fault !== null}
        @wheel=${(event: WheelEvent) => wheelOn(event, this.session, this.#store)}></canvas>
      ${this.session !== null && this.fault === null ? this.#panels(this.session) : nothing}
      ${this.session === null && this.fault === null
        ? html`<veduta-loading .share=${this.progress.share} .file=${this.progress.file}></veduta-loading>`
        : nothing}
      ${this.fault === null ? nothing : html`<veduta-message .fault=${this.fault}></veduta-message>`}
    `;
  }

  #panels(session: Session): TemplateResult {
    const state = this.#store.value;
    const shown = shownFeature(session, state.selected);
    const coarse = matchMedia("(pointer: coarse)").matches;
    const overTour = session.place.tours.length + session.place.animals.length + session.place.walks.length > 0 ? "over-tour" : "";
    return html`
      <header class="brand sheet">
        <img src="./icon.svg" alt="" width="26" height="26" />
        <div><strong>Veduta</strong><span title=${titleOf(session)}>${titleOf(session)}</span></div>
      </header>
      <veduta-toolbar class="sheet" role="toolbar" aria-label="Tools" .mode=${state.morph === null ? state.mode : "walk"}
        .isDay=${session.houses.length === 0 ? null : daylightAt(state.hour, session.sunPath).day > 0.5}
        .layersOpen=${this.layersOpen} .mouseLook=${state.mouseLook} .coarse=${coarse}
        @command=${(event: CustomEvent<Command>) => this.#do(event.detail)}></veduta-toolbar>
      <div class="left" ?hidden=${!this.layersOpen}>${this.#layers(session)}</div>
      <veduta-feature-panel class="sheet" role="region" aria-label="The selected surface" ?hidden=${shown === null}
        .shown=${shown} @close-panel=${() => this.#store.update({ selected: null })}
        @select-row=${(event: CustomEvent<number>) => this.#selectRow(event.detail)}></veduta-feature-panel>
      <veduta-missing class="sheet" .waiting=${session.onTheWay.waiting} .missing=${session.onTheWay.missing}
        @ask-now=${() => session.askNow()}></veduta-missing>
      ${this.#photoPanel(session)}
      ${session.houses.length === 0
        ? nothing
        : html`<veduta-minimap class="sheet ${overTour}" role="region" aria-label="Map" ?hidden=${state.mode !== "walk" || !state.map}
            .houses=${session.houses} @go=${(event: CustomEvent<Vec3[]>) => session.viewer.goTo(event.detail)}></veduta-minimap>`}
      ${this.#tourPanel(session)}
      ${this.#animalPanel(session)}${strollPanel(session, this.#store)}
      ${(state.mode === "walk" || state.morph !== null) && coarse
        ? html`<veduta-joystick class=${overTour}
            @stick=${(event: CustomEvent<readonly [number, number]>) => session.viewer.setStick(...event.detail)}
          ></veduta-joystick>`
        : nothing}
      ${state.mouseLook ? html`<div class="crosshair"></div>` : nothing}
      ${(shown !== null || state.shot !== null) && this.notice === "" ? nothing : keyed(
        `${this.notice}${state.mode}${String(state.mouseLook)}`,
        html`<p class="hint ${overTour}" role="status">${this.notice === "" ? hintOf(state, coarse, session.place.shots.length > 0) : this.notice}</p>`,
      )}
      <veduta-help></veduta-help>
    `;
  }

  /** Classes, records and photos: those that the place has. */
  #layers(session: Session): TemplateResult {
    const { hidden, colouring, off, point_px, fading, shot, projected } = this.#store.value;
    const { shots } = session.place;
    const { records } = session;
    return html`
      <div class="sheet" ?hidden=${session.tables.length + records.length === 0}>
        <veduta-house ?hidden=${session.houses.length === 0} .state=${this.#store.value}
          .hasDoors=${session.viewer.household.doors !== null} .hasLamps=${session.hasLamps}
          .sunWords=${session.sunPath.words} .hasBackdrop=${session.place.parts.some(({ isBackdrop }) => isBackdrop)}
          @change-state=${(event: CustomEvent<Partial<StudioState>>) => this.#store.update(event.detail)}></veduta-house>
        <veduta-records ?hidden=${records.length === 0} .layers=${records} .off=${off} .point_px=${point_px} .fading=${fading}
          @record=${(event: CustomEvent<{ layer: Layer; visible: boolean }>) => this.#record(event.detail)}
          @point-size=${(event: CustomEvent<number>) => this.#store.update({ point_px: event.detail })}
          @fading=${(event: CustomEvent<boolean>) => this.#store.update({ fading: event.detail })}></veduta-records>
        <veduta-layers ?hidden=${session.tables.length === 0} .tables=${session.tables} .counted=${this.#counted(session)}
          .hidden_=${hidden} .colouring=${colouring}
          @colouring=${(event: CustomEvent<Colouring>) => this.#store.update({ colouring: event.detail })}
          @layer=${(event: CustomEvent<{ kind: SemanticClass; visible: boolean }>) => this.#layer(event.detail)}></veduta-layers>
      </div>
      ${shots.length === 0 ? nothing : html`<veduta-photo-list class="sheet" .shots=${shots} .bitmap=${session.bitmap}
          .current=${shot ?? projected} @choose-photo=${(event: CustomEvent<number>) => this.#lookThrough(event.detail)}></veduta-photo-list>`}`;
  }

  #photoPanel(session: Session): TemplateResult {
    const { shot, projected, cover } = this.#store.value;
    const { shots } = session.place;
    const now = shot ?? projected;
    return html`<veduta-photo-panel class="sheet" role="region" aria-label="The photo" ?hidden=${now === null}
      .shot=${now === null ? null : (shots[now] ?? null)} .count=${shots.length} .number=${(now ?? 0) + 1}
      .through=${shot !== null} .projected=${projected !== null} .cover=${cover}
      @close-photo=${() => this.#close()} @project-photo=${() => this.#toggleProjection(session)}
      @look-through=${() => this.#lookThrough(now)}
      @cover=${(event: CustomEvent<number>) => this.#store.update({ cover: event.detail })}
      @step-photo=${(event: CustomEvent<number>) => this.#stepPhoto(event.detail)}></veduta-photo-panel>`;
  }

  #tourPanel({ place }: Session): TemplateResult | typeof nothing {
    if (place.tours.length === 0) return nothing;
    const { tour: at } = this.#store.value;
    return html`<veduta-tour-panel class="sheet" role="group" aria-label="The guided tour" .tours=${place.tours} .at=${at}
      @choose-tour=${(event: CustomEvent<number>) => this.#goInTour({ which: event.detail, time_s: 0 })}
      @play-tour=${() => this.#toggleTour()}
      @seek-tour=${(event: CustomEvent<number>) => this.#goInTour({ time_s: event.detail })}></veduta-tour-panel>`;
  }

  #animalPanel({ place }: Session): TemplateResult | typeof nothing {
    if (place.animals.length === 0) return nothing;
    const { animal } = this.#store.value;
    return html`<veduta-animal-panel class="sheet ${place.tours.length > 0 ? "over-tour" : ""}" role="group" aria-label="The animals"
      .animals=${place.animals} .at=${animal}
      @change-animal=${(event: CustomEvent<Partial<AnimalState>>) => this.#store.update({ animal: { ...animal, ...event.detail } })}
    ></veduta-animal-panel>`;
  }

  /** Plays on from where it was left, from its beginning after its end. */
  #toggleTour(): void {
    const at = this.#store.value.tour ?? NOT_BEGUN;
    const tour = this.session?.place.tours[at.which];
    if (tour === undefined) return;
    const time_s = at.time_s >= durationOf(tour) ? 0 : at.time_s;
    this.#store.update({ mode: "walk", shot: null, selected: null, tour: { ...at, time_s, playing: !at.playing } });
  }

  #goInTour(change: Partial<TourState>): void {
    this.#store.update({ mode: "walk", shot: null, tour: { ...(this.#store.value.tour ?? NOT_BEGUN), ...change } });
  }

  /** What of a streamed place is drawn now, as the panel counts it. */
  #counted({ town }: Session): Counted | null {
    if (town === null || !this.layersOpen) return null;
    return { classes: town.counts(), provenances: town.provenances() };
  }

  #layer(change: { kind: SemanticClass; visible: boolean }): void {
    const { hidden, selected } = this.#store.value;
    const row = selected === null ? undefined : this.session?.tables[selected.part]?.rows[selected.row];
    this.#store.update({
      hidden: withLayer(hidden, change.kind, change.visible),
      selected: !change.visible && row?.class === change.kind ? null : selected,
    });
  }

  #record({ layer, visible }: { layer: Layer; visible: boolean }): void {
    this.#store.update({ off: withLayer(this.#store.value.off, layer, visible), selected: null });
  }

  #lookThrough(shot: number | null): void {
    // On a narrow page the layers lie over the photo.
    if (isNarrow()) this.layersOpen = false;
    this.#store.update(throughPhoto(this.#store.value, shot));
  }

  #selectRow(row: number): void {
    const { selected } = this.#store.value;
    if (selected !== null) this.#store.update({ selected: { part: selected.part, row } });
  }

  #onKey(event: KeyboardEvent, down: boolean): void {
    const { session } = this;
    if (session === null || this.fault !== null) return;
    if (this.#help?.isOpen === true) return;
    const hold = holdOf(event);
    if (hold !== null) {
      if (down && isTyping(event)) return;
      session.viewer.hold(hold, down);
      if (down && event.code.startsWith("Arrow")) event.preventDefault();
      return;
    }
    const command = down && !event.repeat && !isTyping(event) ? commandOf(event) : null;
    if (command === null) return;
    event.preventDefault();
    this.#do(command);
  }

  get #help(): HelpDialog | null {
    return this.renderRoot.querySelector<HelpDialog>("veduta-help");
  }

  #do(command: Command): void {
    const { session } = this;
    if (session === null) return;
    const { viewer } = session;
    const actions: Record<Command, () => void> = {
      orbit: () => this.#store.update({ mode: "orbit", shot: null, morph: null }),
      walk: () => (session.place.walks.length > 0 ? changeStroll(this.#store, {}) : this.#store.update({ mode: "walk", shot: null })),
      reset: () => {
        this.#leaveFree(session);
        viewer.resetView();
      },
      layers: () => (this.layersOpen = !this.layersOpen),
      colouring: () => this.#nextColouring(),
      screenshot: () => void savePicture(session).then((words) => this.#say(words)),
      fullscreen: () => void toggleFullscreen().then((words) => this.#say(words)),
      "mouse-look": () => void this.#toggleMouseLook(session),
      help: () => this.#help?.toggle(),
      "next-photo": () => this.#stepPhoto(1),
      "previous-photo": () => this.#stepPhoto(-1),
      project: () => this.#toggleProjection(session),
      fading: () => this.#toggleFading(session),
      daylight: () => this.#changeHouse("daylight"),
      lights: () => this.#changeHouse("lights"),
      doors: () => this.#changeHouse("doors"),
      map: () => this.#changeHouse("map"),
      tour: () => (session.place.walks.length > 0 ? playStroll(session, this.#store) : this.#toggleTour()),
      stroll: () => toggleStroll(session, this.#store),
      "morph-look": () => nextLook(this.#store),
      close: () => this.#close(),
    };
    actions[command]();
  }

  /** First what lies over the picture, then the photo on the surfaces. */
  #close(): void {
    const { selected, shot } = this.#store.value;
    if (selected === null && shot === null) this.#store.update({ projected: null });
    else this.#store.update({ selected: null, shot: null });
  }

  /** The photo that one looks or looked through, or else the one that shows most of what is seen. */
  #toggleProjection({ viewer, place }: Session): void {
    if (place.shots.length === 0) return;
    const { projected, shot } = this.#store.value;
    this.#store.update({ projected: projected === null ? (shot ?? this.#last ?? viewer.nearestPhoto ?? 0) : null });
  }

  #toggleFading({ place }: Session): void {
    if (place.shots.length === 0) return;
    const fading = !this.#store.value.fading;
    this.#store.update({ fading });
    this.#say(fading ? "Photos fade in as you walk past" : "Photos do not fade in");
  }

  #stepPhoto(step: number): void {
    const count = this.session?.place.shots.length ?? 0;
    if (count === 0) return;
    const { shot, projected } = this.#store.value;
    const now = shot ?? projected;
    const next = now === null ? (step > 0 ? 0 : count - 1) : (now + step + count) % count;
    this.#lookThrough(next);
  }

  #changeHouse(command: HouseCommand): void {
    if (this.session === null || this.session.houses.length === 0) return;
    const { change, words } = changeBy(command, this.#store.value, this.session.sunPath);
    this.#store.update(change);
    this.#say(words);
  }

  /** The map shows the same moment as the picture. */
  #drawMap({ viewer }: Session): void {
    const { feet, heading } = viewer.walker;
    const where = viewer.household.whereabouts(feet);
    const levels = where === null ? [] : viewer.household.levelsOf(where.house);
    this.renderRoot.querySelector<Minimap>("veduta-minimap")?.show({ feet, yaw: heading.yaw, where, levels });
  }

  #nextColouring(): void {
    const colouring = NEXT_COLOURING[this.#store.value.colouring];
    this.#store.update({ colouring });
    this.#say(`Colours: ${colouring}`);
  }

  async #toggleMouseLook(session: Session): Promise<void> {
    if (this.#store.value.mode !== "walk") this.#store.update({ mode: "walk" });
    if (this.#store.value.mouseLook) session.viewer.releaseMouse();
    else if (!(await session.viewer.captureMouse())) {
      this.#say("The browser keeps the mouse; drag to look around");
    }
  }

  #say(words: string): void {
    this.notice = words;
    clearTimeout(this.#noticeTimer);
    this.#noticeTimer = window.setTimeout(() => (this.notice = ""), 2500);
  }
}

customElements.define("veduta-studio", Studio);
