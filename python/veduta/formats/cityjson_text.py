"""CityJSON 2.0 and CityJSONSeq of derived buildings, from the texts of their geometry.

https://www.cityjson.org/specs/2.0.1/ and https://www.cityjson.org/cityjsonseq/ - each building is a
line of its own (`CityJSONFeature`) with its own vertices; a CityJSON file is all of them with
shared vertices. What rules leave is mostly open surfaces: a MultiSurface; what closes is a Solid.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from veduta.place.semantics import CITYJSON_SURFACE, SemanticClass

GRID_M = 1e-3
"""Vertices are whole millimetres."""
INSTALLATIONS = frozenset({SemanticClass.BALCONY, SemanticClass.CORNICE, SemanticClass.CHIMNEY})
CLASSES = [semantic.value for semantic in SemanticClass]
KINDS = ["" if one in INSTALLATIONS else CITYJSON_SURFACE[one] for one in SemanticClass]

Geometry = tuple[str, list[tuple[int, str, str]], str]
"""Of the building, of its installations (class, rule, geometry), and the vertices."""


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
    for name, (code, rule, text) in zip(children, installations, strict=True):
        about = {"class": CLASSES[code], "rule": rule}
        more = {"type": "BuildingInstallation", "parents": [building], "attributes": about}
        objects.append(_object(name, more, text))
    return (
        f'{{"type":"CityJSONFeature","id":{json.dumps(building)},'
        f'"CityObjects":{{{",".join(objects)}}},"vertices":{vertices}}}'
    )


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


def write_joined(path: Path, first: Mapping[str, Any], pieces: Iterable[Path]) -> None:
    """Write CityJSON from files of lines: one list of vertices for all."""
    objects: dict[str, Any] = {}
    vertices: list[np.ndarray[Any, np.dtype[np.int64]]] = []
    count = 0
    for piece in pieces:
        with piece.open(encoding="utf-8") as lines:
            for line in lines:
                feature = json.loads(line)
                for one in feature["CityObjects"].values():
                    for geometry in one.get("geometry", ()):
                        geometry["boundaries"] = _shifted(geometry["boundaries"], count)
                objects.update(feature["CityObjects"])
                vertices.append(np.array(feature["vertices"], dtype=np.int64))
                count += len(feature["vertices"])
    every = np.concatenate(vertices) if vertices else np.zeros((0, 3), dtype=np.int64)
    shared, number = np.unique(every, axis=0, return_inverse=True)
    renumbered = number.reshape(-1).tolist()
    for one in objects.values():
        for geometry in one.get("geometry", ()):
            geometry["boundaries"] = _renumbered(geometry["boundaries"], renumbered)
    whole = dict(first) | {"CityObjects": objects, "vertices": shared.tolist()}
    with path.open("w", encoding="utf-8") as out:
        out.write(json.dumps(whole, separators=(",", ":"), allow_nan=False))


def _shifted(boundaries: Any, by: int) -> Any:
    if boundaries and isinstance(boundaries[0], int):
        return [vertex + by for vertex in boundaries]
    return [_shifted(one, by) for one in boundaries]


def _renumbered(boundaries: Any, number: list[int]) -> Any:
    if boundaries and isinstance(boundaries[0], int):
        return [number[vertex] for vertex in boundaries]
    return [_renumbered(one, number) for one in boundaries]
