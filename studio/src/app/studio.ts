/** The page: the canvas and the panels over it. */
import { html, LitElement, nothing, type TemplateResult } from "lit";
import { keyed } from "lit/directives/keyed.js";
import { faultOf, Fault } from "../core/fault.ts";
import { type Command, commandOf, holdOf, letGo } from "../core/input.ts";
import { type Entry, entriesOf } from "../core/palette.ts";
import { INITIAL_STATE, type StudioState } from "../core/state.ts";
import { Store } from "../core/store.ts";
import { daylightAt } from "../core/daylight.ts";
import { Address } from "./address.ts";
import { Commands, type Told } from "./commands.ts";
import { fillHead } from "./head.ts";
import "./animal-panel.ts";
import "./feature-panel.ts";
import { insetsOf, isNarrow } from "./free-space.ts";
import type { HelpDialog } from "./help-dialog.ts";
import "./help-dialog.ts";
import { inspect } from "./inspect.ts";
import "./house-panel.ts";
import "./joystick.ts";
import { keepOffline } from "./keep-offline.ts";
import "./layers-panel.ts";
import type { Counted } from "./layers-panel.ts";
import "./loading-screen.ts";
import "./message-card.ts";
import "./missing-panel.ts";
import "./minimap.ts";
import type { Minimap } from "./minimap.ts";
import type { PaletteDialog } from "./palette-dialog.ts";
import "./palette-dialog.ts";
import "./photo-list.ts";
import "./photo-panel.ts";
import "./records-panel.ts";
import "./wipe-line.ts";
import "./plain-walk.ts";
import { type PlainWalk, plainWalkOf } from "./plain-walk.ts";
import { NoWebGL, openPlace, type Session } from "./session.ts";
import { shownFeature } from "./shown-feature.ts";
import { strollPanel, wheelOn } from "./stroll.ts";
import { studioStyles } from "./studio-styles.ts";
import { theme } from "./theme.ts";
import "./toolbar.ts";
import "./tour-panel.ts";
import { isTyping } from "./typing.ts";
import { hintOf, titleOf } from "./words.ts";

const UNCOUNTED: Counted = { classes: new Map(), provenances: new Map() };
const LOST = "The browser took the graphics card away from this page; the picture comes back with it";

export class Studio extends LitElement {
  static override properties = {
    fault: { state: true },
    session: { state: true },
    progress: { state: true },
    layersOpen: { state: true },
    notice: { state: true },
    plain: { state: true },
  };
  declare fault: Fault | null;
  declare session: Session | null;
  declare progress: { share: number; file: string };
  declare layersOpen: boolean;
  declare notice: string;
  declare plain: PlainWalk | null;
  readonly #store = new Store<StudioState>(INITIAL_STATE);
  #noticeTimer = 0;
  #commands: Commands | null = null;
  #address: Address | null = null;

  static override styles = [theme, studioStyles];

  constructor() {
    super();
    this.fault = null;
    this.session = null;
    this.progress = { share: 0, file: "" };
    this.layersOpen = matchMedia("(min-width: 900px)").matches;
    this.notice = "";
    this.plain = null;
    this.#store.subscribe((now, before) => {
      this.requestUpdate();
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
        () => {
          this.requestUpdate();
          this.#address?.arrived();
        },
      );
      const commands = this.#commandsOf(session);
      this.#commands = commands;
      this.session = session;
      const address = new Address(session, this.#store, commands);
      this.#address = address;
      session.viewer.onChoice = (choice) => commands.choose(choice);
      session.viewer.onDrawn = () => {
        address.changed();
        if (session.houses.length > 0) this.#drawMap(session);
      };
      fillHead(session);
      window.veduta = inspect(session, this.#store, commands);
      await this.updateComplete;
      this.#leaveFree(session);
      session.viewer.goHome();
      address.show(location.hash);
      document.documentElement.dataset.veduta = "ready";
      void keepOffline(new URL(location.href));
    } catch (error) {
      // Without WebGL 2 a walk still has its pictures.
      this.plain = error instanceof NoWebGL ? await plainWalkOf(new URL(location.href)) : null;
      if (this.plain === null) this.#fail(error);
      else document.documentElement.dataset.veduta = "ready";
    }
  }

