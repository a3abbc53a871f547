/** The page's address says what one sees: it can be shared, loaded again, and gone back from. */
import type { FeatureRef, StudioState } from "../core/state.ts";
import type { Store } from "../core/store.ts";
import { readView, type View, writeView } from "../core/view-link.ts";
import type { Session } from "./session.ts";

/** The address follows when the view has been still for so long. */
const STILL_MS = 400;

export class Address {
  readonly #session: Session;
  readonly #store: Store<StudioState>;
  #timer = 0;
  #written = "";
  #isStep = false;

  constructor(session: Session, store: Store<StudioState>) {
    this.#session = session;
    this.#store = store;
    store.subscribe((now, before) => {
      // One goes back from another mode, another photo; not from a step of the walk.
      if (now.mode !== before.mode || now.shot !== before.shot || (now.morph === null) !== (before.morph === null)) this.#isStep = true;
      this.changed();
    });
    addEventListener("popstate", () => this.show(location.hash));
    addEventListener("hashchange", () => this.show(location.hash));
  }

  /** Shows what a link says; false where it says nothing. */
  show(hash: string): boolean {
    const { place, viewer } = this.#session;
    if (hash.replace(/^#/, "") === this.#written) return true;
    const view = readView(hash, {
      photos: place.shots.length,
      tours: place.tours.length,
      walks: place.walks.map(({ transitions }) => transitions.length),
      animals: place.animals.map(({ clips }) => clips.length),
    });
    if (view === null) return false;
    // A link that says nothing of an animal follows none.
    const animal = { ...this.#store.value.animal, following: false };
    this.#store.update({ animal, ...view.state, selected: this.#rowOf(view) });
    if (view.look !== null && view.state.shot === null) viewer.lookFrom(view.look);
    this.#isStep = false;
    return true;
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
    return selected === null ? null : (this.#session.tables[selected.part]?.rows[selected.row]?.id ?? null);
  }

  #rowOf({ picked }: View): FeatureRef | null {
    if (picked === null) return null;
    for (const [part, { rows }] of this.#session.tables.entries()) {
      const row = rows.findIndex(({ id }) => id === picked);
      if (row >= 0) return { part, row };
    }
    return null;
  }
}
