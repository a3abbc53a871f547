"""A place as CityJSON 2.0 with its textures beside it, level of detail 3.

https://www.cityjson.org/specs/2.0.1/ - a part is a Building; balconies, chimneys and the like are
BuildingInstallation objects. What closes a volume is a Solid, all else a MultiSurface. Vertices are
integers of a tenth of a millimetre, shared by all that touch; texture vertices count from the lower
left corner.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from veduta.formats import cityjson_frame as frame
from veduta.formats.city_objects import CitySurface, CityThing, city_things
from veduta.formats.pictures import Pictures
from veduta.formats.rings import GRID_M, Face
from veduta.formats.shapes import Look
from veduta.place.place import Place
from veduta.run.atomic import write_bytes

LOD = "3"
THEME = "veduta"


def write_place_cityjson(place: Place, path: Path) -> None:
    """Write the file, and a `.jpg` for each texture beside it."""
    document = _Document(Pictures(path))
    objects: dict[str, Any] = {}
    for thing in city_things(place):
        kind = "Building" if thing.is_building else "GenericCityObject"
        building = document.object(thing, kind)
        objects[thing.id] = building
        for one in thing.installations if thing.is_building else ():
            made = document.object(one, "BuildingInstallation")
            made["parents"] = [thing.id]
            building.setdefault("children", []).append(one.id)
            objects[one.id] = made
    write_bytes(path, frame.encoded(_whole(place, document, objects)))


def _whole(place: Place, document: _Document, objects: dict[str, Any]) -> dict[str, Any]:
    origin = tuple(place.origin_m) if place.crs else (0.0, 0.0, 0.0)
    vertices = document.vertices.told()
    extent = None
    if vertices:
        steps, shift = np.array(vertices, dtype=np.int64), np.array(origin)
        ends = [(steps.min(axis=0) * GRID_M + shift), (steps.max(axis=0) * GRID_M + shift)]
        extent = [round(float(v), 4) for v in np.concatenate(ends)]
    whole = frame.document(
        GRID_M,
        origin,
        title=place.title or None,
        extent_m=extent,
        crs=place.crs or None,
        objects=objects,
        vertices=vertices,
    )
    appearance = document.appearance()
    return whole | ({"appearance": appearance} if appearance else {})


@dataclass
class _Document:
    """Vertices, materials and textures of the file as they come."""

    pictures: Pictures
    vertices: frame.Vertices = field(default_factory=frame.Vertices)
    shown: frame.Shown = field(default_factory=frame.Shown)
    materials: dict[str, int] = field(default_factory=dict)
    looks: list[dict[str, Any]] = field(default_factory=list)

    def object(self, thing: CityThing, kind: str) -> dict[str, Any]:
        made: dict[str, Any] = {
            "type": kind,
            "attributes": {"name": thing.name} | dict(thing.attributes),
        }
        if thing.surfaces:
            geometry = self.geometry(thing)
            if kind == "GenericCityObject":
                del geometry["semantics"]  # it has no surfaces that the standard knows
            made["geometry"] = [geometry]
        return made

    def geometry(self, thing: CityThing) -> dict[str, Any]:
        boundaries: list[Any] = []
        values: list[int] = []
        textures: list[Any] = []
        materials: list[int] = []
        for row, surface in enumerate(thing.surfaces):
            for face in surface.faces:
                rings = [self.numbers(ring) for ring in face.rings]
                kept = [number for number, ring in enumerate(rings) if len(set(ring)) >= 3]
                if not kept or kept[0] != 0:
                    continue
                look = thing.looks[face.look]
                boundaries.append([rings[number] for number in kept])
                values.append(row)
                textures.append([self.texture(look, face, number) for number in kept])
                materials.append(self.material(look))
        looks: dict[str, tuple[str, list[Any]]] = {"material": (THEME, materials)}
        if frame.has_pictures(textures):
            looks["texture"] = (THEME, textures)
        surfaces, closed = _linked(thing.surfaces), frame.closes_volume(boundaries)
        return frame.geometry(LOD, boundaries, surfaces, values, closed=closed, looks=looks)

    def numbers(self, ring: NDArray[np.float64]) -> list[int]:
        return self.vertices.numbers(frame.steps_of(ring, np.zeros(3), GRID_M).tolist())

    def texture(self, look: Look, face: Face, number: int) -> list[int | None]:
        return self.shown.ring(self.pictures.name(look), face.uv[number])

    def material(self, look: Look) -> int:
        if look.name not in self.materials:
            self.materials[look.name] = len(self.looks)
            entry: dict[str, Any] = {
                "name": look.name,
                "diffuseColor": [round(value, 4) for value in look.material.colour],
                "transparency": round(1.0 - look.material.opacity, 4),
            }
            self.looks.append(entry)
        return self.materials[look.name]

    def appearance(self) -> dict[str, Any]:
        if not self.looks:
            return {}
        made: dict[str, Any] = {"default-theme-material": THEME, "materials": self.looks}
        return made | self.shown.told(THEME)


def _linked(surfaces: tuple[CitySurface, ...]) -> list[dict[str, Any]]:
    """What is said of each surface; walls list what opens them."""
    told: list[dict[str, Any]] = [
        frame.surface(one.kind, one.id, one.name, one.semantic, one.provenance) for one in surfaces
    ]
    for row, one in enumerate(surfaces):
        if one.parent is not None:
            frame.link(told, row, one.parent)
    return told
