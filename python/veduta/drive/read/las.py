"""Scans as LAS or LAZ: only the points, in the scanner's frame (m)."""

from __future__ import annotations

from pathlib import Path

import laspy
import numpy as np
from numpy.typing import NDArray

from veduta.run.errors import InputError
from veduta.run.inputs import require_file

_MOST_BYTES, _MOST_POINTS = 1 << 30, 20_000_000


def read_las(path: Path) -> NDArray[np.float64]:
    """(n, 3) the points of a scan (m). InputError names what is wrong with the file."""
    require_file(path, _MOST_BYTES)
    try:
        with laspy.open(path) as file:
            if file.header.point_count > _MOST_POINTS:
                fault = f"has {file.header.point_count:,} points, too many for one scan"
                raise InputError(path, fault, "Give a file for each turn of the scanner.")
            points = file.read()
    except (laspy.errors.LaspyException, OSError, ValueError) as error:
        raise InputError(path, "is no LAS that can be read", "Copy it again.") from error
    if not len(points.points):
        raise InputError(path, "has no points", "Remove it.")
    return np.stack([points.x, points.y, points.z], axis=1).astype(np.float64)
