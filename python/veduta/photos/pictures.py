"""The photos as a pinhole camera would have taken them, and the colours that they give to points.

The studio shows a photo in the place where it was taken; straight lines of the world have to be
straight in it, so the distortion of the lens is taken out.
"""

from __future__ import annotations

import io
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import cv2
import numpy as np
import pycolmap
from numpy.typing import NDArray
from PIL import Image

from veduta.imaging.read import read_image
from veduta.photos.intake.read import PhotoRecord
from veduta.photos.structure import Structure
from veduta.run.progress import StepProgress, no_progress

LONGEST_PX = 1600
JPEG_QUALITY = 88


@dataclass(frozen=True)
class Pinhole:
    """An ideal camera: focal lengths and principal point in pixels, and the picture's size."""

    width_px: int
    height_px: int
    focal_px: tuple[float, float]
    centre_px: tuple[float, float]


def write_pictures(
    structure: Structure,
    photos: Sequence[PhotoRecord],
    folder: Path,
    progress: StepProgress = no_progress,
) -> tuple[Structure, tuple[Pinhole, ...]]:
    """Write a picture per photo of the model; the model with colours, and the pictures' cameras."""
    by_id = {photo.image_id: photo for photo in photos}
    sums = np.zeros((len(structure.points), 3))
    counts = np.zeros(len(structure.points))
    cameras = []
    for row, image_id in enumerate(structure.image_ids):
        progress("pictures", row / len(structure.image_ids))
        pixels = read_image(by_id[image_id].path).pixels
        own = structure.image_of == row
        seen = structure.point_of[own]
        np.add.at(
            sums, seen, _colours(pixels, structure.keypoints_px[row][structure.keypoint_of[own]])
        )
        np.add.at(counts, seen, 1.0)
        picture, camera = undistorted(pixels, structure.camera(row))
        (folder / picture_name(image_id)).write_bytes(_jpeg(picture))
        cameras.append(camera)
    colours = np.round(sums / np.maximum(counts, 1.0)[:, None]).astype(np.uint8)
    return replace(structure, colours=colours), tuple(cameras)


def picture_name(image_id: int) -> str:
    """The name of a photo's picture; photos may have any names."""
    return f"{image_id:04d}.jpg"


def undistorted(
    pixels: NDArray[np.uint8], camera: pycolmap.Camera
) -> tuple[NDArray[np.uint8], Pinhole]:
    """The picture of a camera without distortion, at most `LONGEST_PX` long, and that camera."""
    shrink = min(1.0, LONGEST_PX / max(camera.width, camera.height))
    width, height = round(shrink * camera.width), round(shrink * camera.height)
    across, down = width / camera.width, height / camera.height
    pinhole = Pinhole(
        width,
        height,
        (across * camera.focal_length_x, down * camera.focal_length_y),
        (across * camera.principal_point_x, down * camera.principal_point_y),
    )
    x, y = np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5)
    rays = np.column_stack(
        [
            (x.ravel() - pinhole.centre_px[0]) / pinhole.focal_px[0],
            (y.ravel() - pinhole.centre_px[1]) / pinhole.focal_px[1],
            np.ones(x.size),
        ]
    )
    # OpenCV puts the centre of the first pixel at 0, the engine and we at one half.
    source = (camera.img_from_cam(rays) - 0.5).astype(np.float32)
    columns, rows = (source[:, axis].reshape(height, width).copy() for axis in (0, 1))
    if shrink < 1.0:
        sigma = 0.5 * (1.0 / shrink - 1.0)
        pixels = cv2.GaussianBlur(pixels, (0, 0), max(sigma, 0.1)).astype(np.uint8)
    picture = cv2.remap(pixels, columns, rows, cv2.INTER_LINEAR, borderMode=cv2.BORDER_CONSTANT)
    return picture.astype(np.uint8), pinhole


def _colours(pixels: NDArray[np.uint8], places: NDArray[np.float64]) -> NDArray[np.float64]:
    """(k, 3) colours of the pixels that (k, 2) places lie in."""
    height, width = pixels.shape[:2]
    columns = np.clip(places[:, 0].astype(np.int64), 0, width - 1)
    rows = np.clip(places[:, 1].astype(np.int64), 0, height - 1)
    return pixels[rows, columns].astype(np.float64)


def _jpeg(pixels: NDArray[np.uint8]) -> bytes:
    file = io.BytesIO()
    Image.fromarray(pixels).save(file, format="JPEG", quality=JPEG_QUALITY)
    return file.getvalue()
