/** The picture around a place: by night it is as dark as the ground is. */
import { type Color, type Material, MeshBasicMaterial, MeshStandardMaterial } from "three";
import type { LoadedPart } from "./load.ts";

export class Backdrop {
  readonly #materials: readonly (MeshBasicMaterial | MeshStandardMaterial)[];

  constructor(parts: readonly LoadedPart[]) {
    const meshes = parts.filter(({ part }) => part.isBackdrop).flatMap(({ meshes }) => meshes);
    this.#materials = meshes.flatMap(({ mesh }) => [mesh.material].flat()).filter(hasColour);
  }

  /** Pictures are taken by day: `shown` is what of its light there is now. */
  light(shown: Color): void {
    for (const material of this.#materials) material.color.copy(shown);
  }
}

function hasColour(material: Material): material is MeshBasicMaterial | MeshStandardMaterial {
  return material instanceof MeshBasicMaterial || material instanceof MeshStandardMaterial;
}
