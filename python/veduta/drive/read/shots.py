"""The images of a log: when they were taken, and from where."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta.drive.document.log import CameraMount
from veduta.drive.read.poses import poses_at
from veduta.drive.read.tables import read_table, time_column
from veduta.drive.record import Shot
from veduta.run.errors import InputError
from veduta.run.names import real_path

_LONGEST_NAME, _LONGEST_PATH = 255, 1024


def shots_of(
    folder: Path,
    camera: CameraMount,
    times: NDArray[np.float64],
    poses: NDArray[np.float64],
) -> tuple[tuple[Shot, ...], list[str]]:
    """Those whose files are there, with their places; and notes of what is missing.

    times, poses: (p,) s and (p, 3, 4) world_from_vehicle. InputError names the table.
    """
    path = folder / camera.table
    table = read_table(path, ("time_s", "file"))
    own = time_column(path, table) + camera.clock_offset_s
    mount = np.vstack([np.reshape(camera.vehicle_from_camera, (3, 4)), [0.0, 0.0, 0.0, 1.0]])
    places = poses_at(own, times, poses) @ mount
    shots, missing = [], 0
    for name, time_s, place in zip(table["file"].to_pylist(), own, places, strict=True):
        file = file_beside(path, str(name), "image")
        if not file.is_file():
            missing += 1
            continue
        shots.append(
            Shot(
                file.stem, file, float(time_s), camera.width_px, camera.height_px,
                camera.focal_px, camera.centre_px, place,
            )
        )  # fmt: skip
    notes = [f"{missing} of {len(own)} images are missing"] if missing else []
    return tuple(shots), notes


def file_beside(table: Path, name: str, what: str) -> Path:
    """A file that a table names, in the table's folder. InputError where it would be elsewhere."""
    if not _is_name(name):
        raise InputError(table, "has a name that no file has", f"Give the {what}s' names.")
    file = real_path(table.parent / name)
    if not file.is_relative_to(real_path(table.parent)):
        fault = f"names an {what} outside of the folder ({name})"
        raise InputError(table, fault, f"Put the {what}s beside the table.")
    return file


def _is_name(name: str) -> bool:
    """Whether a file may be called so: the system refuses to look for other names."""
    own = name.encode("utf-8", "replace")
    longest = max(len(part) for part in own.split(b"/"))
    return longest <= _LONGEST_NAME and len(own) <= _LONGEST_PATH and b"\0" not in own
