"""Silhouettes that were drawn before: a folder of masks beside the photos."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import cv2
import numpy as np

from veduta.cameras import Camera, CameraSet, undistorted
from veduta.carve.views import Mask
from veduta.imaging.read import read_image
from veduta.run.errors import InputError

FOLDERS = ("masks", "silhouettes", "mask")
ENDINGS = {".png", ".pbm", ".pgm", ".bmp", ".tif", ".tiff", ".jpg", ".jpeg", ".webp"}
WHITE = 128
"""A mask is white, or bright, on the object."""


def find_masks(folder: Path, cameras: CameraSet) -> dict[str, Path]:
    """The masks by the names of their photos: those of the set, and those of a folder `masks`.

    A mask has its photo's name, with another ending, another ending after it, or `_mask` before it.
    """
    found = dict(cameras.masks)
    base = folder if folder.is_dir() else folder.parent
    for name in FOLDERS:
        place = base / name
        if not place.is_dir():
            continue
        by_stem = {
            path.stem.removesuffix("_mask"): path
            for path in sorted(place.iterdir())
            if path.suffix.lower() in ENDINGS
        }
        for camera in cameras.cameras:
            stem = Path(camera.name).stem if camera.picture is None else camera.picture.stem
            full = camera.name if camera.picture is None else camera.picture.name
            path = by_stem.get(full) or by_stem.get(stem) or by_stem.get(camera.name)
            if path is not None:
                found.setdefault(camera.name, path)
    return found


def read_mask(masks: Mapping[str, Path], camera: Camera, straight: Camera) -> Mask | None:
    """(h, w) of the straight camera, true on the object; None where there is none.

    InputError where the mask has not its photo's size.
    """
    path = masks.get(camera.name)
    if path is None:
        return None
    pixels = read_image(path).pixels
    height, width = pixels.shape[:2]
    if (width, height) != (camera.width_px, camera.height_px):
        raise InputError(
            path,
            f"is {width} x {height} px, but its photo has"
            f" {camera.width_px} x {camera.height_px} px",
            "Give each mask the size of its photo.",
        )
    bright = np.where(pixels.max(axis=2) >= WHITE, 255, 0).astype(np.uint8)
    _, bright = undistorted(camera, bright, nearest=True)
    size = (straight.width_px, straight.height_px)
    if bright.shape[::-1] != size:
        bright = np.asarray(cv2.resize(bright, size, interpolation=cv2.INTER_AREA), np.uint8)
    return np.asarray(bright >= WHITE, dtype=bool)
