"""A place as CityJSON 2.0 with its textures beside it, level of detail 3.

https://www.cityjson.org/specs/2.0.1/ - a part is a Building; balconies, chimneys and the like are
BuildingInstallation objects. What closes a volume is a Solid, all else a MultiSurface. Vertices are
integers of a tenth of a millimetre, shared by all that touch; texture vertices count from the lower
left corner.
"""

from __future__ import annotations

import json
from collections import Counter
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from veduta.formats.city_objects import CitySurface, CityThing, city_things
from veduta.formats.pictures import Pictures
from veduta.formats.rings import GRID_M, Face
from veduta.formats.shapes import Look
from veduta.place.place import Place
from veduta.run.atomic import write_bytes

LOD = "3"
THEME = "veduta"
Vertex = tuple[int, int, int]


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
    write_bytes(path, json.dumps(_whole(place, document, objects), separators=(",", ":")).encode())


def _whole(place: Place, document: _Document, objects: dict[str, Any]) -> dict[str, Any]:
    metadata: dict[str, Any] = {}
    if place.title:
        metadata["title"] = place.title
    if document.vertices:
        steps = np.array(list(document.vertices), dtype=np.int64)
        shift = np.array(place.origin_m if place.crs else (0.0, 0.0, 0.0))
        ends = [(steps.min(axis=0) * GRID_M + shift), (steps.max(axis=0) * GRID_M + shift)]
        metadata["geographicalExtent"] = [round(float(v), 4) for v in np.concatenate(ends)]
    if place.crs:
        authority, _, code = place.crs.partition(":")
        metadata["referenceSystem"] = f"https://www.opengis.net/def/crs/{authority}/0/{code}"
    whole: dict[str, Any] = {
        "type": "CityJSON",
        "version": "2.0",
        "metadata": metadata,
        "transform": {
            "scale": [GRID_M] * 3,
            "translate": list(place.origin_m) if place.crs else [0.0, 0.0, 0.0],
        },
        "CityObjects": objects,
        "vertices": [list(vertex) for vertex in document.vertices],
    }
    appearance = document.appearance()
    return whole | ({"appearance": appearance} if appearance else {})


@dataclass
class _Document:
    """Vertices, materials and textures of the file as they come."""

    pictures: Pictures
    vertices: dict[Vertex, int] = field(default_factory=dict)
    uv: dict[tuple[float, float], int] = field(default_factory=dict)
    textures: dict[str, int] = field(default_factory=dict)
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
        closed = _closed(boundaries)
        geometry: dict[str, Any] = {
            "type": "Solid" if closed else "MultiSurface",
            "lod": LOD,
            "boundaries": [boundaries] if closed else boundaries,
            "semantics": {
                "surfaces": _linked(thing.surfaces),
                "values": [values] if closed else values,
            },
            "material": {THEME: {"values": [materials] if closed else materials}},
        }
        if any(ring != [None] for face in textures for ring in face):
            geometry["texture"] = {THEME: {"values": [textures] if closed else textures}}
        return geometry

    def numbers(self, ring: NDArray[np.float64]) -> list[int]:
        known = self.vertices
        steps = np.round(ring / GRID_M).astype(np.int64).tolist()
        return [known.setdefault((x, y, z), len(known)) for x, y, z in steps]

    def texture(self, look: Look, face: Face, number: int) -> list[int | None]:
        picture = self.pictures.name(look)
        if picture is None:
            return [None]
        image = self.textures.setdefault(picture, len(self.textures))
        uv, known = face.uv[number], self.uv
        flipped = np.round(np.column_stack([uv[:, 0], 1.0 - uv[:, 1]]), 6).tolist()
        return [image, *(known.setdefault((u, v), len(known)) for u, v in flipped)]

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
        if self.textures:
            made |= {
                "default-theme-texture": THEME,
                "textures": [
                    {"type": "JPG", "image": name, "wrapMode": "wrap"} for name in self.textures
                ],
                "vertices-texture": [list(vertex) for vertex in self.uv],
            }
        return made


def _linked(surfaces: tuple[CitySurface, ...]) -> list[dict[str, Any]]:
    """What is said of each surface; walls list what opens them."""
    told: list[dict[str, Any]] = [
        {
            "type": one.kind,
            "id": one.id,
            "name": one.name,
            "class": one.semantic,
            "provenance": one.provenance,
        }
        for one in surfaces
    ]
    for row, one in enumerate(surfaces):
        if one.parent is not None:
            told[row]["parent"] = one.parent
            told[one.parent].setdefault("children", []).append(row)
    return told


def _closed(boundaries: list[Any]) -> bool:
    """Whether each edge is there once to and once fro."""
    edges: Counter[tuple[int, int]] = Counter()
    for rings in boundaries:
        for ring in rings:
            edges.update(pairwise([*ring, ring[0]]))
    return bool(edges) and all(
        count == 1 and edges[(end, start)] == 1 for (start, end), count in list(edges.items())
    )
