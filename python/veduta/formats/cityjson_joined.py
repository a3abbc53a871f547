"""CityJSON 2.0 of many buildings, joined from the lines of each (`cityjson_text`).

https://www.cityjson.org/specs/2.0.1/ - vertices that fall together are one, and so are equal
materials and pictures; where corners lie on pictures is counted on from building to building.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, TextIO

import numpy as np
from numpy.typing import NDArray

from veduta.formats import cityjson_frame as frame
from veduta.formats.cityjson_text import THEME

VERTICES = '"vertices":'
"""The last member of a line."""
VERTICES_AT_ONCE = 10_000


def write_joined(path: Path, first: Mapping[str, Any], pieces: Sequence[Path]) -> None:
    """Write CityJSON from files of lines: one list of vertices for all.

    The lines are read twice, one in memory at a time: for the vertices, and for the rest.
    """
    shared, number = _shared_vertices(pieces)
    looks = _Looks()
    head = frame.encoded(
        {name: value for name, value in first.items() if name not in ("CityObjects", "vertices")}
    ).decode()
    begin = 0
    with path.open("w", encoding="utf-8") as out:
        out.write(f'{head[:-1]},"CityObjects":{{')
        for line in _lines(pieces):
            feature = json.loads(line)
            own = number[begin : begin + len(feature["vertices"])].tolist()
            look = looks.add(feature.get("appearance", {}))
            for one in feature["CityObjects"].values():
                for geometry in one.get("geometry", ()):
                    geometry["boundaries"] = _renumbered(geometry["boundaries"], own)
                    look.renumber(geometry)
            text = json.dumps(feature["CityObjects"], separators=(",", ":"), allow_nan=False)
            out.write(f"{',' if begin else ''}{text[1:-1]}")
            begin += len(own)
        out.write('},"vertices":[')
        for row in range(0, len(shared), VERTICES_AT_ONCE):
            text = json.dumps(shared[row : row + VERTICES_AT_ONCE].tolist(), separators=(",", ":"))
            out.write(f"{',' if row else ''}{text[1:-1]}")
        out.write("]")
        _write_looks(out, looks)
        out.write("}")


class _Looks:
    """Materials and textures of all lines, each once, and where corners lie on pictures."""

    def __init__(self) -> None:
        self.materials: dict[str, int] = {}
        self.textures: dict[str, int] = {}
        self.corners: list[str] = []
        """Of each line as its text: a tenth of what the numbers take."""
        self._count = 0

    def add(self, appearance: Mapping[str, Any]) -> _OneLook:
        """What a line's own numbers are in the whole."""
        first = self._count
        if own := appearance.get("vertices-texture"):
            self.corners.append(json.dumps(own, separators=(",", ":"))[1:-1])
            self._count += len(own)
        return _OneLook(
            _numbers(self.materials, appearance.get("materials", ())),
            _numbers(self.textures, appearance.get("textures", ())),
            first,
        )


class _OneLook:
    """The numbers of a line's materials, textures and first corner in the whole."""

    def __init__(self, materials: list[int], textures: list[int], first_corner: int) -> None:
        self.materials, self.textures, self.first_corner = materials, textures, first_corner

    def renumber(self, geometry: dict[str, Any]) -> None:
        for theme in geometry.get("material", {}).values():
            theme["values"] = _renumbered(theme["values"], self.materials)
        for theme in geometry.get("texture", {}).values():
            theme["values"] = self._mapped(theme["values"])

    def _mapped(self, values: Any) -> Any:
        if isinstance(values[0], list):
            return [self._mapped(one) for one in values]
        if values[0] is None:
            return values
        return [self.textures[values[0]], *(one + self.first_corner for one in values[1:])]


def _numbers(known: dict[str, int], own: Iterable[Any]) -> list[int]:
    return [known.setdefault(json.dumps(one), len(known)) for one in own]


def _write_looks(out: TextIO, looks: _Looks) -> None:
    if not looks.materials:
        return
    out.write(f',"appearance":{{"default-theme-material":"{THEME}","materials":[')
    out.write(f"{','.join(looks.materials)}]")
    if looks.textures:
        out.write(f',"default-theme-texture":"{THEME}","textures":[{",".join(looks.textures)}]')
        out.write(',"vertices-texture":[')
        for number, text in enumerate(looks.corners):
            out.write(f"{',' if number else ''}{text}")
        out.write("]")
    out.write("}")


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
