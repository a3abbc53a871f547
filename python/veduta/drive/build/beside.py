"""Which scans belong to a segment: only they are in memory while it is built."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from veduta.drive.build.pictures_of import read_shot
from veduta.drive.build.stereo_points import stereo_points
from veduta.drive.document.model import DriveSegment
from veduta.drive.options import DriveOptions
from veduta.drive.record import DriveRecord, Shot

_VERTICAL_M = 3.0
"""A vertical scan belongs to a segment that is so near to where it was taken."""
_LEVEL_M = 20.0
"""What level scans see farther away is off by more than interpolation is."""
_IMAGES_M = 12.0
"""Images taken so near to a segment give points of it."""
_FEWEST_IMAGES = 2


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


def others_beside(
    record: DriveRecord, segment: DriveSegment, options: DriveOptions
) -> NDArray[np.float64]:
    """(n, 3) what level scans and consecutive images show around a segment (m, world)."""
    tree = cKDTree(np.array(segment.line)[:, :2])
    found = [np.zeros((0, 3))]
    if options.others.level_scans and record.level:
        places = np.array([sweep.world_from_sensor[:2, 3] for sweep in record.level])
        for row in np.flatnonzero(tree.query(places)[0] <= _LEVEL_M).tolist():
            points = record.level[row].world_points()
            away = np.linalg.norm(points[:, :2] - places[row], axis=1)
            found.append(points[away <= _LEVEL_M])
    if options.others.stereo and len(record.shots) > _FEWEST_IMAGES:
        places = np.array([shot.world_from_cam[:2, 3] for shot in record.shots])
        near = np.flatnonzero(tree.query(places)[0] <= _IMAGES_M)
        found.append(_of_images([record.shots[row] for row in near.tolist()]))
    return np.concatenate(found)


def _of_images(shots: Sequence[Shot]) -> NDArray[np.float64]:
    """(n, 3) points of images in a row, three of them in memory at once."""
    found, frames = [np.zeros((0, 3))], [read_shot(shot) for shot in shots[:2]]
    for shot in shots[2:]:
        frames = [*frames[-2:], read_shot(shot)]
        found.append(stereo_points(frames))
    return np.concatenate(found)
