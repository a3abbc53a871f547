/** A map of the storey on which one walks: where one is, which way one looks, and the room's name. */
import { css, html, LitElement, nothing, svg, type TemplateResult } from "lit";
import type { House, Point, Storey } from "../core/house.ts";
import { areaOf, boxOfStorey, lineOf, type MapBox, onMap } from "../core/map-drawing.ts";
import type { Vec3 } from "../core/vector.ts";
import { isBesideRoom, roomAt, roomTitle, standingPlaces, type Whereabouts } from "../core/whereabouts.ts";
import { areaText } from "../core/wording.ts";
import { theme } from "./theme.ts";

/** Lines thinner than this share of the map would not be seen. */
const THINNEST = 1 / 110;
/** Half the angle that the cone of view shows. */
const VIEW_RAD = 0.55;

export interface Standing {
  readonly feet: Vec3;
  /** As in `Heading`. */
  readonly yaw: number;
  readonly where: Whereabouts | null;
  /** How far the lamps of the house's rooms are on, by their numbers over all storeys. */
  readonly levels: readonly number[];
}

export class Minimap extends LitElement {
  static override properties = {
    houses: { attribute: false },
    where: { state: true },
    lit: { state: true },
  };
  declare houses: readonly House[];
  declare where: Whereabouts | null;
  /** Rooms whose lamps are on, by their numbers over all storeys. */
  declare lit: string;

  static override styles = [
    theme,
    css`
      :host {
        display: flex;
        flex-direction: column;
        gap: 6px;
        padding: 10px 12px 10px;
      }
      :host([hidden]) {
        display: none;
      }
      svg {
        display: block;
        width: 100%;
        max-height: var(--map-height, 190px);
        cursor: crosshair;
        touch-action: manipulation;
      }
      .room {
        fill: #fffdf8;
        stroke: none;
      }
      .outdoors {
        fill: #e3eadb;
      }
      .lit {
        fill: #ffe6ad;
      }
      .here {
        fill: #ffcb8a;
      }
      .wall {
        fill: none;
        stroke: var(--deep);
        stroke-linecap: square;
      }
      .way {
        fill: none;
        stroke: #fffdf8;
      }
      .window {
        fill: none;
        stroke: #8fc1de;
      }
      .view {
        fill: var(--accent);
        opacity: 0.28;
      }
      .visitor {
        fill: var(--accent);
        stroke: #fff;
      }
      .words {
        display: flex;
        flex-wrap: wrap;
        align-items: baseline;
        gap: 0 8px;
        min-height: 21px;
      }
      .words strong {
        flex: 1 1 auto;
        max-width: 100%;
        font-weight: 600;
        white-space: nowrap;
        overflow: hidden;
        text-overflow: ellipsis;
      }
      .words span {
        flex: none;
        font-size: 12.5px;
        color: var(--ink-soft);
        font-variant-numeric: tabular-nums;
      }
      .storeys {
        display: flex;
        flex-wrap: wrap;
        gap: 4px;
      }
      .storeys button {
        flex: 1 0 auto;
        padding: 3px 8px;
        border-radius: 7px;
        font-size: 12.5px;
        color: var(--ink-soft);
        background: var(--hover);
      }
      .storeys button[aria-pressed="true"] {
        background: var(--deep);
        color: #fff;
      }
    `,
  ];

  #standing: Standing | null = null;
  #box: MapBox = { x: 0, y: 0, width: 1, height: 1 };

  constructor() {
    super();
    this.houses = [];
    this.where = null;
    this.lit = "";
  }

  /** Called for each picture: only what one sees of it is drawn anew. */
  show(standing: Standing): void {
    this.#standing = standing;
    const { where, levels } = standing;
    const same =
      where?.house === this.where?.house && where?.storey === this.where?.storey && where?.room === this.where?.room;
    if (!same) this.where = where;
    this.lit = levels.map((level) => (level > 0.5 ? "1" : "0")).join("");
    this.#placeVisitor();
  }

  override updated(): void {
    this.#placeVisitor();
  }

