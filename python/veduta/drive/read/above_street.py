"""How many scan points stand above street level along a path: few of them are a gap (section
3.1).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from veduta.drive.record import DriveRecord

_OVER_ROAD_M = 2.5
"""Cars and hedges are lower."""


def points_above_street(record: DriveRecord, line: NDArray[np.float64]) -> NDArray[np.int64] | None:
    """(c,) points of vertical scans at each station of a line (c, 3); None of full scans.

    A full scan sees a street far ahead: where it was taken says nothing of what stands there.
    """
    if record.full:
        return None
    tree = cKDTree(line[:, :2])
    found = np.zeros(len(line), dtype=np.int64)
    for sweep in record.sweeps:
        over = sweep.world_points()[:, 2] - (sweep.world_from_sensor[2, 3] - record.height_m)
        _, station = tree.query(sweep.world_from_sensor[:2, 3])
        found[int(station)] += int((over > _OVER_ROAD_M).sum())
    return found
