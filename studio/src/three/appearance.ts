/** How each feature looks: its tint, whether it is shown, the outline of the selected one. */
import type { DataTexture } from "three";
import { CLASS_LOOKS, PROVENANCE_LOOKS } from "../core/classes.ts";
import type { Feature } from "../core/features.ts";
import type { FeatureRef, StudioState } from "../core/state.ts";
import { setTint, showRows, tintTexture } from "./feature-mesh.ts";
import { showInstances } from "./instanced-mesh.ts";
import type { LoadedPart } from "./load.ts";
import { ACCENT, Outline } from "./outline.ts";
import { addTint } from "./tinted-material.ts";

const SELECTED_STRENGTH = 0.34;
const COLOURING_STRENGTH = 0.78;

export class Appearance {
  readonly outline = new Outline();
  readonly #parts: readonly LoadedPart[];
  readonly #tints: (DataTexture | undefined)[] = [];
  readonly #maskStrength = { value: 0 };

  constructor(parts: readonly LoadedPart[]) {
    this.#parts = parts;
    for (const index of parts.keys()) this.take(index);
  }

  /** Takes over the materials of a part that has come. */
  take(index: number): void {
    const part = this.#parts[index];
    if (part === undefined || part.meshes.length + part.instanced.length === 0) return;
    const tints = tintTexture(part.table.rows.length);
    this.#tints[index] = tints;
    for (const { mesh } of [...part.meshes, ...part.instanced]) {
      for (const material of [mesh.material].flat()) {
        const mask = part.masks.get(material) ?? null;
        addTint(material, { tints, mask, maskStrength: this.#maskStrength });
      }
    }
  }

  tint(state: StudioState): void {
    this.#maskStrength.value = state.colouring === "provenance" ? 1 : 0;
    for (const [index, part] of this.#parts.entries()) {
      const tints = this.#tints[index];
      if (tints === undefined) continue;
      for (const [row, feature] of part.table.rows.entries()) {
        const selected = isSelected(state.selected, index, row);
        setTint(
          tints,
          row,
          selected ? ACCENT : colourOf(feature, state),
          selected ? SELECTED_STRENGTH : state.colouring === "photo" ? 0 : COLOURING_STRENGTH,
        );
      }
    }
  }

  showLayers(state: StudioState): void {
    for (const part of this.#parts) {
      const isVisible = (row: number): boolean => {
        const feature = part.table.rows[row];
        return feature !== undefined && !state.hidden.has(feature.class);
      };
      for (const mesh of part.meshes) showRows(mesh, isVisible);
      for (const mesh of part.instanced) showInstances(mesh, isVisible);
    }
  }

  outlineSelected(selected: FeatureRef | null): void {
    const part = selected === null ? undefined : this.#parts[selected.part];
    if (selected === null || part === undefined) this.outline.clear();
    else this.outline.show(part, selected.row);
  }
}

function isSelected(selected: FeatureRef | null, part: number, row: number): boolean {
  return selected?.part === part && selected.row === row;
}

function colourOf(feature: Feature, state: StudioState): string {
  return state.colouring === "provenance"
    ? PROVENANCE_LOOKS[feature.provenance].colour
    : CLASS_LOOKS[feature.class].colour;
}
