"""Logs with a `drive.toml` and a 3D scanner: full scans as files, or as PointCloud2 of a bag."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta.drive.document.log import DriveLog, FullScanner
from veduta.drive.read.las import read_las
from veduta.drive.read.level import level_road
from veduta.drive.read.pcd import read_pcd
from veduta.drive.read.poses import poses_at, poses_of
from veduta.drive.read.registration import register_scans
from veduta.drive.read.shots import file_beside, shots_of
from veduta.drive.read.tables import read_table, time_column
from veduta.drive.record import DriveRecord, Shot, Sweep
from veduta.run.errors import InputError

_AHEAD = np.array([[0.0, -1, 0, 0], [1, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
"""The first scan looks north where nothing says to where it does."""
_MOST_BYTES = 512 << 20
Read = Callable[[], NDArray[np.float64]]


def read_full(
    source: Path, log: DriveLog, scanner: FullScanner, seed: int, before: tuple[str, ...]
) -> DriveRecord:
    """source: where the tables lie. Without a [path] the scans are registered onto each other.
    before: notes of what was done to the log until now.

    InputError names the file; NotFoundError says where scans without poses match none.
    """
    path, notes = source / scanner.table, [*before]
    table = read_table(path, ("time_s", "file"))
    own = time_column(path, table) + scanner.clock_offset_s
    order = np.argsort(own, kind="stable")
    files = [file_beside(path, str(name), "scan") for name in table["file"].to_pylist()]
    there = np.array([files[row].is_file() for row in order.tolist()], dtype=bool)
    if not there.all():
        notes.append(f"{int((~there).sum())} of {len(files)} scans are missing")
    order = order[there]
    mount = np.vstack([np.reshape(scanner.vehicle_from_scanner, (3, 4)), [0.0, 0.0, 0.0, 1.0]])
    if log.path is not None:
        times, poses = poses_of(source / log.path.table)
        inside = (own[order] >= times[0]) & (own[order] <= times[-1])
        if not inside.all():
            notes.append(f"{int((~inside).sum())} scans before or after the path are left out")
        order = order[inside]
    if len(order) < 2:
        fault = "has not two scans within the times of the path"
        raise InputError(path, fault, "Check the files and clock_offset_s.")
    reads = [_reader(files[row], scanner) for row in order.tolist()]
    names = [files[row].stem for row in order.tolist()]
    if log.path is not None:
        places, path_from = poses_at(own[order], times, poses) @ mount, "poses of the log"
        height_m = float(scanner.vehicle_from_scanner[11])
    else:
        chain = register_scans(reads, names)
        places = _AHEAD @ chain.world_from_sensor
        first = reads[0]() @ places[0][:3, :3].T + places[0][:3, 3]
        places = level_road(first, places[:1, :3, 3], seed).level_from_world @ places
        times, poses = own[order], (places @ np.linalg.inv(mount))[:, :3]
        path_from, height_m = "registration of the scans", float(places[0, 2, 3])
        notes.append(f"the path comes from {path_from}")
    sweeps = tuple(
        Sweep(name, float(own[row]), place, read)
        for name, row, place, read in zip(names, order.tolist(), places, reads, strict=True)
    )
    shots: tuple[Shot, ...] = ()
    if log.camera is not None:
        shots, missing = shots_of(source, log.camera, times, poses)
        notes += missing
    return DriveRecord(
        log.name, sweeps, shots, log.path is not None, height_m, True, log.crs, log.origin,
        tuple(notes), path_from, vertical_datum=log.vertical_datum,
    )  # fmt: skip


def _reader(path: Path, scanner: FullScanner) -> Read:
    suffix = path.suffix.lower()
    kinds: dict[str, Callable[[Path], NDArray[np.float64]]] = {
        ".pcd": read_pcd, ".las": read_las, ".laz": read_las, ".npy": _read_array,
    }  # fmt: skip
    if suffix not in kinds:
        fault = f"is no scan that can be read ({suffix or 'no suffix'})"
        raise InputError(path, fault, "Give .pcd, .las, .laz, or .npy of (n, 3) numbers.")

    def read() -> NDArray[np.float64]:
        points = kinds[suffix](path)
        with np.errstate(invalid="ignore", over="ignore"):
            away = np.sqrt((points**2).sum(axis=1))
            kept = (away >= scanner.nearest_m) & (away < scanner.farthest_m)
        return np.asarray(points[kept], dtype=np.float64)

    return read


def _read_array(path: Path) -> NDArray[np.float64]:
    if path.stat().st_size > _MOST_BYTES:
        raise InputError(path, "is far too large for one scan", "Give each scan a file.")
    try:
        points = np.load(path, allow_pickle=False)
    except (ValueError, EOFError, OSError) as error:
        raise InputError(path, "is no array of numpy", "Write it again (numpy.save).") from error
    if points.ndim != 2 or points.shape[1] != 3 or points.dtype.kind != "f":
        fault = f"has the shape {points.shape} of {points.dtype}, not (n, 3) of floats"
        raise InputError(path, fault, "Give x, y and z of each point.")
    return np.asarray(points, dtype=np.float64)
