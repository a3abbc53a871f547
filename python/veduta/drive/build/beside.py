"""Which scans belong to a segment: only they are in memory while it is built."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from veduta.drive.document.model import DriveSegment
from veduta.drive.options import DriveOptions
from veduta.drive.record import DriveRecord

_VERTICAL_M = 3.0
"""A vertical scan belongs to a segment that is so near to where it was taken."""


def column_spacing(record: DriveRecord, options: DriveOptions) -> float:
    """Metres between two columns: no less than the scans are apart, where they are vertical."""
    wanted = options.columns.column_spacing_m
    if record.full or len(record.sweeps) < 2:
        return wanted
    steps = np.linalg.norm(np.diff(record.path()[:, :2], axis=0), axis=1)
    moving = steps[steps > 0.02]
    return max(wanted, float(np.median(moving))) if len(moving) else wanted


def points_beside(
    record: DriveRecord, segment: DriveSegment, options: DriveOptions
) -> NDArray[np.float64]:
    """(n, 3) the points of all sweeps that can have seen a segment (m, world)."""
    reach = options.columns.reach_m + options.columns.farthest_m if record.full else _VERTICAL_M
    line = np.array(segment.line)[:, :2]
    distance, _ = cKDTree(line).query(record.path()[:, :2])
    near = np.flatnonzero(distance <= reach)
    if not len(near):
        return np.zeros((0, 3))
    return np.concatenate([record.sweeps[row].world_points() for row in near.tolist()])
