"""CityJSON 2.0 of several buildings with textures (section 6 of the specification, Appearance).

https://www.cityjson.org/specs/2.0.1/#appearance-object - pictures are files beside; a ring that
has a texture names it and a texture vertex per corner, a ring without has null. Texture vertices
count from the lower left corner. A building whose polygons close a volume is a Solid, another a
MultiSurface. Vertices are integers of a millimetre, shared by all that touch.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

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
    text = json.dumps(textured(parts, crs, origin_m), separators=(",", ":"), allow_nan=False)
    write_bytes(path, text.encode())


def textured(
    parts: Sequence[TexturedPart], crs: str | None, origin_m: tuple[float, float, float]
) -> dict[str, Any]:
    """The CityJSON object of buildings about an origin in a CRS ("EPSG:25832")."""
    world = [one.part.positions_m.astype(np.float64) + one.offset_m + origin_m for one in parts]
    every = np.concatenate(world)
    low = np.floor(every.min(axis=0))
    steps = np.round((every - low) / GRID_M).astype(np.int64)
    vertices, vertex_of = np.unique(steps, axis=0, return_inverse=True)
    ends = np.cumsum([0, *(len(points) for points in world)])
    pictures = sorted({path for one in parts for path in one.pictures.values()})
    number_of = {path: number for number, path in enumerate(pictures)}
    texture_vertices: list[list[float]] = []
    objects = {}
    for row, one in enumerate(parts):
        own = vertex_of.reshape(-1)[ends[row] : ends[row + 1]]
        geometry = _geometry(one, own, number_of, texture_vertices)
        objects[one.part.id] = {
            "type": "Building",
            "attributes": dict(one.part.attributes),
            "geometry": [geometry],
        }
    metadata: dict[str, Any] = {
        "geographicalExtent": [*every.min(axis=0).tolist(), *every.max(axis=0).tolist()]
    }
    if crs is not None:
        authority, _, code = crs.partition(":")
        metadata["referenceSystem"] = f"https://www.opengis.net/def/crs/{authority}/0/{code}"
    document = {
        "type": "CityJSON",
        "version": "2.0",
        "metadata": metadata,
        "transform": {"scale": [GRID_M] * 3, "translate": low.tolist()},
        "CityObjects": objects,
        "vertices": vertices.tolist(),
    }
    if pictures:
        document["appearance"] = {
            "default-theme-texture": THEME,
            "textures": [_texture(path) for path in pictures],
            "vertices-texture": texture_vertices,
        }
    return document


def _texture(path: str) -> dict[str, str]:
    kind = "PNG" if path.lower().endswith(".png") else "JPG"
    return {"type": kind, "image": path, "wrapMode": "none", "textureType": "specific"}


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
            uv = part.uv[corners].astype(np.float64)
            flipped = np.column_stack([uv[:, 0], 1.0 - uv[:, 1]])
            texture_vertices += np.round(np.clip(flipped, 0.0, 1.0), 6).tolist()
            mapped.append([number_of[picture], *range(first, len(texture_vertices))])
        boundaries.append(rings)
        textures.append(mapped)
    closed = int(part.features.shell.max()) == 0 and _closed(boundaries)
    shape: dict[str, Any] = {
        "type": "Solid" if closed else "MultiSurface",
        "lod": level_of_detail(part),
        "boundaries": [boundaries] if closed else boundaries,
        "semantics": {"surfaces": surfaces, "values": [values] if closed else values},
    }
    if one.pictures:
        shape["texture"] = {THEME: {"values": [textures] if closed else textures}}
    return shape


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


def _closed(boundaries: Sequence[Sequence[Sequence[int]]]) -> bool:
    """Whether each edge is there once to and once fro."""
    ways = [np.column_stack([ring, [*ring[1:], ring[0]]]) for rings in boundaries for ring in rings]
    edges = np.concatenate(ways)
    there = {(a, b) for a, b in edges.tolist()}
    return len(there) == len(edges) and all((b, a) in there for a, b in there)
