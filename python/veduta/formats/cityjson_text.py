"""CityJSON 2.0 and CityJSONSeq of derived buildings, from the texts of their geometry.

https://www.cityjson.org/specs/2.0.1/ and https://www.cityjson.org/cityjsonseq/ - each building is a
line of its own (`CityJSONFeature`) with its own vertices; a CityJSON file is all of them with
shared vertices. What rules leave is mostly open surfaces: a MultiSurface; what closes is a Solid.
A building seen from afar gives closed volumes, which stand beside it as LoD 1.2 and 2.2.
"""

from __future__ import annotations

import json
import math
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from veduta.place.semantics import CITYJSON_SURFACE, Provenance, SemanticClass

FORM = re.compile(r'\{"type":"(Solid|MultiSurface)","lod":"([0-9.]+)"')
VERTICES = '"vertices":'
"""The last member of a line."""
VERTICES_AT_ONCE = 10_000
GRID_M = 1e-3
"""Vertices are whole millimetres."""
INSTALLATIONS = frozenset({SemanticClass.BALCONY, SemanticClass.CORNICE, SemanticClass.CHIMNEY})
CLASSES = [semantic.value for semantic in SemanticClass]
KINDS = ["" if one in INSTALLATIONS else CITYJSON_SURFACE[one] for one in SemanticClass]

Geometry = tuple[str, list[tuple[int, str, str, str]], str]
"""Of the building, of its installations (class, rule, colour, geometry), and the vertices."""


def feature_line(building: str, attributes: Mapping[str, Any], geometry: Geometry) -> str | None:
    """The line of a building; None where it has no surface."""
    body, installations, vertices = geometry
    if not body and not installations:
        return None
    children = [f"{building}/{number}" for number in range(len(installations))]
    objects = [
        _object(
            building,
            {"type": "Building", "attributes": dict(attributes)}
            | ({"children": children} if children else {}),
            body,
        )
    ]
    for name, (code, rule, colour, text) in zip(children, installations, strict=True):
        about = {"class": CLASSES[code], "rule": rule, "colour": colour}
        more = {"type": "BuildingInstallation", "parents": [building], "attributes": about}
        objects.append(_object(name, more, text))
    return (
        f'{{"type":"CityJSONFeature","id":{json.dumps(building)},'
        f'"CityObjects":{{{",".join(objects)}}},"vertices":{vertices}}}'
    )


def relief_line(name: str, points_m: NDArray[np.float64], triangles: NDArray[np.int32]) -> str:
    """The line of invented ground: (n, 3) points about the origin and (m, 3) triangles.

    Corners that fall into one on the grid are one; a triangle without area is left out.
    """
    used = np.round(points_m[triangles].reshape(-1, 3) / GRID_M).astype(np.int64)
    vertices, corners = np.unique(used, axis=0, return_inverse=True)
    faces = corners.reshape(-1, 3)
    a, b, c = (faces[:, k] for k in range(3))
    faces = faces[(a != b) & (b != c) & (c != a)]
    surface = {"type": "CompositeSurface", "lod": "1", "boundaries": faces[:, None].tolist()}
    about = {"type": "TINRelief", "attributes": {"provenance": Provenance.INVENTED.value}}
    text = _object(name, about, json.dumps(surface, separators=(",", ":")))
    return (
        f'{{"type":"CityJSONFeature","id":{json.dumps(name)},"CityObjects":{{{text}}},'
        f'"vertices":{json.dumps(vertices.tolist(), separators=(",", ":"))}}}'
    )


def forms_of(geometry: Geometry) -> list[str]:
    """What the geometries of a building itself are: `MultiSurface 3`, `Solid 2.2`."""
    return [f"{kind} {lod}" for kind, lod in FORM.findall(geometry[0])]


def _object(name: str, record: Mapping[str, Any], geometry: str) -> str:
    text = json.dumps(record, separators=(",", ":"), allow_nan=False)
    shape = f',"geometry":[{geometry}]' if geometry else ""
    return f"{json.dumps(name)}:{text[:-1]}{shape}}}"


