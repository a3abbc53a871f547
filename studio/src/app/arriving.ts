/** What of a place is on its way to the page, and what has come of it. */
import type { Object3D } from "three";
import type { Missing } from "../core/asking.ts";
import type { Budget } from "../core/budget.ts";
import type { FeatureTable } from "../core/features.ts";
import { fileAddress, type Part, type Place } from "../core/place.ts";
import type { Sight } from "../core/sight.ts";
import { Wishes } from "../core/wishes.ts";
import { Arrivals } from "../three/arrivals.ts";
import type { CloudArrivals } from "../three/clouds.ts";
import { fetchBytes } from "../three/fetch.ts";
import type { Grower } from "../three/grower.ts";
import type { LoadedHouse } from "../three/household.ts";
import type { PartSlot } from "../three/part-slot.ts";
import type { Recorded } from "../three/recorded.ts";
import type { SharedImages } from "../three/shared-images.ts";
import type { Town } from "../three/town.ts";
import type { Viewer } from "../three/viewer.ts";
import { FEW_PARTS, type HeadStart } from "./head-start.ts";

/** What draws; it comes as a piece of its own. */
export type Drawing = typeof import("./drawing.ts");

/** A place whose index has come, and what was asked for since. */
export interface Asked {
  readonly place: Place;
  readonly address: URL;
  readonly drawing: Drawing;
  readonly headStart: HeadStart;
}

export type OnProgress = (share: number, file: string) => void;

export class Arriving {
  /** Null until it can be made. */
  viewer: Viewer | null = null;
  readonly town: Town | null;
  readonly parts: readonly PartSlot[];
  readonly houses: LoadedHouse[] = [];
  /** What is asked for as one looks about: pictures, models of a walk, documents. */
  readonly wishes: Wishes;
  readonly clouds: CloudArrivals;
  readonly recorded: Recorded;
  readonly #asked: Asked;
  readonly #onShown: () => void;
  readonly #images: SharedImages;
  readonly #grower: Grower;
  readonly #arrivals: Arrivals;
  /** Parts that live are nothing that one bumps into. */
  readonly #alive: ReadonlySet<number>;
  #tables: readonly FeatureTable[];

  /** `onShown` is called when something has come, or has not. */
  constructor(asked: Asked, budget: Budget, onShown: () => void) {
    const { place, address, drawing } = asked;
    const { tileset } = place;
    const changed = (): void => {
      this.viewer?.invalidate();
      onShown();
    };
    const sight = (): Sight => this.viewer?.sight ?? { eye: place.start.eye, direction: null, half_rad: 0 };
    this.#asked = asked;
    this.#onShown = onShown;
    this.town = tileset === null ? null : new drawing.Town(fileAddress(tileset, address), budget, () => this.viewer?.invalidate(), onShown);
    const wanted = tileset === null ? place.parts : [];
    this.parts = wanted.map((part) => new drawing.PartSlot(part));
    this.#tables = this.parts.map(({ table }) => table);
    this.#alive = new Set(place.animals.map(({ part }) => part));
    this.#images = new drawing.SharedImages(budget.mostTexture_px);
    this.#grower = new drawing.Grower();
    this.wishes = new Wishes(changed);
    this.clouds = new drawing.CloudArrivals(place.clouds, address, () => this.#showClouds());
    this.recorded = new drawing.Recorded(this.parts, async (part) => await this.#record(part), changed, drawing.bringingBy(sight));
    this.#arrivals = new Arrivals(wanted, sight, async (index) => await this.#bring(index), onShown);
  }

  /** They grow as parts arrive, and tiles do. */
  get tables(): readonly FeatureTable[] {
    return this.town?.tables ?? this.#tables;
  }

  get onTheWay(): { readonly waiting: number; readonly unseen: number; readonly missing: readonly Missing[] } {
    const [parts, { recorded, clouds, wishes, town }] = [this.#arrivals, this];
    const missing = [...(town?.missing ?? parts.missing), ...recorded.missing, ...clouds.missing, ...wishes.missing];
    return { waiting: parts.waiting + recorded.waiting + clouds.waiting, unseen: wishes.waiting, missing };
  }

  /** Asks for what is there at first, and waits for that without which nothing can be drawn. Fault where that does not come. */
  async begin(onProgress: OnProgress): Promise<void> {
    this.#arrivals.start();
    await this.town?.open((share) => onProgress(share, "tileset.json"));
    if (!this.#isSized) await this.arrived();
    if (this.#isCloudAlone) await this.clouds.bring((share, file) => onProgress(0.97 * share, file));
    const [firstCloud] = this.clouds.missing;
    if (firstCloud !== undefined && this.clouds.group.children.length === 0) throw firstCloud.fault;
  }

  /** Waits for as many parts as the first picture shows. Fault where none of them comes. */
  async arrived(): Promise<void> {
    const isWhole = this.parts.length <= FEW_PARTS || !this.#isSized;
    await (isWhole ? this.#arrivals.tried() : this.#arrivals.first());
    const [firstMissing] = this.#arrivals.missing;
    if (firstMissing !== undefined && !this.parts.some(({ isThere }) => isThere)) throw firstMissing.fault;
  }

  /** Brings what the first picture does not wait for. */
  goOn(): void {
    if (!this.#isCloudAlone) void this.clouds.bring(() => undefined).then(() => this.#showClouds());
  }

  /** Asks at once for what did not come. */
  askNow(): void {
    for (const one of [this.#arrivals, this.recorded, this.clouds, this.wishes]) one.askNow();
    this.town?.askNow();
  }

  /** A viewer lets go of what it draws. */
  dispose(): void {
    for (const one of [this.recorded, this.clouds, this.#arrivals, this.#grower, this.wishes]) one.dispose();
    (this.viewer ?? this.town)?.dispose();
    this.viewer = null; // for what comes after that
  }

  /** Points are waited for where there is nothing else to see. */
  get #isCloudAlone(): boolean {
    const { parts, walks } = this.#asked.place;
    return parts.length + walks.length === 0 && this.town === null;
  }

  get #isSized(): boolean {
    return this.parts.every(({ part }) => part.bounds !== null);
  }

  async #bring(index: number): Promise<void> {
    const slot = this.parts[index];
    if (slot === undefined) return;
    const { address, drawing, headStart } = this.#asked;
    const loaded = await drawing.readPart(slot.part, await headStart.bytesOf(slot.part, index), this.#images);
    loaded.group.updateMatrixWorld(true);
    const meets = !slot.part.isBackdrop && !this.#alive.has(index);
    const taken = (meets ? this.#grower.solidOf(drawing.stillOf(loaded), index) : Promise.resolve(null)).then((solid) => {
      slot.take(loaded, solid);
      this.#tables = [...this.#tables]; // the panels count anew
      this.viewer?.take(index);
    });
    // Its document comes while the worker builds what one bumps into.
    const housed = drawing.bringHouse(loaded, address, this.houses.length, this.wishes, taken, (one) => {
      const house = { house: one, part: slot };
      this.houses.push(house);
      this.viewer?.household.take(house);
    });
    await Promise.all([taken, housed]);
    this.viewer?.warm(slot.group); // not before: with its rooms a house is drawn by other programs
  }

  async #record(part: Part): Promise<readonly Object3D[]> {
    const { address, drawing } = this.#asked;
    const bytes = await fetchBytes(fileAddress(part.model, address), part.model, () => undefined);
    return (await drawing.readPart(part, bytes, this.#images)).group.children;
  }

  #showClouds(): void {
    this.viewer?.takeClouds();
    this.#onShown();
  }
}
