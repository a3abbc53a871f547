"""Folders in the layout of KITTI odometry: `velodyne/*.bin`, `poses.txt`, `calib.txt`, `image_2`.

Poses take the left grey camera to its place at the start (x right, y down, z forward); `Tr` takes
the scanner to that camera (Geiger et al. 2012). `labels/` is somebody's truth and never read.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image, UnidentifiedImageError

from veduta.cameras.readers.kitti import calibration_rows
from veduta.drive.read.level import level_road
from veduta.drive.record import DriveRecord, Shot, Sweep
from veduta.run.errors import InputError

SCANS, POSES, CALIBRATION, TIMES, PICTURES = (
    "velodyne", "poses.txt", "calib.txt", "times.txt", "image_2",
)  # fmt: skip
_WORLD_FROM_START = np.array([[1.0, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]])
"""KITTI's start camera looks along z; here x is right, y forward, z up."""
OWN_VEHICLE_M = 2.2
"""Nearer points are of the vehicle itself, or of dust on the scanner."""
_MOST_BYTES = 64 << 20
_POINT_BYTES = 16


def is_kitti(folder: Path) -> bool:
    """Whether it has scans and poses in that layout."""
    return (folder / SCANS).is_dir() and (folder / CALIBRATION).is_file()


def read_kitti(folder: Path, seed: int) -> DriveRecord:
    """The drive in a folder, levelled: x right and y forward at the start, z up from the road.

    InputError names the file that is missing or broken.
    """
    calibration = _calibration(folder / CALIBRATION)
    cam_from_sensor = _square(needed_matrix(calibration, "Tr", folder / CALIBRATION))
    scans = sorted((folder / SCANS).glob("*.bin"))
    if not scans:
        raise InputError(folder / SCANS, "has no scans (*.bin)", "Name a folder that has some.")
    poses = _poses(folder / POSES, len(scans))
    times = _times(folder / TIMES, len(scans))
    places = [_WORLD_FROM_START @ pose @ cam_from_sensor for pose in poses]
    first = read_velodyne(scans[0])
    path = np.array([place[:3, 3] for place in places])
    level = level_road(first @ places[0][:3, :3].T + places[0][:3, 3], path[:1], seed)
    sweeps = tuple(
        Sweep(scan.stem, float(times[row]), level.level_from_world @ places[row], _reader(scan))
        for row, scan in enumerate(scans)
    )
    world_from_cam = [level.level_from_world @ _WORLD_FROM_START @ pose for pose in poses]
    shots = _shots(folder, calibration, [scan.stem for scan in scans], world_from_cam, times)
    notes = [] if level.share else ["no road was found under the first scan: z is only lifted"]
    if not shots:
        notes.append(f"there are no images in {PICTURES}: nothing is textured")
    height_m = float(sweeps[0].world_from_sensor[2, 3])
    return DriveRecord(folder.name, sweeps, shots, True, height_m, True, notes=tuple(notes))


def _reader(path: Path) -> Callable[[], NDArray[np.float64]]:
    return lambda: read_velodyne(path)


def read_velodyne(path: Path) -> NDArray[np.float64]:
    """(n, 3) the usable points of a scan (m, sensor frame)."""
    size = path.stat().st_size
    if size > _MOST_BYTES or size % _POINT_BYTES:
        fault = f"is no scan of x, y, z, reflectance as 32-bit floats ({size} bytes)"
        raise InputError(path, fault, "Copy it again, or remove it with its pose.")
    rows = np.fromfile(path, dtype="<f4").reshape(-1, 4)[:, :3].astype(np.float64)
    kept = np.isfinite(rows).all(axis=1)
    kept &= np.einsum("ij,ij->i", rows, rows) > OWN_VEHICLE_M**2
    return np.asarray(rows[kept], dtype=np.float64)


def _calibration(path: Path) -> dict[str, NDArray[np.float64]]:
    found = {}
    for row in calibration_rows(text_of(path)):
        if row.key is not None and row.words:
            values = numbers_of(" ".join(row.words), path, row.line)
            if len(values) == 12:
                found[row.key] = values.reshape(3, 4)
    return found


def needed_matrix(
    calibration: dict[str, NDArray[np.float64]], name: str, path: Path
) -> NDArray[np.float64]:
    """A matrix of a calibration file, by its name."""
    if name not in calibration:
        fault = f"has no line {name!r} with twelve numbers"
        raise InputError(path, fault, "KITTI's own calibration files have it: add it.")
    return calibration[name]


