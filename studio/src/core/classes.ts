/** The semantic classes and the kinds of provenance: names and colours that people see. */
import type { StudioContract } from "../generated/place.ts";

export type SemanticClass = StudioContract["semantic_class"];
export type Provenance = StudioContract["provenance"];

export interface ClassLook {
  readonly label: string;
  readonly plural: string;
  /** sRGB, `#rrggbb`. */
  readonly colour: string;
}

/** In the order in which the layers are listed. */
export const CLASS_LOOKS: Readonly<Record<SemanticClass, ClassLook>> = {
  wall: { label: "Wall", plural: "Walls", colour: "#cbb89a" },
  window: { label: "Window", plural: "Windows", colour: "#4d8fbf" },
  door: { label: "Door", plural: "Doors", colour: "#a8643c" },
  balcony: { label: "Balcony", plural: "Balconies", colour: "#7c6bb0" },
  shop: { label: "Shop front", plural: "Shop fronts", colour: "#4f9d78" },
  cornice: { label: "Cornice", plural: "Cornices", colour: "#b98f5a" },
  roof: { label: "Roof", plural: "Roofs", colour: "#6c7a89" },
  chimney: { label: "Chimney", plural: "Chimneys", colour: "#9a5b4f" },
  ground: { label: "Ground", plural: "Ground", colour: "#8f8f86" },
  floor: { label: "Floor", plural: "Floors", colour: "#b08d67" },
  ceiling: { label: "Ceiling", plural: "Ceilings", colour: "#d9d4c7" },
  furniture: { label: "Furniture", plural: "Furniture", colour: "#7f9a86" },
  shadow: { label: "Shadow", plural: "Shadows", colour: "#5d5a63" },
  other: { label: "Other surface", plural: "Other surfaces", colour: "#a39aa8" },
};

/** What is there to be looked at alone: nobody points at it, measures it or bumps into it. */
const DRAWN_ONLY: ReadonlySet<SemanticClass> = new Set(["shadow"]);

export function isDrawnOnly(kind: SemanticClass): boolean {
  return DRAWN_ONLY.has(kind);
}

export interface ProvenanceLook {
  readonly label: string;
  readonly meaning: string;
  readonly colour: string;
}

export const PROVENANCE_LOOKS: Readonly<Record<Provenance, ProvenanceLook>> = {
  measured: {
    label: "Measured",
    meaning: "Found in a photo or a drawing. Its place and size were read from there.",
    colour: "#2f7fd1",
  },
  inferred: {
    label: "Inferred",
    meaning: "Not seen directly. It follows from what was measured, by a rule.",
    colour: "#e3a02f",
  },
  invented: {
    label: "Invented",
    meaning: "No photo or drawing shows it. It was added, or painted in, to complete the building.",
    colour: "#c2487a",
  },
};

export const CLASSES = Object.keys(CLASS_LOOKS) as readonly SemanticClass[];
export const PROVENANCES = Object.keys(PROVENANCE_LOOKS) as readonly Provenance[];

export function isSemanticClass(value: unknown): value is SemanticClass {
  return typeof value === "string" && Object.hasOwn(CLASS_LOOKS, value);
}

export function isProvenance(value: unknown): value is Provenance {
  return typeof value === "string" && Object.hasOwn(PROVENANCE_LOOKS, value);
}
