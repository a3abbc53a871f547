"""Polygons in the binary form of OGC 06-103r4 (WKB), as GeoPackages hold them.

Read: Polygon and MultiPolygon, with and without heights and measures, in both byte orders and both
ways of marking heights (type + 1000, and the flag of EWKB). Measures are dropped.
"""

from __future__ import annotations

import struct

import numpy as np
from numpy.typing import NDArray

from veduta.grammar.rings import MAX_VERTICES, RingFault

POLYGON, MULTI_POLYGON = 3, 6
MAX_POLYGONS, MAX_RINGS = 10_000, 1000
_NAMES = {
    1: "Point",
    2: "LineString",
    4: "MultiPoint",
    5: "MultiLineString",
    7: "GeometryCollection",
    8: "CircularString",
    9: "CompoundCurve",
    10: "CurvePolygon",
    11: "MultiCurve",
    12: "MultiSurface",
}
_Z, _M, _SRID = 0x8000_0000, 0x4000_0000, 0x2000_0000
Rings = list[NDArray[np.float64]]


def polygons_of_wkb(content: bytes) -> tuple[list[Rings] | None, str]:
    """The polygons, each its rings of (n, 3) as they are written; None and the kind of others.

    RingFault where the bytes are no geometry.
    """
    reader = _Reader(content)
    try:
        kind, dimensions = reader.header()
        if kind == POLYGON:
            return [reader.polygon(dimensions)], "Polygon"
        if kind != MULTI_POLYGON:
            return None, _NAMES.get(kind, f"geometry of type {kind}")
        found = []
        for _ in range(reader.count(MAX_POLYGONS, "polygons")):
            part, dimensions = reader.header()
            if part != POLYGON:
                raise RingFault("a part of its MultiPolygon is no polygon")
            found.append(reader.polygon(dimensions))
    except struct.error as error:
        raise RingFault("its geometry ends too early") from error
    return found, "MultiPolygon"


class _Reader:
    """Where the reading is."""

    def __init__(self, content: bytes) -> None:
        self._content = content
        self._at = 0
        self._order = "<"

    def header(self) -> tuple[int, tuple[bool, bool]]:
        """The kind of the geometry that follows, and whether it has heights and measures."""
        order = self._take("B")
        if order not in (0, 1):
            raise RingFault("its geometry is no WKB")
        self._order = "<" if order else ">"
        code = self._take("I")
        if code & _SRID:
            self._take("I")
        plain = code & 0x0FFF_FFFF
        thousands = plain // 1000
        has_z = bool(code & _Z) or thousands in (1, 3)
        has_m = bool(code & _M) or thousands in (2, 3)
        return plain % 1000, (has_z, has_m)

    def count(self, most: int, what: str) -> int:
        """How many follow; RingFault where it is more than `most`."""
        number = self._take("I")
        if number > most:
            raise RingFault(f"has {number} {what}, more than {most}")
        return number

    def polygon(self, dimensions: tuple[bool, bool]) -> Rings:
        """The rings of a polygon after its header."""
        width = 2 + sum(dimensions)
        rings = []
        for _ in range(self.count(MAX_RINGS, "rings")):
            number = self.count(MAX_VERTICES, "points in a ring")
            end = self._at + 8 * width * number
            if end > len(self._content):
                raise struct.error("too short")
            flat = np.frombuffer(self._content[self._at : end], f"{self._order}f8")
            self._at = end
            points = flat.reshape(number, width).astype(np.float64)
            heights = points[:, 2:3] if dimensions[0] else np.zeros((number, 1))
            rings.append(np.concatenate([points[:, :2], heights], axis=1))
        return rings

    def _take(self, kind: str) -> int:
        (value,) = struct.unpack_from(self._order + kind, self._content, self._at)
        self._at += struct.calcsize(self._order + kind)
        return int(value)