def header(title: str, crs: str | None, origin_m: Sequence[float]) -> dict[str, Any]:
    """The first line of a sequence: the frame of all features."""
    metadata: dict[str, Any] = {"title": title}
    if crs is not None:
        code = crs.rpartition(":")[2]
        metadata["referenceSystem"] = f"https://www.opengis.net/def/crs/EPSG/0/{code}"
    return {
        "type": "CityJSON",
        "version": "2.0",
        "metadata": metadata,
        "transform": {"scale": [GRID_M] * 3, "translate": list(origin_m)},
        "CityObjects": {},
        "vertices": [],
    }


def write_sequence(path: Path, first: Mapping[str, Any], pieces: Iterable[Path]) -> None:
    """Write CityJSONSeq from files of lines, a line at a time in memory."""
    with path.open("w", encoding="utf-8", newline="\n") as out:
        out.write(json.dumps(first, separators=(",", ":"), allow_nan=False) + "\n")
        for piece in pieces:
            with piece.open(encoding="utf-8") as lines:
                out.writelines(lines)


def write_joined(path: Path, first: Mapping[str, Any], pieces: Sequence[Path]) -> None:
    """Write CityJSON from files of lines: one list of vertices for all.

    The lines are read twice, one in memory at a time: for the vertices, and for the rest.
    """
    shared, number = _shared_vertices(pieces)
    head = json.dumps(
        {name: value for name, value in first.items() if name not in ("CityObjects", "vertices")},
        separators=(",", ":"),
        allow_nan=False,
    )
    begin = 0
    with path.open("w", encoding="utf-8") as out:
        out.write(f'{head[:-1]},"CityObjects":{{')
        for line in _lines(pieces):
            feature = json.loads(line)
            own = number[begin : begin + len(feature["vertices"])].tolist()
            for one in feature["CityObjects"].values():
                for geometry in one.get("geometry", ()):
                    geometry["boundaries"] = _renumbered(geometry["boundaries"], own)
            text = json.dumps(feature["CityObjects"], separators=(",", ":"), allow_nan=False)
            out.write(f"{',' if begin else ''}{text[1:-1]}")
            begin += len(own)
        out.write('},"vertices":[')
        for row in range(0, len(shared), VERTICES_AT_ONCE):
            text = json.dumps(shared[row : row + VERTICES_AT_ONCE].tolist(), separators=(",", ":"))
            out.write(f"{',' if row else ''}{text[1:-1]}")
        out.write("]}")


def _lines(pieces: Iterable[Path]) -> Iterator[str]:
    for piece in pieces:
        with piece.open(encoding="utf-8") as lines:
            yield from lines


def _shared_vertices(pieces: Iterable[Path]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """The distinct vertices (n, 3) in order, and the number of each one of the lines there."""
    found: list[NDArray[np.int64]] = []
    for line in _lines(pieces):
        own = line.rstrip()[line.rindex(VERTICES) + len(VERTICES) : -1]
        found.append(np.array(json.loads(own), dtype=np.int64).reshape(-1, 3))
    if not found:
        return np.zeros((0, 3), dtype=np.int64), np.zeros(0, dtype=np.int64)
    every = np.concatenate(found)
    found.clear()
    low = every.min(axis=0)
    spans = [int(span) + 1 for span in every.max(axis=0) - low]
    if math.prod(spans) >= 2**63:
        distinct, number = np.unique(every, axis=0, return_inverse=True)
        return distinct, number.reshape(-1)
    # One number for the three of a vertex, in the same order: a third of the memory.
    every -= low
    packed = (every[:, 0] * spans[1] + every[:, 1]) * spans[2] + every[:, 2]
    del every
    keys, number = np.unique(packed, return_inverse=True)
    rest, z = np.divmod(keys, spans[2])
    x, y = np.divmod(rest, spans[1])
    return np.column_stack([x, y, z]) + low, number


def _renumbered(boundaries: Any, number: list[int]) -> Any:
    if boundaries and isinstance(boundaries[0], int):
        return [number[vertex] for vertex in boundaries]
    return [_renumbered(one, number) for one in boundaries]
