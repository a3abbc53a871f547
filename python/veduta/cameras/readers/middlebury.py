"""Cameras of Middlebury's multi-view benchmark: `*_par.txt`.

The number of photos, then a line for each: name, K (9 numbers), R (9), t (3), P = K [R, t].
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from veduta.cameras.camera import Camera, CameraSet
from veduta.cameras.files import COPY_AGAIN, lines_of, numbers, read_head, read_text
from veduta.cameras.pictures import near, require_one_size, require_picture
from veduta.cameras.projection import nearest_turn
from veduta.run.errors import InputError

NUMBERS = 21
TURN = 1e-3


def find(folder: Path) -> Path | None:
    """The first text file of a folder that reads so."""
    for path in sorted(folder.glob("*.txt")):
        if is_one(path):
            return path
    return None


def is_one(path: Path) -> bool:
    """Whether a file starts with a count and a line of a name and numbers."""
    lines = lines_of(read_head(path, 4096))
    if len(lines) < 2 or len(lines[0][1]) != 1 or not lines[0][1][0].isdecimal():
        return False
    return len(lines[1][1]) == NUMBERS + 1 and not _is_number(lines[1][1][0])


def read(found: Path, images: Path | None) -> CameraSet:
    """The cameras of a file; its photos say their sizes."""
    (_, (count,)), *lines = lines_of(read_text(found))
    if int(count) != len(lines):
        fault = f"says {count} photos and has {len(lines)}"
        raise InputError(found, fault, COPY_AGAIN)
    pictures = near(found, images)
    cameras = []
    for number, (name, *words) in lines:
        values = numbers(found, f"line {number}", words, NUMBERS)
        matrix, shift = values[:9].reshape(3, 3), values[18:]
        turn = nearest_turn(values[9:18].reshape(3, 3), TURN)
        if turn is None:
            raise InputError(found, f"line {number} has a matrix that is no turn", COPY_AGAIN)
        if matrix[0, 0] <= 0.0 or matrix[1, 1] <= 0.0:
            raise InputError(found, f"line {number} has no positive focal length", COPY_AGAIN)
        path, width, height = require_picture(pictures, name, found)
        cameras.append(
            Camera(
                name=name,
                width_px=width,
                height_px=height,
                focal_px=(float(matrix[0, 0]), float(matrix[1, 1])),
                centre_px=(float(matrix[0, 2]) + 0.5, float(matrix[1, 2]) + 0.5),
                cam_from_world=np.column_stack([turn, shift]),
                picture=path,
                skew_px=float(matrix[0, 1]),
            )
        )
    require_one_size(cameras)
    return CameraSet(cameras=tuple(cameras), source=str(found))


def _is_number(word: str) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True
