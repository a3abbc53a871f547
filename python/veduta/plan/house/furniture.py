"""The furniture of a document as instances of a part: each object's mesh once, however many stand.

Where it stands is invented, and so is what it looks like.
"""

from __future__ import annotations

import difflib
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from shapely.affinity import rotate, translate
from shapely.geometry import Polygon, box

from veduta.grammar.surfaces.catalogue import PREFIX, SURFACES, painted
from veduta.place.builder import PartBuilder
from veduta.place.instances import InstanceGroup, Instances, SharedMesh
from veduta.place.material import Material, Texture
from veduta.place.part import Part
from veduta.place.semantics import Provenance, SemanticClass
from veduta.plan.document import Furniture, PlanDocument, Storey
from veduta.plan.furnish.catalogue.entry import Finish, Size
from veduta.plan.furnish.catalogue.read import Catalogue
from veduta.plan.furnish.shapes import asset_of, finishes_of
from veduta.plan.house.floors import FINISH_M
from veduta.run.errors import InputError


def footprint(item: Furniture) -> Polygon:
    """The rectangle on which a thing stands (plan frame, m)."""
    width, depth, _ = item.size_m
    shape = box(-width / 2.0, -depth / 2.0, width / 2.0, depth / 2.0)
    turned = rotate(shape, item.turn_rad, origin=(0.0, 0.0), use_radians=True)
    return translate(turned, *item.at_m)


@dataclass
class Furnishing:
    """What grows while a part's features and materials do: meshes and where they stand."""

    builder: PartBuilder
    catalogue: Catalogue
    coarse: bool = False

    def __post_init__(self) -> None:
        self._meshes: list[SharedMesh] = []
        self._materials: dict[Finish, int] = {}
        self._kinds: dict[tuple[str, Size], tuple[int, tuple[int, ...]]] = {}
        self._rows: dict[tuple[str, Size], list[int]] = {}
        self._places: dict[tuple[str, Size], list[NDArray[np.float64]]] = {}

    def add(self, storey: Storey) -> None:
        """The things of a storey, on its finished floor."""
        for thing in storey.furniture or ():
            key = (thing.object, thing.size_m)
            if key not in self._kinds:
                self._kinds[key] = self._kind(*key)
            row = self.builder.feature(
                SemanticClass.FURNITURE,
                Provenance.INVENTED if thing.origin == "invented" else Provenance.INFERRED,
                f"{storey.name} {thing.object} {thing.id}",
                size_m=(thing.size_m[0], thing.size_m[2]),
            )
            self._rows.setdefault(key, []).append(row)
            self._places.setdefault(key, []).append(_place(thing, storey.elevation_m + FINISH_M))

    def instances(self) -> Instances | None:
        """All of them; None without any."""
        groups = [
            InstanceGroup(
                *self._kinds[key], np.stack(places), np.array(self._rows[key], dtype=np.int32)
            )
            for key, places in self._places.items()
        ]
        return Instances(tuple(self._meshes), tuple(groups)) if groups else None

    def onto(self, part: Part) -> Part:
        """The part with them."""
        return replace(part, instances=self.instances())

    def _kind(self, name: str, size_m: Size) -> tuple[int, tuple[int, ...]]:
        """The number of the mesh of an object, and the materials of its slots."""
        entry = self.catalogue.entries[name]
        asset = asset_of(entry, size_m, self.catalogue, coarse=self.coarse)
        self._meshes.append(replace(asset.shared_mesh, name=name))
        looks = finishes_of(asset, entry, self.catalogue)
        return len(self._meshes) - 1, tuple(self._material(look) for look in looks)

    def _material(self, look: Finish) -> int:
        if look not in self._materials:
            self._materials[look] = self.builder.material(material_of(look))
        return self._materials[look]


def material_of(look: Finish) -> Material:
    """A finish of the catalogue as a material, with its painted texture."""
    texture = None
    if look.texture is not None and look.texture in SURFACES:
        pixels = painted(PREFIX + look.texture)
        texture = Texture(pixels, np.ones(pixels.shape[:2], dtype=np.bool_))
    return Material(look.name, look.colour, look.roughness, look.metalness, texture, look.opacity)


def check_objects(document: PlanDocument, catalogue: Catalogue, file: Path) -> None:
    """InputError where a document names an object that the catalogue has not."""
    for number, storey in enumerate(document.storeys):
        for index, thing in enumerate(storey.furniture or ()):
            if thing.object in catalogue.entries:
                continue
            near = difflib.get_close_matches(thing.object, catalogue.entries, n=1)
            hint = f"Did you mean {near[0]!r}?" if near else "Give its catalogue with --catalogue."
            place = f"storeys[{number}].furniture[{index}].object"
            raise InputError(file, f"{place}: no object {thing.object!r} is known", hint)


def _place(thing: Furniture, floor_m: float) -> NDArray[np.float64]:
    """(3, 4) from the frame of the mesh to that of the part."""
    c, s = np.cos(thing.turn_rad), np.sin(thing.turn_rad)
    return np.array(
        [
            [c, -s, 0.0, thing.at_m[0]],
            [s, c, 0.0, thing.at_m[1]],
            [0.0, 0.0, 1.0, floor_m + thing.above_m],
        ]
    )
