"""Cameras as Strecha's benchmark has them (2008): a `.camera` file for each photo, in metres.

K (3 x 3), three zeros, the camera's axes in the world (3 x 3, one in each column), its place (3),
width and height. P = K [R^T, -R^T C].
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from veduta.cameras.camera import Camera, CameraSet
from veduta.cameras.files import COPY_AGAIN, numbers, picture_size, read_text
from veduta.cameras.pictures import natural_order, near, with_pictures
from veduta.cameras.projection import nearest_turn
from veduta.run.errors import InputError

SUFFIX = ".camera"
COUNT = 26
SKEW = 1e-3
"""Largest difference of a turn from an orthogonal matrix."""


def find(folder: Path) -> Path | None:
    """The folder with the files: itself, or its `cameras`."""
    for place in (folder, folder / "cameras"):
        if any(place.glob(f"*{SUFFIX}")):
            return place
    return None


def read(found: Path, images: Path | None) -> CameraSet:
    """The cameras of all files of a folder, at the sizes of their photos."""
    paths = sorted(found.glob(f"*{SUFFIX}"), key=lambda path: natural_order(path.name))
    cameras = [_camera(path) for path in paths]
    return CameraSet(
        cameras=with_pictures(cameras, near(found, images), found),
        scale="metres",
        source=str(found),
    )


def _camera(path: Path) -> Camera:
    values = numbers(path, "the file", read_text(path).split(), COUNT)
    matrix, axes, centre = values[:9].reshape(3, 3), values[12:21].reshape(3, 3), values[21:24]
    turn = nearest_turn(axes.T, SKEW)
    if turn is None:
        raise InputError(path, "its numbers 13 to 21 are no turn", COPY_AGAIN)
    width, height = picture_size(path, *values[24:])
    if matrix[0, 0] <= 0.0 or matrix[1, 1] <= 0.0:
        raise InputError(path, "has a focal length that is not positive", COPY_AGAIN)
    return Camera(
        name=path.name[: -len(SUFFIX)],
        width_px=width,
        height_px=height,
        focal_px=(float(matrix[0, 0]), float(matrix[1, 1])),
        centre_px=(float(matrix[0, 2]) + 0.5, float(matrix[1, 2]) + 0.5),
        cam_from_world=np.column_stack([turn, -turn @ centre]),
        skew_px=float(matrix[0, 1]),
    )
