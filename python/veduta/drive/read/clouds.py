"""A folder of full scans (PCD, LAS, LAZ): poses beside them, or the path comes from matching
them.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta.drive.read.kitti import lines_of, numbers_of
from veduta.drive.read.las import read_las
from veduta.drive.read.level import level_road
from veduta.drive.read.pcd import read_pcd
from veduta.drive.read.registration import register_scans
from veduta.drive.record import DriveRecord, Sweep
from veduta.run.errors import InputError

OWN_VEHICLE_M = 2.2
SCANS_A_SECOND = 10.0
"""Where nothing says when scans were taken."""


KINDS: dict[str, Callable[[Path], NDArray[np.float64]]] = {
    ".pcd": read_pcd, ".las": read_las, ".laz": read_las,
}  # fmt: skip
POSES = "poses.txt"
"""Where there is one: a line of twelve numbers (3x4 by rows, world_from_scanner) for each scan."""


def is_clouds(folder: Path) -> bool:
    """Whether it has scans as PCD, LAS or LAZ."""
    return any(path.suffix.lower() in KINDS for path in folder.iterdir())


def read_clouds(folder: Path, seed: int) -> DriveRecord:
    """The drive in a folder; x right and y forward at the first scan, z up from the road.

    Scanners have x forward and z up (ROS REP 103). InputError names the file that is broken;
    NotFoundError says where scans without poses match none.
    """
    scans = sorted(path for path in folder.iterdir() if path.suffix.lower() in KINDS)
    if len(scans) < 2:
        raise InputError(folder, "has only one scan", "A drive has several scans, a file each.")
    reads = [_reader(path) for path in scans]
    names = [path.stem for path in scans]
    given = (folder / POSES).is_file()
    if given:
        places = _poses(folder / POSES, len(scans))
        notes, path_from = [], "poses of the log"
    else:
        chain = register_scans(reads, names)
        turned = np.array([[0.0, -1, 0, 0], [1, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
        places = turned @ chain.world_from_sensor
        path_from = "registration of the scans"
        notes = [
            f"the path comes from registering the scans: {100 * chain.share.min():.0f} to"
            f" {100 * chain.share[1:].max():.0f} % of their points match"
        ]
    first = reads[0]() @ places[0][:3, :3].T + places[0][:3, 3]
    level = level_road(first, places[:1, :3, 3], seed)
    sweeps = tuple(
        Sweep(name, row / SCANS_A_SECOND, level.level_from_world @ places[row], read)
        for row, (name, read) in enumerate(zip(names, reads, strict=True))
    )
    notes.append("there are no images: nothing is textured")
    height_m = float(sweeps[0].world_from_sensor[2, 3])
    return DriveRecord(
        folder.name, sweeps, (), given, height_m, True, notes=tuple(notes), path_from=path_from
    )


def _poses(path: Path, count: int) -> NDArray[np.float64]:
    """(count, 4, 4) about the first position: surveyed coordinates are large."""
    rows = [numbers_of(line, path, number) for number, line in enumerate(lines_of(path), 1)]
    if len(rows) != count or any(len(row) != 12 for row in rows):
        fault = f"has not {count} lines of twelve numbers, one for each scan"
        raise InputError(path, fault, "Mend it, or remove it: scans are then matched.")
    places = np.tile(np.eye(4), (count, 1, 1))
    places[:, :3] = np.array(rows).reshape(-1, 3, 4)
    places[:, :3, 3] -= places[0, :3, 3].copy()
    return places


def _reader(path: Path) -> Callable[[], NDArray[np.float64]]:
    def read() -> NDArray[np.float64]:
        points = KINDS[path.suffix.lower()](path)
        with np.errstate(invalid="ignore"):
            kept = np.isfinite(points).all(axis=1)
            kept &= (points**2).sum(axis=1) > OWN_VEHICLE_M**2
        return np.asarray(points[kept], dtype=np.float64)

    return read
