/** A walk without WebGL 2: the pictures of its key positions, cross-faded, and why they are. */
import { css, html, LitElement, nothing, type TemplateResult } from "lit";
import { goneOf, type MorphWalk, nearestStation, placeOn } from "../core/morph-walk.ts";
import { fileAddress, placeAddress, readPlace } from "../core/place.ts";
import { theme } from "./theme.ts";

/** What one step of a key is, of a transition. */
const STEP = 0.125;

export interface PlainWalk {
  readonly walk: MorphWalk;
  /** Of the pictures of its stations. */
  readonly pictures: readonly string[];
}

/** The first walk of the place that a page asks for; null where it has none, or cannot be read. */
export async function plainWalkOf(page: URL): Promise<PlainWalk | null> {
  const address = placeAddress(page);
  try {
    const answer = await fetch(address);
    if (!answer.ok) return null;
    const walk = readPlace(await answer.text(), "place.json").walks[0];
    if (walk === undefined) return null;
    return { walk, pictures: walk.stations.map(({ picture }) => fileAddress(picture, address).href) };
  } catch {
    return null; // what is wrong with the place is said where it is drawn
  }
}

export class PlainWalkView extends LitElement {
  static override properties = { plain: { attribute: false }, at: { state: true }, instant: { state: true } };
  declare plain: PlainWalk | null;
  declare at: number;
  declare instant: boolean;
  #share = 0;

  static override styles = [
    theme,
    css`
      :host {
        position: absolute;
        inset: 0;
        background: #1b1e20;
      }
      img {
        position: absolute;
        width: 100%;
        height: 100%;
        object-fit: cover;
      }
      .panel {
        position: absolute;
        left: 50%;
        bottom: 20px;
        transform: translateX(-50%);
        width: min(560px, calc(100% - 32px));
        padding: 10px 16px;
      }
      .row {
        display: flex;
        gap: 12px;
        align-items: center;
      }
      input {
        flex: 1;
        min-width: 0;
      }
      p {
        margin-top: 6px;
        color: var(--ink-faint);
      }
    `,
  ];

  constructor() {
    super();
    this.plain = null;
    this.at = 0;
    this.instant = matchMedia("(prefers-reduced-motion: reduce)").matches;
  }

  override connectedCallback(): void {
    super.connectedCallback();
    addEventListener("keydown", this.#onKey);
  }

  override disconnectedCallback(): void {
    removeEventListener("keydown", this.#onKey);
    super.disconnectedCallback();
  }

  readonly #onKey = (event: KeyboardEvent): void => {
    const ahead = ["KeyW", "ArrowUp"].includes(event.code);
    if (!ahead && !["KeyS", "ArrowDown"].includes(event.code)) return;
    event.preventDefault();
    this.#go(this.at + (ahead ? 1 : -1) * (this.instant ? 1 : STEP));
  };

  #go(at: number): void {
    this.at = Math.min(Math.max(at, 0), this.plain?.walk.transitions.length ?? 0);
  }

  /** By the object: the page's policy allows no style attributes. */
  override updated(): void {
    const end = this.renderRoot.querySelector<HTMLImageElement>("[data-field=end]");
    if (end !== null) end.style.opacity = String(this.#share);
  }

  override render(): TemplateResult | typeof nothing {
    if (this.plain === null) return nothing;
    const { walk, pictures } = this.plain;
    const { transition, m } = placeOn(walk, this.instant ? nearestStation(walk, this.at) : this.at);
    const way = walk.transitions[transition];
    this.#share = way?.kind === "cut" ? Math.round(m) : m;
    const gone = goneOf(walk, this.at);
    return html`<img alt="" src=${pictures[way?.start ?? 0] ?? ""} data-field="start" />
      <img alt="" src=${pictures[way?.end ?? 0] ?? ""} data-field="end" />
      <div class="panel sheet" role="group" aria-label="The walk"
        @wheel=${(event: WheelEvent) => this.#go(this.at - (Math.sign(event.deltaY) * STEP) / 2)}>
        <div class="row">
          <strong data-field="metres">${gone}</strong>
          <input type="range" aria-label="How far the walk is" min="0" max=${walk.transitions.length} step="0.01"
            .value=${String(this.at)} @input=${(event: Event) => this.#go(Number((event.target as HTMLInputElement).value))} />
        </div>
        <p role="status">This browser offers no WebGL 2: the views are cross-faded and do not morph.</p>
      </div>`;
  }
}

customElements.define("veduta-plain-walk", PlainWalkView);
