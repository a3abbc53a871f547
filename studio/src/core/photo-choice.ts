/**
 * Which photos a visitor would see much the same: they fade in as one walks past.
 *
 * After the penalties of the unstructured lumigraph (Buehler et al., SIGGRAPH 2001): the angle between
 * the two views of what the photo shows, how far that is from the middle of what the visitor sees, and
 * how much nearer or farther it is. Each is given in shares of what is still bearable; their root of
 * squares is how far astray the visitor is from the photo: 0 in its place, from 1 on too far.
 */
import { dot, length, subtract, type Vec3 } from "./vector.ts";

export interface Visitor {
  readonly eye: Vec3;
  /** Unit vector. */
  readonly direction: Vec3;
}

/** A photo as the choice sees it: where it was taken, and what is in its middle. */
export interface Vantage {
  readonly eye: Vec3;
  readonly focus: Vec3;
}

const MOST_PARALLAX_RAD = 0.75;
const MOST_TURN_RAD = 0.7;
/** In doublings of the distance: a photo that is enlarged still shows something, a small one little. */
const MOST_NEARER = 2.2;
const MOST_FARTHER = 1.4;
/** Up to here a photo is shown wholly. */
const WHOLLY = 0.45;
/** One that is shown stays until it is this much worse than what would let it in. */
const LOYALTY = 1.2;
/** How much more of the surface the nearer of two photos has: e-fold over this difference. */
const SHARPNESS = 0.18;

export function strayOf(visitor: Visitor, { eye, focus }: Vantage): number {
  const own = subtract(focus, visitor.eye);
  const theirs = subtract(focus, eye);
  // From the other side one sees nothing of it.
  if (dot(own, theirs) <= 0) return Infinity;
  const parallax = angleBetween(own, theirs) / MOST_PARALLAX_RAD;
  const turn = angleBetween(own, visitor.direction) / MOST_TURN_RAD;
  const doublings = Math.log2(length(own) / length(theirs));
  const zoom = doublings / (doublings < 0 ? MOST_NEARER : MOST_FARTHER);
  const stray = Math.hypot(parallax, turn, zoom);
  return Number.isNaN(stray) ? Infinity : stray;
}

/** The photo that shows most of what the visitor sees, however far off; null where there is none. */
export function nearestPhoto(visitor: Visitor, vantages: readonly Vantage[]): number | null {
  let nearest: { index: number; stray: number } | null = null;
  for (const [index, vantage] of vantages.entries()) {
    const stray = strayOf(visitor, vantage);
    if (stray < (nearest?.stray ?? Infinity)) nearest = { index, stray };
  }
  return nearest?.index ?? null;
}

function angleBetween(a: Vec3, b: Vec3): number {
  return Math.acos(Math.min(1, Math.max(-1, dot(a, b) / (length(a) * length(b)))));
}

export interface Chosen {
  readonly index: number;
  /** 0..1: how far it is to fade in. */
  readonly level: number;
  /** Its share beside the others that are shown: the nearest has 1. */
  readonly share: number;
}

/**
 * The nearest photos, best first, at most `most`. Those of `shown` are kept a little longer than they
 * would be taken, and give way to a clearly better one only: nothing flickers on the border.
 */
export function chosenPhotos(
  visitor: Visitor,
  vantages: readonly Vantage[],
  shown: ReadonlySet<number>,
  most: number,
): Chosen[] {
  const near: { index: number; stray: number }[] = [];
  for (const [index, vantage] of vantages.entries()) {
    const stray = strayOf(visitor, vantage) / (shown.has(index) ? LOYALTY : 1);
    if (stray < 1) near.push({ index, stray });
  }
  near.sort((a, b) => a.stray - b.stray || a.index - b.index);
  const least = near[0]?.stray ?? 0;
  return near.slice(0, most).map(({ index, stray }) => ({
    index,
    level: smooth((1 - stray) / (1 - WHOLLY)),
    share: Math.exp((least - stray) / SHARPNESS),
  }));
}

function smooth(t: number): number {
  const held = Math.min(1, Math.max(0, t));
  return held * held * (3 - 2 * held);
}

/** A level on its way: it moves with even speed, from nothing to wholly in `whole_s`. */
export function approached(level: number, wanted: number, seconds: number, whole_s: number): number {
  const step = seconds / whole_s;
  return level < wanted ? Math.min(wanted, level + step) : Math.max(wanted, level - step);
}
