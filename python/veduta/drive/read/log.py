"""What kind of log a folder is, and its reader."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from veduta.drive.read.clouds import is_clouds, read_clouds
from veduta.drive.read.kitti import is_kitti, read_kitti
from veduta.drive.read.kitti_raw import calibration_files, is_kitti_raw, read_kitti_raw
from veduta.drive.read.own import files_elsewhere, is_own, read_own
from veduta.drive.record import DriveRecord
from veduta.run.errors import InputError
from veduta.run.record import PRIVATE

_MOST_FILES = 200_000
TRUTH = "labels"
"""A folder of somebody's answers: it is no input."""


def read_log(
    folder: Path,
    seed: int,
    spacing_m: float = 0.0,
    told: Callable[[float], None] = lambda share: None,
    scratch: Path | None = None,
) -> DriveRecord:
    """The drive in a folder. spacing_m: of vertical scans. told: hears how far it is, 0 to 1.
    scratch: a folder for what is unpacked, which stays as long as the record is used.

    InputError where there is none that Veduta can read.
    """
    if not folder.is_dir():
        raise InputError(folder, "there is no such folder", "Name a folder with a drive in it.")
    if is_own(folder):
        return read_own(folder, seed, spacing_m, told, scratch)
    if is_kitti(folder):
        return read_kitti(folder, seed)
    if is_kitti_raw(folder):
        return read_kitti_raw(folder, seed)
    if is_clouds(folder):
        return read_clouds(folder, seed)
    raise InputError(
        folder,
        "has no drive that Veduta can read",
        "It reads folders with a drive.toml, the layouts of KITTI, and scans as PCD, LAS or LAZ.",
    )


def log_files(folder: Path) -> list[Path]:
    """The files that a result depends on, in order; none where there is no folder."""
    if not folder.is_dir():
        raise InputError(folder, "there is no such folder", "Name a folder with a drive in it.")
    found = sorted(
        path
        for path in folder.rglob("*")
        if path.is_file()
        and TRUTH not in path.relative_to(folder).parts
        and not any((parent / PRIVATE).is_dir() for parent in _between(path, folder))
    )
    if is_own(folder):
        found += files_elsewhere(folder)
    elif is_kitti_raw(folder):
        found += [
            path for path in calibration_files(folder) if path.parent != folder and path.is_file()
        ]
    if len(found) > _MOST_FILES:
        raise InputError(folder, f"has more than {_MOST_FILES} files", "Name one drive's folder.")
    return found


def _between(path: Path, folder: Path) -> list[Path]:
    """The folders from a file up to `folder`: what Veduta has made among them is no log."""
    above = list(path.parents)
    return above[: above.index(folder) + 1]
