"""CityJSON 2.0 of several buildings with textures (section 6 of the specification, Appearance).

https://www.cityjson.org/specs/2.0.1/#appearance-object - pictures are files beside; a ring that
has a texture names it and a texture vertex per corner, a ring without has null. Texture vertices
count from the lower left corner. A building whose polygons close a volume is a Solid, another a
MultiSurface. Vertices are integers of a millimetre, shared by all that touch.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from veduta.formats import cityjson_frame as frame
from veduta.formats.known_values import known
from veduta.place.part import Part
from veduta.place.semantics import CITYJSON_SURFACE, SemanticClass
from veduta.run.atomic import write_bytes

GRID_M = 1e-3
THEME = "photos"
_LEVEL = 0.99


@dataclass(frozen=True)
class TexturedPart:
    """A building. offset_m: from the model's origin. pictures: paths by the part's materials.

    polygon_seen: (p,) the share of each polygon's face that photos show.
    """

    part: Part
    offset_m: tuple[float, float, float]
    pictures: Mapping[int, str]
    polygon_seen: NDArray[np.float64]


def write_textured(
    parts: Sequence[TexturedPart],
    crs: str | None,
    origin_m: tuple[float, float, float],
    path: Path,
) -> None:
    """Write the buildings; the file appears whole or not at all. Ids are the parts'."""
    write_bytes(path, frame.encoded(textured(parts, crs, origin_m)))


def textured(
    parts: Sequence[TexturedPart], crs: str | None, origin_m: tuple[float, float, float]
) -> dict[str, Any]:
    """The CityJSON object of buildings about an origin in a CRS ("EPSG:25832")."""
    world = [one.part.positions_m.astype(np.float64) + one.offset_m + origin_m for one in parts]
    every = np.concatenate(world)
    low = np.floor(every.min(axis=0))
    vertices, vertex_of = frame.shared_vertices(every, low, GRID_M)
    ends = np.cumsum([0, *(len(points) for points in world)])
    pictures = sorted({path for one in parts for path in one.pictures.values()})
    number_of = {path: number for number, path in enumerate(pictures)}
    texture_vertices: list[list[float]] = []
    objects = {}
    for row, one in enumerate(parts):
        own = vertex_of[ends[row] : ends[row + 1]]
        geometry = _geometry(one, own, number_of, texture_vertices)
        objects[one.part.id] = {
            "type": "Building",
            "attributes": known(one.part.attributes),
            "geometry": [geometry],
        }
    whole = frame.document(
        GRID_M,
        low.tolist(),
        extent_m=[*every.min(axis=0).tolist(), *every.max(axis=0).tolist()],
        crs=crs,
        objects=objects,
        vertices=vertices,
    )
    if pictures:
        shown = [frame.texture(path, "none", "specific") for path in pictures]
        whole["appearance"] = frame.textures(THEME, shown, texture_vertices)
    return whole


def _geometry(
    one: TexturedPart,
    vertex_of: NDArray[np.int64],
    number_of: Mapping[str, int],
    texture_vertices: list[list[float]],
) -> dict[str, Any]:
    part = one.part
    boundaries, values = [], []
    textures: list[list[list[int | None]]] = []
    surfaces: list[dict[str, Any]] = []
    surface_of: dict[int, int] = {}
    for polygon in range(len(part.polygon_feature)):
        feature = int(part.polygon_feature[polygon])
        if feature not in surface_of:
            surface_of[feature] = len(surfaces)
            surfaces.append(_surface(one, feature))
        values.append(surface_of[feature])
        picture = one.pictures.get(int(part.polygon_material[polygon]))
        rings = []
        mapped: list[list[int | None]] = []
        for ring in range(part.polygon_offsets[polygon], part.polygon_offsets[polygon + 1]):
            corners = slice(int(part.ring_offsets[ring]), int(part.ring_offsets[ring + 1]))
            rings.append(vertex_of[corners].tolist())
            if picture is None:
                mapped.append([None])
                continue
            first = len(texture_vertices)
            texture_vertices += frame.corners_on_picture(np.clip(part.uv[corners], 0.0, 1.0))
            mapped.append([number_of[picture], *range(first, len(texture_vertices))])
        boundaries.append(rings)
        textures.append(mapped)
    closed = int(part.features.shell.max()) == 0 and frame.closes_volume(boundaries)
    looks = {"texture": (THEME, textures)} if one.pictures else {}
    lod = level_of_detail(part)
    return frame.geometry(lod, boundaries, surfaces, values, closed=closed, looks=looks)


def level_of_detail(part: Part) -> str:
    """Two where a roof leans, one where all are level."""
    roofs = part.features.class_code[part.polygon_feature] == SemanticClass.ROOF.code
    leaning = part.triangles.polygon_normal[roofs, 2] < _LEVEL
    return "2" if leaning.any() else "1"


def _surface(one: TexturedPart, feature: int) -> dict[str, Any]:
    features = one.part.features
    own = one.part.polygon_feature == feature
    area = one.part.triangles.polygon_area_m2[own]
    seen = float((area * one.polygon_seen[own]).sum() / max(float(area.sum()), 1e-9))
    return {
        "type": CITYJSON_SURFACE[features.semantic(feature)],
        "id": features.id[feature],
        "provenance": features.provenance(feature).value,
        "seen_share": round(seen, 3),
    }
