"""Drives in the layout of KITTI raw: `velodyne_points`, `oxts`, `image_02`, and calibration beside.

Poses come from the inertial sensor with GPS (`oxts`), as KITTI's development kit has them: Mercator
scaled at the first latitude, then yaw, pitch and roll (Geiger et al. 2013).
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta.cameras.readers.kitti import calibration_rows
from veduta.drive.read.kitti import (
    beside_grey,
    image_size,
    lines_of,
    needed_matrix,
    numbers_of,
    read_velodyne,
    text_of,
)
from veduta.drive.read.level import level_road
from veduta.drive.record import DriveRecord, Shot, Sweep
from veduta.run.errors import InputError

_EARTH_M = 6_378_137.0
SCANS, POSES, PICTURES = "velodyne_points/data", "oxts/data", "image_02/data"
CALIBRATIONS = ("calib_imu_to_velo.txt", "calib_velo_to_cam.txt", "calib_cam_to_cam.txt")
SCANS_A_SECOND = 10.0


def is_kitti_raw(folder: Path) -> bool:
    """Whether it has scans and poses in that layout."""
    return (folder / SCANS).is_dir() and (folder / POSES).is_dir()


def calibration_files(folder: Path) -> list[Path]:
    """Where the calibration lies: in the drive's folder, or, as KITTI packs it, in the day's."""
    return [
        folder / name if (folder / name).is_file() else folder.parent / name
        for name in CALIBRATIONS
    ]


def read_kitti_raw(folder: Path, seed: int) -> DriveRecord:
    """The drive in a folder: x east, y north at the first scan, z up from the road.

    Scans without a pose are left out. InputError names the file that is missing or broken.
    """
    imu_file, velo_file, cam_file = calibration_files(folder)
    velo_from_imu = _rigid(_named(imu_file), imu_file)
    cam_from_velo = _rigid(_named(velo_file), velo_file)
    scans = {path.stem: path for path in sorted((folder / SCANS).glob("*.bin"))}
    oxts = {path.stem: path for path in sorted((folder / POSES).glob("*.txt"))}
    names = sorted(set(scans) & set(oxts))
    if len(names) < 2:
        raise InputError(folder / SCANS, "has not two scans with a pose", "Copy the drive again.")
    imu = _places([oxts[name] for name in names])
    velo = imu @ np.linalg.inv(velo_from_imu)
    turn, move = velo[0, :3, :3], velo[0, :3, 3]
    level = level_road(read_velodyne(scans[names[0]]) @ turn.T + move, velo[:1, :3, 3], seed)
    places = level.level_from_world @ velo
    sweeps = tuple(
        Sweep(name, row / SCANS_A_SECOND, places[row], _reader(scans[name]))
        for row, name in enumerate(names)
    )
    shots = _shots(folder, names, places @ np.linalg.inv(cam_from_velo), cam_file)
    notes = []
    if len(names) < len(scans):
        notes.append(f"{len(scans) - len(names)} scans have no pose and are left out")
    if not shots:
        notes.append(f"there are no images in {PICTURES}: nothing is textured")
    height_m = float(places[0, 2, 3])
    return DriveRecord(folder.name, sweeps, shots, True, height_m, True, notes=tuple(notes))


def _reader(path: Path) -> Callable[[], NDArray[np.float64]]:
    return lambda: read_velodyne(path)


def _places(files: list[Path]) -> NDArray[np.float64]:
    """(s, 4, 4) world_from_imu about the first position."""
    rows = [numbers_of(lines_of(path)[0], path, 1) if lines_of(path) else None for path in files]
    for path, row in zip(files, rows, strict=True):
        if row is None or len(row) < 6:
            raise InputError(path, "has not six numbers", "Copy it again.")
    values = np.array([row[:6] for row in rows if row is not None])
    latitude, longitude, height, roll, pitch, yaw = values.T
    scale = np.cos(np.deg2rad(latitude[0])) * _EARTH_M
    found = np.tile(np.eye(4), (len(values), 1, 1))
    found[:, 0, 3] = scale * np.deg2rad(longitude)
    found[:, 1, 3] = scale * np.log(np.tan(np.pi / 4 + np.deg2rad(latitude) / 2))
    found[:, 2, 3] = height
    found[:, :3, 3] -= found[0, :3, 3].copy()
    found[:, :3, :3] = _turns(yaw, 2) @ _turns(pitch, 1) @ _turns(roll, 0)
    return found


def _turns(angle: NDArray[np.float64], axis: int) -> NDArray[np.float64]:
    """(s, 3, 3) turns about an axis."""
    one, two = (axis + 1) % 3, (axis + 2) % 3
    found = np.tile(np.eye(3), (len(angle), 1, 1))
    found[:, one, one] = found[:, two, two] = np.cos(angle)
    found[:, two, one], found[:, one, two] = np.sin(angle), -np.sin(angle)
    return found


def _named(path: Path) -> dict[str, NDArray[np.float64]]:
    """The lines `name: numbers` of a calibration file."""
    found = {}
    for row in calibration_rows(text_of(path)):
        if row.words and row.key not in {None, "calib_time"}:
            found[str(row.key)] = numbers_of(" ".join(row.words), path, row.line)
    return found


def _of_size(
    named: dict[str, NDArray[np.float64]], name: str, size: int, path: Path
) -> NDArray[np.float64]:
    value = needed_matrix(named, name, path)
    if len(value) != size:
        fault = f"has {len(value)} numbers in {name!r} and not {size}"
        raise InputError(path, fault, "Copy KITTI's own calibration file.")
    return value


def _rigid(named: dict[str, NDArray[np.float64]], path: Path) -> NDArray[np.float64]:
    found = np.eye(4)
    found[:3, :3] = _of_size(named, "R", 9, path).reshape(3, 3)
    found[:3, 3] = _of_size(named, "T", 3, path)
    return found


def _shots(
    folder: Path, names: list[str], world_from_cam: NDArray[np.float64], path: Path
) -> tuple[Shot, ...]:
    """The left colour images. world_from_cam: of the grey camera before it was rectified."""
    if not (folder / PICTURES).is_dir():
        return ()
    named = _named(path)
    matrix = _of_size(named, "P_rect_02", 12, path).reshape(3, 4)
    rectified = np.eye(4)
    rectified[:3, :3] = _of_size(named, "R_rect_00", 9, path).reshape(3, 3)
    beside = np.linalg.inv(rectified) @ beside_grey(matrix, path)
    centre = (float(matrix[0, 2]) + 0.5, float(matrix[1, 2]) + 0.5)
    focal = (float(matrix[0, 0]), float(matrix[1, 1]))
    shots = []
    for row, name in enumerate(names):
        image = folder / PICTURES / f"{name}.png"
        if image.is_file():
            width, height = image_size(image)
            place = world_from_cam[row] @ beside
            time_s = row / SCANS_A_SECOND
            shots.append(Shot(name, image, time_s, width, height, focal, centre, place))
    return tuple(shots)
