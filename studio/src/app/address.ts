/** The page's address says what one sees: it can be shared, loaded again, and gone back from. */
import { type FeatureTable, rowNamed } from "../core/features.ts";
import type { FeatureRef, StudioState } from "../core/state.ts";
import type { Store } from "../core/store.ts";
import { readView, writeView } from "../core/view-link.ts";
import type { Commands } from "./commands.ts";
import { ownerOf, type Session } from "./session.ts";

/** The address follows when the view has been still for so long. */
const STILL_MS = 400;

export class Address {
  readonly #session: Session;
  readonly #commands: Commands;
  readonly #store: Store<StudioState>;
  #timer = 0;
  #written = "";
  #isStep = false;
  /** The surface that a link chooses and that has not come yet. */
  #awaited: string | null = null;
  /** Tiles, and rows of parts, that do not hold it. */
  #looked = new WeakSet();

  constructor(session: Session, store: Store<StudioState>, commands: Commands) {
    this.#session = session;
    this.#commands = commands;
    this.#store = store;
    store.subscribe((now, before) => {
      // One goes back from another mode, another photo; not from a step of the walk.
      if (now.mode !== before.mode || now.shot !== before.shot || (now.morph === null) !== (before.morph === null)) this.#isStep = true;
      // Whoever chooses another, or closes what was chosen, waits no longer.
      if (now.selected !== before.selected) this.#awaited = null;
      this.changed();
    });
    addEventListener("popstate", () => this.show(location.hash));
    addEventListener("hashchange", () => this.show(location.hash));
  }

  /** Shows what a link says; false where it says nothing. */
  show(hash: string): boolean {
    const { place } = this.#session;
    if (hash.replace(/^#/, "") === this.#written) return true;
    const view = readView(hash, {
      photos: place.shots.length,
      tours: place.tours.length,
      walks: place.walks.map(({ transitions }) => transitions.length),
      animals: place.animals.map(({ clips }) => clips.length),
    });
    if (view === null) return false;
    this.#commands.do("view", view);
    this.#awaited = view.picked;
    this.#looked = new WeakSet();
    this.arrived();
    this.#isStep = false;
    return true;
  }

  /** Something has come: it may hold the surface that a link chooses. */
  arrived(): void {
    const found = this.#awaited === null ? null : this.#refOf(this.#awaited);
    if (found !== null) this.#commands.do("select", found);
  }

  /** Whoever clicks or closes something waits for the surface of a link no longer. */
  drop(): void {
    if (this.#awaited === null) return;
    this.#awaited = null;
    this.changed();
  }

  /** The view has changed: the address will say so when it is still. */
  changed(): void {
    clearTimeout(this.#timer);
    this.#timer = window.setTimeout(() => this.#write(), STILL_MS);
  }

  #write(): void {
    const { viewer } = this.#session;
    const { tour, morph } = this.#store.value;
    if (viewer.isFlying || tour?.playing === true || morph?.playing === true) {
      this.changed();
      return;
    }
    const text = writeView(this.#store.value, viewer.look, this.#picked);
    if (text === this.#written) return;
    const isStep = this.#isStep && this.#written !== "";
    this.#written = text;
    this.#isStep = false;
    if (isStep) history.pushState(null, "", `#${text}`);
    else history.replaceState(null, "", `#${text}`);
  }

  get #picked(): string | null {
    const { selected } = this.#store.value;
    if (selected === null) return this.#awaited;
    const id = this.#session.tables[selected.part]?.rows[selected.row]?.id;
    return id === undefined ? null : `${ownerOf(this.#session, selected)}/${id}`;
  }

  /** A link may name the id alone: then it is the first of that id. */
  #refOf(picked: string): FeatureRef | null {
    for (const [part, table] of this.#session.tables.entries()) {
      if (!this.#isNew(table)) continue;
      const row = rowNamed(table, picked, (at) => ownerOf(this.#session, { part, row: at }));
      if (row !== null) return { part, row };
    }
    return null;
  }

  /** The table of a part gets other rows when it comes; that of a tile makes its rows anew whenever one asks. */
  #isNew(table: FeatureTable): boolean {
    const known = table.ending === undefined ? table.rows : table;
    const isNew = !this.#looked.has(known);
    this.#looked.add(known);
    return isNew;
  }
}
