/** Numbers as people read them. */
import { CLASS_LOOKS, type SemanticClass } from "./classes.ts";

/** A centimetre is finer than any photo of a building gives. */
export function metresText(metres: number): string {
  return `${metres.toFixed(2)} m`;
}

export function sizeText(width_m: number | null, height_m: number | null): string {
  if (width_m === null && height_m === null) return "not flat";
  const side = (value: number | null): string => (value === null ? "–" : value.toFixed(2));
  return `${side(width_m)} × ${side(height_m)} m`;
}

/** Of a surface that reaches further down than it was seen; empty where it was seen whole. */
export function seenText(seen_height_m: number | null): string {
  return seen_height_m === null ? "" : `(height seen: ${metresText(seen_height_m)})`;
}

/** How sure an element was when it was read; empty where nothing says it. */
export function scoreText(score: number | null): string {
  if (score === null) return "";
  return `${score < 0.5 ? "Doubtful: score" : "Score"} ${score.toFixed(2)} of 1.`;
}

export function areaText(area_m2: number | null): string {
  if (area_m2 === null) return "–";
  return `${area_m2 < 100 ? area_m2.toFixed(2) : area_m2.toFixed(0)} m²`;
}

export function countText(kind: SemanticClass, count: number): string {
  const { label, plural } = CLASS_LOOKS[kind];
  return `${count} ${(count === 1 ? label : plural).toLowerCase()}`;
}
