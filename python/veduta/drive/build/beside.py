"""Which scans belong to a segment: only they are in memory while it is built."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from veduta.drive.build.pictures_of import read_shot
from veduta.drive.build.stereo_points import stereo_points
from veduta.drive.document.model import DriveSegment
from veduta.drive.options import DriveOptions
from veduta.drive.record import DriveRecord, Shot


@dataclass(frozen=True)
class BesideParameters:
    """vertical_m: a vertical scan belongs to a segment that is so near to where it was taken.
    level_m: what level scans see farther away is off by more than interpolation is. images_m:
    images taken so near to a segment give points of it, where there are more than fewest_images.
    moving_m: scans that are nearer to each other are of a stop.
    """

    vertical_m: float = 3.0
    level_m: float = 20.0
    images_m: float = 12.0
    fewest_images: int = 2
    moving_m: float = 0.02


def column_spacing(
    record: DriveRecord, options: DriveOptions, parameters: BesideParameters | None = None
) -> float:
    """Metres between two columns: no less than the scans are apart, where they are vertical."""
    chosen = parameters or BesideParameters()
    wanted = options.columns.column_spacing_m
    if record.full or len(record.sweeps) < 2:
        return wanted
    steps = np.linalg.norm(np.diff(record.path()[:, :2], axis=0), axis=1)
    moving = steps[steps > chosen.moving_m]
    return max(wanted, float(np.median(moving))) if len(moving) else wanted


def points_beside(
    record: DriveRecord,
    segment: DriveSegment,
    options: DriveOptions,
    parameters: BesideParameters | None = None,
) -> NDArray[np.float64]:
    """(n, 3) the points of all sweeps that can have seen a segment (m, world)."""
    chosen = parameters or BesideParameters()
    full_m = options.columns.reach_m + options.columns.farthest_m
    reach = full_m if record.full else chosen.vertical_m
    line = np.array(segment.line)[:, :2]
    distance, _ = cKDTree(line).query(record.path()[:, :2])
    near = np.flatnonzero(distance <= reach)
    if not len(near):
        return np.zeros((0, 3))
    return np.concatenate([record.sweeps[row].world_points() for row in near.tolist()])


def others_beside(
    record: DriveRecord,
    segment: DriveSegment,
    options: DriveOptions,
    parameters: BesideParameters | None = None,
) -> NDArray[np.float64]:
    """(n, 3) what level scans and consecutive images show around a segment (m, world)."""
    chosen = parameters or BesideParameters()
    tree = cKDTree(np.array(segment.line)[:, :2])
    found = [np.zeros((0, 3))]
    if options.others.level_scans and record.level:
        places = np.array([sweep.world_from_sensor[:2, 3] for sweep in record.level])
        for row in np.flatnonzero(tree.query(places)[0] <= chosen.level_m).tolist():
            points = record.level[row].world_points()
            away = np.linalg.norm(points[:, :2] - places[row], axis=1)
            found.append(points[away <= chosen.level_m])
    if options.others.stereo and len(record.shots) > chosen.fewest_images:
        places = np.array([shot.world_from_cam[:2, 3] for shot in record.shots])
        near = np.flatnonzero(tree.query(places)[0] <= chosen.images_m)
        found.append(_of_images([record.shots[row] for row in near.tolist()]))
    return np.concatenate(found)


def _of_images(shots: Sequence[Shot]) -> NDArray[np.float64]:
    """(n, 3) points of images in a row, three of them in memory at once."""
    found, frames = [np.zeros((0, 3))], [read_shot(shot) for shot in shots[:2]]
    for shot in shots[2:]:
        frames = [*frames[-2:], read_shot(shot)]
        found.append(stereo_points(frames))
    return np.concatenate(found)
