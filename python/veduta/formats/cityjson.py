"""CityJSON 2.0, level of detail 3: a Building with its installations.

https://www.cityjson.org/specs/2.0.1/ - sections 2.3 (Building), 3 (geometry), 3.3 (semantics).
The body is a Solid whose windows and doors name the wall that they open as parent; balconies,
chimneys and lids are BuildingInstallation objects, each a Solid of its own. Vertices are
integers of a tenth of a millimetre, shared by all that touch. Axes: z up, as in the part. Where the
textures lie in files, surfaces name them (section 6, Appearance): texture vertices count from the
lower left corner.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np

from veduta.formats import cityjson_frame as frame
from veduta.formats.known_values import known
from veduta.place.flatten import flattened
from veduta.place.material import Texture
from veduta.place.part import NO_PARENT, Part
from veduta.place.semantics import CITYJSON_SURFACE, OPENINGS
from veduta.run.atomic import write_bytes

# Size of the integer grid (m).
GRID_M = 1e-4
# A face whose normal leans at least this much up or down is a floor or a ceiling.
LEVEL = 0.7
THEME = "veduta"
NO_PICTURES: Mapping[Texture, str] = MappingProxyType({})


def write_cityjson(part: Part, path: Path, pictures: Mapping[Texture, str] = NO_PICTURES) -> None:
    """Write the part as one building; the file appears whole or not at all.

    pictures: the files of its textures, by their paths from the file's folder.
    """
    write_bytes(path, frame.encoded(cityjson(part, pictures)))


def cityjson(part: Part, pictures: Mapping[Texture, str] = NO_PICTURES) -> dict[str, Any]:
    """The CityJSON object of the part; what stands in it many times is written each time."""
    part = flattened(part)
    look = _Appearance(part, pictures)
    low = np.floor(part.positions_m.min(axis=0).astype(np.float64))
    vertices, vertex_of = frame.shared_vertices(part.positions_m.astype(np.float64), low, GRID_M)
    rings = _Rings(part.polygon_offsets.tolist(), part.ring_offsets.tolist(), vertex_of.tolist())
    building: dict[str, Any] = {
        "type": "Building",
        "attributes": known(part.attributes),
        "geometry": [_solid(part, 0, rings, look, on_building=True)],
    }
    objects: dict[str, Any] = {part.id: building}
    for shell in range(1, int(part.features.shell.max()) + 1):
        rows = np.flatnonzero(part.features.shell == shell)
        name = part.features.id[int(rows[0])]
        objects[name] = {
            "type": "BuildingInstallation",
            "parents": [part.id],
            "attributes": {
                "class": part.features.semantic(int(rows[0])).value,
                "name": part.features.name[int(rows[0])],
            },
            "geometry": [_solid(part, shell, rings, look, on_building=False)],
        }
    if len(objects) > 1:
        building["children"] = [name for name in objects if name != part.id]
    (west, south, bottom), (east, north, top) = part.bounds_m
    whole = frame.document(
        GRID_M,
        low.tolist(),
        title=part.id,
        extent_m=(west, south, bottom, east, north, top),
        objects=objects,
        vertices=vertices,
    )
    shown = look.shown.told(THEME)
    return whole | ({"appearance": shown} if shown else {})


@dataclass(frozen=True)
class _Rings:
    """Of a part, as lists, which are cut up many times faster than arrays.

    polygons: the first ring of each and the end, rings: the same for corners. vertices: of corners.
    """

    polygons: list[int]
    rings: list[int]
    vertices: list[int]

    def spans(self, polygon: int) -> list[tuple[int, int]]:
        """From which corner to which each ring of a polygon runs."""
        first, last = self.polygons[polygon], self.polygons[polygon + 1]
        return [(self.rings[ring], self.rings[ring + 1]) for ring in range(first, last)]

    def of(self, spans: list[tuple[int, int]]) -> list[list[int]]:
        """The vertices of each ring of a polygon."""
        return [self.vertices[a:b] for a, b in spans]


@dataclass
class _Appearance:
    """The pictures that surfaces of a part name."""

    part: Part
    pictures: Mapping[Texture, str]
    names: list[str | None] = field(init=False)
    corners: list[list[float]] = field(init=False)
    materials: list[int] = field(init=False)
    shown: frame.Shown = field(default_factory=frame.Shown)

    def __post_init__(self) -> None:
        """Look up the picture of each material once, and bring all corners there at once."""
        textures = [material.texture for material in self.part.materials]
        self.names = [None if one is None else self.pictures.get(one) for one in textures]
        self.corners = frame.corners_on_picture(self.part.uv) if any(self.names) else []
        self.materials = self.part.polygon_material.tolist()

    def of(self, polygon: int, spans: list[tuple[int, int]]) -> list[list[int | None]]:
        """What of which picture each ring of a polygon shows."""
        name = self.names[self.materials[polygon]]
        if name is None:
            return [[None] for _ in spans]
        return [self.shown.shown(name, self.corners[a:b]) for a, b in spans]


def _solid(
    part: Part, shell: int, rings: _Rings, look: _Appearance, *, on_building: bool
) -> dict[str, Any]:
    """One closed shell with a semantic surface per feature (and per direction beside the body)."""
    surfaces: list[dict[str, Any]] = []
    number_of: dict[tuple[int, str], int] = {}
    boundaries: list[list[list[int]]] = []
    values: list[int] = []
    textures: list[list[list[int | None]]] = []
    polygons = part.polygons_of_shell(shell)
    features = part.polygon_feature[polygons].tolist()
    rises = part.triangles.polygon_normal[polygons, 2].tolist()
    for polygon, feature, rise in zip(polygons.tolist(), features, rises, strict=True):
        key = (
            feature,
            CITYJSON_SURFACE[part.features.semantic(feature)]
            if on_building
            else _by_direction(rise),
        )
        if key not in number_of:
            number_of[key] = len(surfaces)
            surfaces.append(surface_entry(part, *key))
        values.append(number_of[key])
        spans = rings.spans(polygon)
        boundaries.append(rings.of(spans))
        textures.append(look.of(polygon, spans))
    if on_building:
        _link_openings(part, surfaces, {feature: row for (feature, _), row in number_of.items()})
    looks = {"texture": (THEME, textures)} if frame.has_pictures(textures) else {}
    return frame.geometry("3", boundaries, surfaces, values, closed=True, looks=looks)


def _by_direction(normal_z: float) -> str:
    if normal_z > LEVEL:
        return "OuterFloorSurface"
    return "OuterCeilingSurface" if normal_z < -LEVEL else "WallSurface"


def surface_entry(part: Part, feature: int, kind: str) -> dict[str, Any]:
    """What is said of a semantic surface of a feature; kind: CityJSON's word for it."""
    features = part.features
    surface = frame.surface(
        kind,
        features.id[feature],
        features.name[feature],
        features.semantic(feature).value,
        features.provenance(feature).value,
    )
    for name in ("width_m", "height_m", "seen_height_m", "score"):
        size = float(getattr(features, name)[feature])
        if not math.isnan(size):
            surface[name] = round(size, 4)
    return surface


def _link_openings(part: Part, surfaces: list[dict[str, Any]], row_of: dict[int, int]) -> None:
    """Windows and doors get the wall that they open as parent; that wall lists its children."""
    for feature, row in sorted(row_of.items()):
        if part.features.semantic(feature) not in OPENINGS:
            continue
        parent = int(part.features.parent[feature])
        while parent != NO_PARENT and part.features.semantic(parent) in OPENINGS:
            parent = int(part.features.parent[parent])
        if parent == NO_PARENT or parent not in row_of:
            continue
        frame.link(surfaces, row, row_of[parent])