  get #storey(): Storey | null {
    return this.where === null ? null : (this.houses[this.where.house]?.storeys[this.where.storey] ?? null);
  }

  override render(): TemplateResult | typeof nothing {
    const storey = this.#storey;
    if (storey === null || this.where === null) return nothing;
    const { room: here, house } = this.where;
    const room = here === null ? null : (storey.rooms[here] ?? null);
    const storeys = this.houses[house]?.storeys ?? [];
    return html`
      ${this.#map(storey, here)}
      <div class="words" role="status">
        <strong>${room === null ? this.#elsewhere(storey) : roomTitle(room)}</strong>
        ${room === null ? nothing : html`<span>${areaText(room.area_m2)}</span>`}
      </div>
      ${storeys.length < 2 ? nothing : html`<div class="storeys" role="group" aria-label="Storeys">
        ${storeys.map((each) => html`<button aria-pressed=${each === storey} title="Go there: ${each.name}"
          @click=${() => this.#goToStorey(each)}>${each.name}</button>`)}
      </div>`}
    `;
  }

  #map(storey: Storey, here: number | null): TemplateResult {
    this.#box = boxOfStorey(storey);
    const { x, y, width, height } = this.#box;
    const thinnest = Math.max(width, height) * THINNEST;
    const first = this.#firstRoom;
    const kind = (index: number): string => {
      if (index === here) return "here";
      if (this.lit[first + index] === "1") return "lit";
      return storey.rooms[index]?.isOutdoors === true ? "outdoors" : "";
    };
    return html`<svg viewBox="${x} ${y} ${width} ${height}" role="img" aria-label="Map of the storey: ${storey.name}"
      @click=${(event: MouseEvent) => this.#goTo(event, storey)}>
      <title>Click into a room to go there</title>
      ${storey.rooms.map((room, index) => svg`<path class="room ${kind(index)}" fill-rule="evenodd" d=${areaOf(room)} />`)}
      ${storey.walls.map(({ line, thickness_m }) => svg`<path class="wall" stroke-width=${Math.max(thinnest, thickness_m)} d=${lineOf(line)} />`)}
      ${storey.openings.map(({ kind, line, thickness_m }) => svg`<path class=${kind === "window" ? "window" : "way"}
        stroke-width=${1.1 * Math.max(thinnest, thickness_m)} d=${lineOf(line)} />`)}
      <g id="me">
        <path class="view" d="M0 0L${3.4 * Math.sin(-VIEW_RAD)} ${-3.4 * Math.cos(VIEW_RAD)}A3.4 3.4 0 0 1 ${3.4 * Math.sin(VIEW_RAD)} ${-3.4 * Math.cos(VIEW_RAD)}Z" />
        <circle class="visitor" r="0.62" stroke-width="0.22" />
      </g>
    </svg>`;
  }

  /** The number over all storeys of the storey's first room. */
  get #firstRoom(): number {
    const below = this.houses[this.where?.house ?? 0]?.storeys.slice(0, this.where?.storey ?? 0) ?? [];
    return below.reduce((count, { rooms }) => count + rooms.length, 0);
  }

  #placeVisitor(): void {
    const me = this.renderRoot.querySelector("#me");
    if (me === null || this.#standing === null) return;
    const { feet, yaw } = this.#standing;
    const [x, y] = onMap(this.#box, [feet[0], feet[1]]);
    const size = Math.max(this.#box.width, this.#box.height) / 20;
    me.setAttribute("transform", `translate(${x} ${y}) rotate(${(-yaw * 180) / Math.PI}) scale(${size})`);
  }

  #elsewhere(storey: Storey): string {
    const feet = this.#standing?.feet;
    return feet === undefined || isBesideRoom(storey, [feet[0], feet[1]]) ? "" : "Outside";
  }

  #goTo(event: MouseEvent, storey: Storey): void {
    const drawing = event.currentTarget as SVGSVGElement;
    const matrix = drawing.getScreenCTM();
    if (matrix === null) return;
    const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(matrix.inverse());
    const wanted: Point = [at.x, -at.y];
    const index = roomAt(storey, ...wanted);
    const room = index === null ? undefined : storey.rooms[index];
    if (room !== undefined) this.#go(standingPlaces(room, wanted), storey);
  }

  /** To the same place on another storey, or into the nearest room there. */
  #goToStorey(storey: Storey): void {
    const feet = this.#standing?.feet ?? [0, 0, 0];
    const wanted: Point = [feet[0], feet[1]];
    const places = storey.rooms.filter((room) => !room.isOutdoors).flatMap((room) => standingPlaces(room, wanted));
    const off = ([x, y]: Point): number => Math.hypot(x - wanted[0], y - wanted[1]);
    this.#go(places.toSorted((a, b) => off(a) - off(b)), storey);
  }

  #go(places: readonly Point[], { floor_m }: Storey): void {
    const detail = places.map(([x, y]): Vec3 => [x, y, floor_m]);
    this.dispatchEvent(new CustomEvent("go", { detail }));
  }
}

customElements.define("veduta-minimap", Minimap);
