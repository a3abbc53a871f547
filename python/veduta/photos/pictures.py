"""The photos as a pinhole camera would have taken them, and the colours that they give to points.

The studio shows a photo in the place where it was taken; straight lines of the world have to be
straight in it, so the distortion of the lens is taken out.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta.imaging.encode import jpeg_bytes
from veduta.photos.straight import Pinhole, pinhole_of, straightened
from veduta.photos.structure import Structure
from veduta.run.progress import StepProgress, no_progress

LONGEST_PX = 1600
JPEG_QUALITY = 88


def write_pictures(
    structure: Structure,
    read_photo: Callable[[int], NDArray[np.uint8]],
    folder: Path,
    progress: StepProgress = no_progress,
) -> tuple[Structure, tuple[Pinhole, ...]]:
    """Write a picture per photo of the model; the model with colours, and the pictures' cameras.

    read_photo: gives (h, w, 3) sRGB by image id.
    """
    sums = np.zeros((len(structure.points), 3))
    counts = np.zeros(len(structure.points))
    cameras = []
    for row, image_id in enumerate(structure.image_ids):
        progress("pictures", row / len(structure.image_ids))
        pixels = read_photo(image_id)
        own = structure.image_of == row
        seen = structure.point_of[own]
        np.add.at(
            sums, seen, _colours(pixels, structure.keypoints_px[row][structure.keypoint_of[own]])
        )
        np.add.at(counts, seen, 1.0)
        camera = structure.camera(row)
        pinhole = pinhole_of(camera, LONGEST_PX)
        picture = straightened(pixels, camera, pinhole)
        (folder / picture_name(image_id)).write_bytes(jpeg_bytes(picture, JPEG_QUALITY))
        cameras.append(pinhole)
    colours = np.round(sums / np.maximum(counts, 1.0)[:, None]).astype(np.uint8)
    return replace(structure, colours=colours), tuple(cameras)


def picture_name(image_id: int) -> str:
    """The name of a photo's picture; photos may have any names."""
    return f"{image_id:04d}.jpg"


def _colours(pixels: NDArray[np.uint8], places: NDArray[np.float64]) -> NDArray[np.float64]:
    """(k, 3) colours of the pixels that (k, 2) places lie in."""
    height, width = pixels.shape[:2]
    columns = np.clip(places[:, 0].astype(np.int64), 0, width - 1)
    rows = np.clip(places[:, 1].astype(np.int64), 0, height - 1)
    return pixels[rows, columns].astype(np.float64)
