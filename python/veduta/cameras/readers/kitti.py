"""Cameras of KITTI's sequences: `calib.txt`, `poses.txt` and the folders of pictures.

calib.txt has a line of 12 numbers for each camera, with keys (`P0:` to `P3:`) or without, in that
order. poses.txt has a line of 12 for each frame of the sequence, the first camera's place in the
first one's frame; the number in a picture's name is its frame. Metres; up is -y.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta.cameras.camera import Camera, CameraSet
from veduta.cameras.files import COPY_AGAIN, lines_of, numbers, read_text
from veduta.cameras.pictures import require_one_size
from veduta.cameras.projection import nearest_turn, part_projection
from veduta.imaging.read import SUFFIXES, image_size
from veduta.run.errors import InputError

Floats = NDArray[np.float64]
CALIB = "calib.txt"
FOLDERS = {
    **{f"image_{number}": number for number in range(4)},
    **{f"image_0{number}": number for number in range(4)},
    "image_l": 0,
    "image_r": 1,
}
"""The folders of pictures, and the cameras that took them."""
_LAYOUT = "Give a folder with calib.txt, poses.txt and image_2 (or image_0, image_l and the like)."
_UP = (0.0, -1.0, 0.0)
_PROJECTION = re.compile(r"P(?:_rect_)?0?(\d)")


def find(folder: Path) -> Path | None:
    """The folder, where it has calibration, poses and pictures."""
    has_pictures = any((folder / name).is_dir() for name in FOLDERS)
    return folder if (folder / CALIB).is_file() and has_pictures else None


def read(found: Path, images: Path | None) -> CameraSet:
    """The cameras of all pictures, frame by frame, the left one first."""
    matrices = read_calibration(found / CALIB)
    poses = _read_poses(_poses_path(found))
    cameras = []
    folders = [images] if images is not None else sorted(found / name for name in FOLDERS)
    for folder in (one for one in folders if one.is_dir()):
        number = FOLDERS.get(folder.name)
        if number is None or number not in matrices:
            fault = f"has no matrix for the pictures in {folder.name}"
            raise InputError(found / CALIB, fault, _LAYOUT)
        cameras += _of_folder(folder, matrices[number], poses, found)
    if not cameras:
        raise InputError(found, "has no pictures", _LAYOUT)
    cameras.sort(key=lambda pair: (pair[0], pair[1].name))
    return CameraSet(
        cameras=tuple(camera for _, camera in cameras), scale="metres", source=str(found), up=_UP
    )


@dataclass(frozen=True)
class CalibrationRow:
    """A line of a calibration file: its number from 1, its key (none where it has none), words."""

    line: int
    key: str | None
    words: list[str]

    @property
    def camera(self) -> int | None:
        """The number of the camera whose projection it is; None of other lines with a key."""
        found = None if self.key is None else _PROJECTION.fullmatch(self.key)
        return None if found is None else int(found[1])


def calibration_rows(text: str) -> list[CalibrationRow]:
    """The lines of KITTI's calibration files that are not empty, in their order."""
    rows = []
    for line, words in lines_of(text):
        key, colon, rest = " ".join(words).partition(":")
        row = CalibrationRow(line, key.strip(), rest.split())
        rows.append(row if colon else CalibrationRow(line, None, words))
    return rows


def read_calibration(path: Path) -> dict[int, Floats]:
    """(3, 4) px from the first camera's frame, by the number of the camera."""
    return projections(path, read_text(path))


def projections(path: Path, text: str) -> dict[int, Floats]:
    """The same of a text: lines `P0:` to `P3:` (`P_rect_02:`), or bare ones in that order."""
    matrices: dict[int, Floats] = {}
    for row in calibration_rows(text):
        number = len(matrices) if row.key is None else row.camera
        if number is not None:
            values = numbers(path, f"line {row.line}", row.words, 12)
            matrices[number] = values.reshape(3, 4)
    if not matrices:
        raise InputError(path, "has no matrix P0 to P3", _LAYOUT)
    return matrices


def _poses_path(found: Path) -> Path:
    other = found.parent.parent / "poses" / f"{found.name}.txt"
    own = found / "poses.txt"
    if not own.is_file() and not other.is_file():
        raise InputError(own, "does not exist", _LAYOUT)
    return own if own.is_file() else other


def _read_poses(path: Path) -> Floats:
    """(f, 3, 4) world_from_cam of the first camera."""
    lines = lines_of(read_text(path))
    if not lines:
        raise InputError(path, "has no poses", COPY_AGAIN)
    rows = [numbers(path, f"line {place}", words, 12) for place, words in lines]
    poses = np.array(rows).reshape(-1, 3, 4)
    for number, pose in enumerate(poses):
        turn = nearest_turn(pose[:, :3], 1e-2)
        if turn is None:
            fault = f"has a pose whose left part is no turn (number {number + 1})"
            raise InputError(path, fault, COPY_AGAIN)
        pose[:, :3] = turn
    return poses


def _of_folder(
    folder: Path, matrix: Floats, poses: Floats, found: Path
) -> list[tuple[int, Camera]]:
    paths = sorted(path for path in folder.iterdir() if path.suffix.lower() in SUFFIXES)
    parted = part_projection(matrix)
    if parted is None:
        raise InputError(found / CALIB, f"its matrix for {folder.name} is no camera's", COPY_AGAIN)
    turned, k = parted.cam_from_world, parted.matrix
    numbered = all(path.stem.isdigit() for path in paths)
    cameras = []
    for place, path in enumerate(paths):
        frame = int(path.stem) if numbered else place
        if frame >= len(poses):
            fault = f"has {len(poses)} poses, none for frame {frame}"
            raise InputError(_poses_path(found), fault, "Give the poses of the whole sequence.")
        first_turn = poses[frame, :, :3].T
        first = np.column_stack([first_turn, -first_turn @ poses[frame, :, 3]])
        pose = turned[:, :3] @ first
        pose[:, 3] += turned[:, 3]
        width, height = image_size(path)
        camera = Camera(
            name=f"{folder.name}/{path.name}",
            width_px=width,
            height_px=height,
            focal_px=(float(k[0, 0]), float(k[1, 1])),
            centre_px=(float(k[0, 2]) + 0.5, float(k[1, 2]) + 0.5),
            cam_from_world=pose,
            picture=path,
            skew_px=float(k[0, 1]) if abs(k[0, 1]) > 1e-6 else 0.0,
        )
        cameras.append((frame, camera))
    require_one_size([camera for _, camera in cameras])
    return cameras
