"""A folder of full scans without poses (PCD): the path comes from registering them."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta.drive.read.level import level_road
from veduta.drive.read.pcd import read_pcd
from veduta.drive.read.registration import register_scans
from veduta.drive.record import DriveRecord, Sweep
from veduta.run.errors import InputError

OWN_VEHICLE_M = 2.2
SCANS_A_SECOND = 10.0
"""Where nothing says when scans were taken."""


def is_clouds(folder: Path) -> bool:
    """Whether it has scans as PCD files."""
    return next(folder.glob("*.pcd"), None) is not None


def read_clouds(folder: Path, seed: int) -> DriveRecord:
    """The drive in a folder; x right and y forward at the first scan, z up from the road.

    Scanners have x forward and z up (ROS REP 103). InputError names the file that is broken.
    """
    scans = sorted(folder.glob("*.pcd"))
    if len(scans) < 2:
        raise InputError(folder, "has only one scan", "A drive has several scans (*.pcd).")
    reads = [_reader(path) for path in scans]
    names = [path.stem for path in scans]
    chain = register_scans(reads, names)
    turned = np.array([[0.0, -1, 0, 0], [1, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
    places = turned @ chain.world_from_sensor
    first = reads[0]() @ places[0][:3, :3].T + places[0][:3, 3]
    level = level_road(first, places[:1, :3, 3], seed)
    sweeps = tuple(
        Sweep(name, row / SCANS_A_SECOND, level.level_from_world @ places[row], read)
        for row, (name, read) in enumerate(zip(names, reads, strict=True))
    )
    notes = [
        f"the path comes from registering the scans: {100 * chain.share.min():.0f} to"
        f" {100 * chain.share[1:].max():.0f} % of their points match",
        "there are no images: nothing is textured",
    ]
    height_m = float(sweeps[0].world_from_sensor[2, 3])
    return DriveRecord(folder.name, sweeps, (), False, height_m, True, notes=tuple(notes),
                       path_from="registration of the scans")  # fmt: skip


def _reader(path: Path) -> Callable[[], NDArray[np.float64]]:
    def read() -> NDArray[np.float64]:
        points = read_pcd(path)
        with np.errstate(invalid="ignore"):
            kept = np.isfinite(points).all(axis=1)
            kept &= (points**2).sum(axis=1) > OWN_VEHICLE_M**2
        return np.asarray(points[kept], dtype=np.float64)

    return read
