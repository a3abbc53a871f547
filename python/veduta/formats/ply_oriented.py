"""Points with normals, colours and how many photos show each, as PLY (binary, little-endian)."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

_REAL, _SMALL = ("x", "y", "z", "nx", "ny", "nz"), ("red", "green", "blue", "views")
_AT_ONCE = 500_000
_ROW = np.dtype([*((name, "<f4") for name in _REAL), *((name, "u1") for name in _SMALL)])


def write_oriented_points(
    path: Path,
    points: NDArray[np.float64],
    normals: NDArray[np.float32],
    colours: NDArray[np.uint8],
    views: NDArray[np.uint8],
) -> None:
    """Write (n, 3) points, (n, 3) unit normals, (n, 3) sRGB colours and (n,) numbers of views."""
    properties = "".join(f"property float {name}\n" for name in _REAL)
    properties += "".join(f"property uchar {name}\n" for name in _SMALL)
    head = f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\n{properties}"
    with path.open("wb") as file:
        file.write(f"{head}end_header\n".encode("ascii"))
        for first in range(0, len(points), _AT_ONCE):
            some = slice(first, first + _AT_ONCE)
            file.write(_rows(points[some], normals[some], colours[some], views[some]).tobytes())


def _rows(
    points: NDArray[np.float64],
    normals: NDArray[np.float32],
    colours: NDArray[np.uint8],
    views: NDArray[np.uint8],
) -> NDArray[np.void]:
    rows = np.empty(len(points), dtype=_ROW)
    for axis, name in enumerate(("x", "y", "z")):
        rows[name] = points[:, axis]
        rows[f"n{name}"] = normals[:, axis]
    for channel, name in enumerate(("red", "green", "blue")):
        rows[name] = colours[:, channel]
    rows["views"] = views
    return rows
