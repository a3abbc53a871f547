"""A place as binary STL: triangles alone, z up, in metres (STL itself knows no unit).

Written by hand: a record of fifty bytes a triangle, part by part, so that a town needs the memory
of its largest part; trimesh would hold all of it.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from veduta.formats.shapes import shapes
from veduta.place.place import Place
from veduta.run.atomic import atomic_write

_ROW = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
_HEADER_BYTES = 80


def write_stl(place: Place, path: Path) -> None:
    """Write all triangles, part by part."""
    count = 0
    unit = "metres" if place.scale == "metres" else "unit of length unknown"
    with atomic_write(path) as temporary, temporary.open("wb") as file:
        file.write(f"Veduta, z up, {unit}".encode().ljust(_HEADER_BYTES) + bytes(4))
        for shape in shapes(place, drawn_only=False):
            own = shape.triangles
            corners = own.positions_m[own.corners]
            normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
            length = np.linalg.norm(normal, axis=1, keepdims=True)
            rows = np.zeros(len(corners), dtype=_ROW)
            rows["normal"] = normal / np.where(length > 0.0, length, 1.0)
            rows["corners"] = corners
            file.write(rows.tobytes())
            count += len(rows)
        file.seek(_HEADER_BYTES)
        file.write(np.uint32(count).tobytes())