  #commandsOf(session: Session): Commands {
    return new Commands(session, this.#store, {
      say: (words) => this.#say(words),
      toggleLayers: () => (this.layersOpen = !this.layersOpen),
      closeLayersIfNarrow: () => {
        if (isNarrow()) this.layersOpen = false;
      },
      toggleHelp: () => {
        session.viewer.releaseKeys();
        this.#help?.toggle();
      },
      togglePalette: () => {
        session.viewer.releaseKeys();
        this.#palette?.toggle();
      },
      dropLink: () => this.#address?.drop(),
      leaveFree: () => this.#leaveFree(session),
    });
  }

  /** What a panel's event asks for, as the command of that name. */
  #asks<Name extends keyof Told>(name: Name): (event: CustomEvent<Told[Name]>) => void {
    return (event) => this.#commands?.do(name, event.detail);
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
    return html`<main>
      <canvas aria-label="The place in 3D" tabindex="0" ?inert=${this.fault !== null}
        @wheel=${(event: WheelEvent) => wheelOn(event, this.session, this.#store.value.morph, this.#commands)}></canvas>
      ${this.session !== null && this.fault === null ? this.#panels(this.session) : nothing}
      ${this.plain === null ? nothing : html`<veduta-plain-walk .plain=${this.plain}></veduta-plain-walk>`}
      ${this.session === null && this.fault === null && this.plain === null
        ? html`<veduta-loading .share=${this.progress.share} .file=${this.progress.file}></veduta-loading>`
        : nothing}
      ${this.fault === null ? nothing : html`<veduta-message .fault=${this.fault}></veduta-message>`}
    </main>${this.session === null || this.fault !== null ? nothing : this.#brand(this.session)}`;
  }

  #brand(session: Session): TemplateResult {
    return html`<header class="brand sheet">
      <img src="./icon.svg" alt="" width="26" height="26" />
      <div><strong>Veduta</strong><span title=${titleOf(session)}>${titleOf(session)}</span></div>
    </header>`;
  }

  #panels(session: Session): TemplateResult {
    const state = this.#store.value;
    const shown = shownFeature(session, state.selected);
    const coarse = matchMedia("(pointer: coarse)").matches;
    const overTour = session.place.tours.length + session.place.animals.length + session.place.walks.length > 0 ? "over-tour" : "";
    return html`
      <veduta-toolbar class="sheet" role="toolbar" aria-label="Tools" .mode=${state.morph === null ? state.mode : "walk"}
        .isDay=${session.houses.length === 0 ? null : daylightAt(state.hour, session.sunPath).day > 0.5}
        .layersOpen=${this.layersOpen} .mouseLook=${state.mouseLook} .coarse=${coarse}
        @command=${(event: CustomEvent<Command>) => this.#commands?.do(event.detail)}></veduta-toolbar>
      <div class="left" ?hidden=${!this.layersOpen}>${this.#layers(session)}</div>
      <veduta-feature-panel class="sheet" role="region" aria-label="The selected surface" ?hidden=${shown === null}
        .shown=${shown} @close-panel=${() => this.#commands?.do("select", null)}
        @select-row=${({ detail: row }: CustomEvent<number>) =>
          state.selected === null ? undefined : this.#commands?.do("select", { part: state.selected.part, row })}></veduta-feature-panel>
      <veduta-missing class="sheet" .waiting=${session.onTheWay.waiting} .missing=${session.onTheWay.missing}
        @ask-now=${() => this.#commands?.do("ask-now")}></veduta-missing>
      ${this.#photoPanel(session)}
      ${session.houses.length === 0
        ? nothing
        : html`<veduta-minimap class="sheet ${overTour}" role="region" aria-label="Map" ?hidden=${state.mode !== "walk" || !state.map}
            .houses=${session.houses} @go=${this.#asks("go")}></veduta-minimap>`}
      ${this.#tourPanel(session)}
      ${this.#animalPanel(session)}${strollPanel(session, state.morph, this.#commands)}
      ${(state.mode === "walk" || state.morph !== null) && coarse
        ? html`<veduta-joystick class=${overTour}
            @stick=${this.#asks("stick")}
          ></veduta-joystick>`
        : nothing}
      ${state.mouseLook ? html`<div class="crosshair"></div>` : nothing}
      ${session.records.includes("raw") && !state.off.has("raw") ? html`<veduta-wipe-line .share=${state.wipe}></veduta-wipe-line>` : nothing}
      ${(shown !== null || state.shot !== null) && this.notice === "" ? nothing : keyed(
        `${this.notice}${state.mode}${String(state.mouseLook)}`,
        html`<p class="hint ${overTour}" role="status">${this.notice === "" ? hintOf(state, coarse, session.place.shots.length > 0) : this.notice}</p>`,
      )}
      <veduta-help></veduta-help>
      <veduta-palette .entries=${commandsFor(session)} @command=${(event: CustomEvent<Entry["name"]>) => this.#commands?.do(event.detail)}></veduta-palette>
    `;
  }

  /** Classes, records and photos: those that the place has. */
  #layers(session: Session): TemplateResult {
    const { hidden, colouring, off, point_px, fading, wipe, shot, projected } = this.#store.value;
    const { shots } = session.place;
    const { records } = session;
    return html`
      <div class="sheet" ?hidden=${session.tables.length + records.length === 0}>
        <veduta-house ?hidden=${session.houses.length === 0} .state=${this.#store.value}
          .hasDoors=${session.viewer.household.doors !== null} .hasLamps=${session.hasLamps}
          .sunWords=${session.sunPath.words} .hasBackdrop=${session.place.parts.some(({ isBackdrop }) => isBackdrop)}
          @change-state=${this.#asks("house")}></veduta-house>
        <veduta-records ?hidden=${records.length === 0} .layers=${records} .off=${off} .point_px=${point_px} .fading=${fading} .wipe=${wipe}
          @record=${this.#asks("record")}
          @point-size=${this.#asks("point-size")}
          @fading=${this.#asks("fade")}
          @wipe=${this.#asks("wipe")}></veduta-records>
        <veduta-layers ?hidden=${session.tables.length === 0} .tables=${session.tables} .counted=${this.#counted(session)}
          .hidden_=${hidden} .colouring=${colouring}
          @colouring=${this.#asks("colour")}
          @layer=${this.#asks("layer")}></veduta-layers>
      </div>
      ${shots.length === 0 ? nothing : html`<veduta-photo-list class="sheet" .shots=${shots} .bitmap=${session.bitmap}
          .current=${shot ?? projected} @choose-photo=${this.#asks("look-through")}></veduta-photo-list>`}`;
  }

  #photoPanel(session: Session): TemplateResult {
    const { shot, projected, cover } = this.#store.value;
    const { shots } = session.place;
    const now = shot ?? projected;
    return html`<veduta-photo-panel class="sheet" role="region" aria-label="The photo" ?hidden=${now === null}
      .shot=${now === null ? null : (shots[now] ?? null)} .count=${shots.length} .number=${(now ?? 0) + 1}
      .through=${shot !== null} .projected=${projected !== null} .cover=${cover}
      @close-photo=${() => this.#commands?.do("close")} @project-photo=${() => this.#commands?.do("project")}
      @look-through=${() => this.#commands?.do("look-through", now)}
      @cover=${this.#asks("cover")}
      @step-photo=${this.#asks("step-photo")}></veduta-photo-panel>`;
  }

  #tourPanel({ place }: Session): TemplateResult | typeof nothing {
    if (place.tours.length === 0) return nothing;
    const { tour: at } = this.#store.value;
    return html`<veduta-tour-panel class="sheet" role="group" aria-label="The guided tour" .tours=${place.tours} .at=${at}
      @choose-tour=${(event: CustomEvent<number>) => this.#commands?.do("seek-tour", { which: event.detail, time_s: 0 })}
      @play-tour=${() => this.#commands?.do("play-tour")}
      @seek-tour=${(event: CustomEvent<number>) => this.#commands?.do("seek-tour", { time_s: event.detail })}></veduta-tour-panel>`;
  }

  #animalPanel({ place }: Session): TemplateResult | typeof nothing {
    if (place.animals.length === 0) return nothing;
    const { animal } = this.#store.value;
    return html`<veduta-animal-panel class="sheet ${place.tours.length > 0 ? "over-tour" : ""}" role="group" aria-label="The animals"
      .animals=${place.animals} .at=${animal}
      @change-animal=${this.#asks("animal")}></veduta-animal-panel>`;
  }

  /** What of a streamed place is drawn now, as the panel counts it; nothing while nobody sees the panel. */
  #counted({ town }: Session): Counted | null {
    if (town === null) return null;
    if (!this.layersOpen) return UNCOUNTED;
    return { classes: town.counts(), provenances: town.provenances() };
  }

  #onKey(event: KeyboardEvent, down: boolean): void {
    const { session } = this;
    if (session === null || this.fault !== null) return;
    const free = down ? null : letGo(event.code);
    if (free !== null) session.viewer.hold(free, false);
    if (!down || this.#help?.isOpen === true || this.#palette?.isOpen === true) return;
    const hold = holdOf(event);
    if (hold !== null) {
      if (isTyping(event)) return;
      session.viewer.hold(hold, true);
      if (event.code.startsWith("Arrow")) event.preventDefault();
      return;
    }
    const command = !event.repeat && !isTyping(event) ? commandOf(event) : null;
    if (command === null) return;
    event.preventDefault();
    this.#commands?.do(command);
  }

  get #help(): HelpDialog | null {
    return this.renderRoot.querySelector<HelpDialog>("veduta-help");
  }

  get #palette(): PaletteDialog | null {
    return this.renderRoot.querySelector<PaletteDialog>("veduta-palette");
  }

  /** The map shows the same moment as the picture. */
  #drawMap({ viewer }: Session): void {
    const { feet, heading } = viewer.walker;
    const where = viewer.household.whereabouts(feet);
    const levels = where === null ? [] : viewer.household.levelsOf(where.house);
    this.renderRoot.querySelector<Minimap>("veduta-minimap")?.show({ feet, yaw: heading.yaw, where, levels });
  }

  #say(words: string): void {
    this.notice = words;
    clearTimeout(this.#noticeTimer);
    this.#noticeTimer = window.setTimeout(() => (this.notice = ""), 2500);
  }
}

/** The commands that this place has something for. */
function commandsFor({ place, houses, onTheWay }: Session): Entry[] {
  const { shots, tours, walks } = place;
  return entriesOf({
    houses: houses.length > 0,
    photos: shots.length > 0,
    tours: tours.length > 0,
    walks: walks.length > 0,
    missing: onTheWay.missing.length > 0,
  });
}

customElements.define("veduta-studio", Studio);
