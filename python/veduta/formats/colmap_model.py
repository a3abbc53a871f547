"""A model in the format of COLMAP: cameras, posed images and points.

The files are `cameras`, `images` and `points3D`, all `.bin` or all `.txt`; newer versions add
`rigs` and `frames`, which say again what the images' poses say. `colmap_binary` and `colmap_text`
read them. Image coordinates have the centre of the upper left pixel at (0.5, 0.5), as ours.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta.run.errors import InputError

NAMES = ("cameras", "images", "points3D")
MODELS: tuple[tuple[str, int], ...] = (
    ("SIMPLE_PINHOLE", 3),
    ("PINHOLE", 4),
    ("SIMPLE_RADIAL", 4),
    ("RADIAL", 5),
    ("OPENCV", 8),
    ("OPENCV_FISHEYE", 8),
    ("FULL_OPENCV", 12),
    ("FOV", 5),
    ("SIMPLE_RADIAL_FISHEYE", 4),
    ("RADIAL_FISHEYE", 5),
    ("THIN_PRISM_FISHEYE", 12),
    ("RAD_TAN_THIN_PRISM_FISHEYE", 16),
    ("SIMPLE_DIVISION", 4),
    ("DIVISION", 5),
    ("SIMPLE_FISHEYE", 3),
    ("FISHEYE", 4),
    ("EUCM", 6),
)
"""Name and number of parameters of each lens model, by its number in the files."""
LARGEST_SIDE_PX = 100_000
MOST_CAMERAS = 2**31
"""The engine's numbers end there."""
MOST_RECORDS = 200_000
"""Cameras of a model, and images: each becomes an object, many times as large as its bytes."""
COPY_AGAIN = "Export the model again from the software that made it."


@dataclass(frozen=True)
class ColmapCamera:
    """A camera by its model's name; the parameters as COLMAP orders them (px)."""

    model: str
    width_px: int
    height_px: int
    params: tuple[float, ...]


@dataclass(frozen=True)
class ColmapImage:
    """A posed image. cam_from_world: (3, 4). places_px: (k, 2). points: (k,) ids, -1 for none."""

    number: int
    name: str
    camera: int
    cam_from_world: NDArray[np.float64]
    places_px: NDArray[np.float64]
    points: NDArray[np.int64]


@dataclass(frozen=True)
class ColmapPoints:
    """numbers: (p,) ids. places: (p, 3). colours: (p, 3) uint8."""

    numbers: NDArray[np.int64]
    places: NDArray[np.float64]
    colours: NDArray[np.uint8]


@dataclass(frozen=True)
class ColmapModel:
    """What the three files say; each image has its camera, and points that are there."""

    cameras: Mapping[int, ColmapCamera]
    images: tuple[ColmapImage, ...]
    points: ColmapPoints


def require_few(path: Path, what: str, count: int) -> None:
    """InputError where a file has more cameras or images than are read."""
    if count > MOST_RECORDS:
        fault = f"says that it has {count:,} {what}, more than {MOST_RECORDS:,}"
        raise InputError(path, fault, "Divide the model, or check that it is the right file.")


def checked_camera(path: Path, camera: ColmapCamera) -> ColmapCamera:
    """The camera; InputError where it cannot be one."""
    if camera.model not in dict(MODELS):
        raise InputError(path, f"has a camera of an unknown model ({camera.model})", COPY_AGAIN)
    sides = camera.width_px, camera.height_px
    if not all(0 < side <= LARGEST_SIDE_PX for side in sides):
        raise InputError(path, f"has a camera of {sides[0]} x {sides[1]} px", COPY_AGAIN)
    if len(camera.params) != dict(MODELS)[camera.model]:
        wrong = f"{len(camera.params)} numbers for {camera.model}"
        raise InputError(path, f"has a camera with {wrong}", COPY_AGAIN)
    if not np.isfinite(camera.params).all() or camera.params[0] <= 0.0:
        raise InputError(path, "has a camera whose numbers cannot be true", COPY_AGAIN)
    return camera


def pose(
    path: Path, name: str, quaternion: NDArray[np.float64], shift: NDArray[np.float64]
) -> NDArray[np.float64]:
    """(3, 4) cam_from_world from (4,) w, x, y, z of any length and (3,); InputError where none."""
    length = float(np.linalg.norm(quaternion))
    if not np.isfinite([*quaternion, *shift]).all() or length < 1e-6:
        raise InputError(path, f"has no pose for {name} that could be one", COPY_AGAIN)
    w, x, y, z = quaternion / length
    rotation = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )
    return np.column_stack([rotation, shift])


def checked_points(path: Path, points: ColmapPoints) -> ColmapPoints:
    """The points in the order of their ids; InputError where they cannot be used."""
    if not np.isfinite(points.places).all():
        raise InputError(path, "has points whose coordinates are not numbers", COPY_AGAIN)
    order = np.argsort(points.numbers, kind="stable")
    numbers = points.numbers[order]
    if (numbers[1:] == numbers[:-1]).any():
        raise InputError(path, "has two points of one number", COPY_AGAIN)
    return ColmapPoints(numbers, points.places[order], points.colours[order])


def checked_model(path: Path, model: ColmapModel) -> ColmapModel:
    """The model; InputError where its files do not belong together. path: that of the images."""
    if not all(0 <= number < MOST_CAMERAS for number in model.cameras):
        raise InputError(path.with_stem("cameras"), "has a camera of no valid number", COPY_AGAIN)
    for image in model.images:
        if image.camera not in model.cameras:
            fault = f"names camera {image.camera} for {image.name}, which the cameras do not have"
            raise InputError(path, fault, COPY_AGAIN)
        seen = image.points >= 0
        if not np.isin(image.points[seen], model.points.numbers).all():
            fault = f"names points for {image.name} that the points do not have"
            raise InputError(path, fault, COPY_AGAIN)
        if not np.isfinite(image.places_px).all():
            raise InputError(path, f"has places in {image.name} that are not numbers", COPY_AGAIN)
    return model