def _poses(path: Path, count: int) -> list[NDArray[np.float64]]:
    rows = [numbers_of(line, path, number) for number, line in enumerate(lines_of(path), 1)]
    for number, row in enumerate(rows, 1):
        if len(row) != 12:
            fault = f"line {number} has {len(row)} numbers and not twelve"
            raise InputError(path, fault, "Each line is a 3x4 matrix, row by row.")
    if len(rows) != count:
        fault = f"has {len(rows)} poses for {count} scans"
        raise InputError(path, fault, "Give one pose for each scan.")
    return [_square(row.reshape(3, 4)) for row in rows]


def _times(path: Path, count: int) -> NDArray[np.float64]:
    """(count,) seconds; ten a second where there is no file, as KITTI's scanner turns."""
    if not path.is_file():
        return np.asarray(np.arange(count) * 0.1, dtype=np.float64)
    values = [float(numbers_of(line, path, row)[0]) for row, line in enumerate(lines_of(path), 1)]
    if len(values) < count:
        fault = f"has {len(values)} times for {count} scans"
        raise InputError(path, fault, "Give one time for each scan, or remove the file.")
    return np.array(values[:count])


def _shots(
    folder: Path,
    calibration: dict[str, NDArray[np.float64]],
    names: list[str],
    world_from_cam: list[NDArray[np.float64]],
    times: NDArray[np.float64],
) -> tuple[Shot, ...]:
    if not (folder / PICTURES).is_dir():
        return ()
    matrix = needed_matrix(calibration, "P2", folder / CALIBRATION)
    beside = beside_grey(matrix, folder / CALIBRATION)
    shots = []
    for row, name in enumerate(names):
        path = next(
            (p for end in ("png", "jpg") if (p := folder / PICTURES / f"{name}.{end}").is_file()),
            None,
        )
        if path is None:
            continue
        width, height = image_size(path)
        # KITTI counts pixels from the centre of the first: half a pixel less than here.
        centre = (float(matrix[0, 2]) + 0.5, float(matrix[1, 2]) + 0.5)
        focal = (float(matrix[0, 0]), float(matrix[1, 1]))
        place = world_from_cam[row] @ beside
        shots.append(Shot(name, path, float(times[row]), width, height, focal, centre, place))
    return tuple(shots)


def beside_grey(matrix: NDArray[np.float64], path: Path) -> NDArray[np.float64]:
    """(4, 4) grey_from_colour of a projection P2 = K [I | t] (3, 4): beside it, the same way
    round.
    """
    beside = np.eye(4)
    try:
        beside[:3, 3] = -np.linalg.solve(matrix[:, :3], matrix[:, 3])
    except np.linalg.LinAlgError:
        beside[:3, 3] = np.nan
    if not (np.isfinite(beside).all() and matrix[0, 0] > 0.0 and matrix[1, 1] > 0.0):
        fault = "the projection of the colour camera is not the matrix of a camera"
        raise InputError(path, fault, "Copy KITTI's own calibration file.")
    return beside


def image_size(path: Path) -> tuple[int, int]:
    """Width and height (px)."""
    try:
        with Image.open(path) as image:
            return image.size
    except (UnidentifiedImageError, OSError) as error:
        raise InputError(path, "is no image that can be read", "Copy it again.") from error


def _square(matrix: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.vstack([matrix, [0.0, 0.0, 0.0, 1.0]])


def lines_of(path: Path) -> list[str]:
    """Its lines that are not empty."""
    return [line for line in text_of(path).splitlines() if line.strip()]


def text_of(path: Path) -> str:
    """A file of the layout as text."""
    if not path.is_file():
        raise InputError(path, "there is no such file", "The layout of KITTI odometry needs it.")
    try:
        return path.read_text(encoding="utf-8")
    except UnicodeDecodeError as error:
        raise InputError(path, "is no text", "Copy it again.") from error


def numbers_of(text: str, path: Path, line: int) -> NDArray[np.float64]:
    """The finite numbers of a line."""
    try:
        values = np.array([float(word) for word in text.split()])
    except ValueError as error:
        raise InputError(path, f"line {line} is not numbers", "Copy the file again.") from error
    if not len(values) or not np.isfinite(values).all():
        raise InputError(path, f"line {line} has a value that is no number", "Mend that line.")
    return values
