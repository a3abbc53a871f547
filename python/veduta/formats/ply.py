"""Points with colours as PLY (binary, little-endian), which every point viewer reads."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

_ROW = np.dtype(
    [("x", "<f4"), ("y", "<f4"), ("z", "<f4"), ("red", "u1"), ("green", "u1"), ("blue", "u1")]
)


def write_points(points: NDArray[np.float64], colours: NDArray[np.uint8], path: Path) -> None:
    """Write (n, 3) points and their (n, 3) sRGB colours."""
    rows = np.empty(len(points), dtype=_ROW)
    for axis, name in enumerate(("x", "y", "z")):
        rows[name] = points[:, axis]
    for channel, name in enumerate(("red", "green", "blue")):
        rows[name] = colours[:, channel]
    header = (
        "ply\nformat binary_little_endian 1.0\n"
        f"element vertex {len(rows)}\n"
        "property float x\nproperty float y\nproperty float z\n"
        "property uchar red\nproperty uchar green\nproperty uchar blue\n"
        "end_header\n"
    )
    path.write_bytes(header.encode("ascii") + rows.tobytes())
