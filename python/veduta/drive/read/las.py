"""Scans as LAS or LAZ: only the points, in the scanner's frame (m)."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta.run.errors import InputError
from veduta.run.inputs import require_file
from veduta.run.limits import Limits, limited

_MOST_BYTES, _MOST_POINTS = 1 << 30, 20_000_000
_MOST_PACKED = 1000
"""How much smaller LAZ may be than LAS: of scans it is a tenth."""
_LIMITS = Limits(memory_mb=3000, seconds=120)
"""The largest one takes half of this."""


def read_las(path: Path) -> NDArray[np.float64]:
    """(n, 3) the points of a scan (m). InputError names what is wrong with the file."""
    return limited(_points, path, path, "Give a file for each turn of the scanner.", _LIMITS)


def _points(path: Path) -> NDArray[np.float64]:
    import laspy  # here, as only the process that reads needs them
    import lazrs

    require_file(path, _MOST_BYTES)
    try:
        with laspy.open(path) as file:
            _require_points(path, file.header.point_count, file.header.point_format.size)
            points = file.read()
    except (laspy.errors.LaspyException, lazrs.LazrsError, OSError, ValueError) as error:
        raise InputError(path, "is no LAS that can be read", "Copy it again.") from error
    if not len(points.points):
        raise InputError(path, "has no points", "Remove it.")
    return np.stack([points.x, points.y, points.z], axis=1).astype(np.float64)


def _require_points(path: Path, count: int, size: int) -> None:
    """Refuse more points than a scan has, or than there can be in a file of its length."""
    if count > _MOST_POINTS:
        fault = f"has {count:,} points, too many for one scan"
        raise InputError(path, fault, "Give a file for each turn of the scanner.")
    if count * size > _MOST_PACKED * path.stat().st_size:
        fault = f"says that it has {count:,} points, which is more than it can hold"
        raise InputError(path, fault, "Copy it again.")
