"""Photos at the working size, without distortion."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.cameras import Camera, CameraSet, shown, straight_camera, undistorted
from veduta.dense.document.views import MOST_KEPT_BYTES, Views
from veduta.imaging.read import read_image
from veduta.run.errors import InputError

BYTES_PER_PIXEL = 330
"""What a view and its four neighbours are taken to need while a depth map is made: an estimate by
the sizes of their arrays, not a measurement."""
LEAST_SIDE_PX = 64


def usable_cameras(cameras: CameraSet) -> tuple[list[Camera], list[str]]:
    """Those whose photos are there, and why the others are left out.

    InputError where fewer than two are left.
    """
    kept: list[Camera] = []
    left = []
    for camera in cameras.cameras:
        if camera.picture is None or not camera.picture.is_file():
            left.append(f"{camera.name}: its photo is not there")
        else:
            kept.append(camera)
    if len(kept) < 2:
        fault = f"has photos for {len(kept)} of {len(cameras.cameras)} cameras; two are needed"
        remedy = "Put the photos beside the cameras, under the names that the cameras give them."
        raise InputError(cameras.source, fault, remedy)
    return kept, left


def working_scale(cameras: list[Camera], max_side_px: int, memory_gb: float) -> float:
    """The share of the photos' size at which they are compared, at most 1."""
    side = max(max(one.width_px, one.height_px) for one in cameras)
    pixels = max(one.width_px * one.height_px for one in cameras)
    budget = memory_gb * 1e9 * 0.5 / BYTES_PER_PIXEL
    return float(min(1.0, max_side_px / side, np.sqrt(budget / pixels)))


def open_views(
    cameras: list[Camera],
    scale: float,
    masks: Mapping[str, Path],
    most_kept_bytes: float = MOST_KEPT_BYTES,
) -> Views:
    """The views at a share of their size. Pictures are read when they are asked for.

    masks: by a camera's name, a picture that is black where nothing is looked for. most_kept_bytes:
    of pictures that stay in memory.
    """
    plain = tuple(straight_camera(one.scaled(scale)) for one in cameras)

    def read(view: int) -> tuple[NDArray[np.uint8], NDArray[np.bool_] | None]:
        given, wanted = cameras[view], plain[view]
        pixels = _straight(_photo(given), given, wanted)
        mask = masks.get(given.name)
        return pixels, _hidden(mask, given, wanted)

    return Views(plain, read, most_kept_bytes)


def _photo(camera: Camera) -> NDArray[np.uint8]:
    path = Path(str(camera.picture))
    pixels = read_image(path).pixels
    height, width = pixels.shape[:2]
    if (width, height) != (camera.width_px, camera.height_px):
        fault = (
            f"has {width} x {height} pixels, but its camera is made for "
            f"{camera.width_px} x {camera.height_px}"
        )
        raise InputError(path, fault, "Give the photos at the size that the cameras were made for.")
    return pixels


def require_sizes(cameras: list[Camera]) -> None:
    """InputError where a photo has not its camera's size; it names the first."""
    for camera in cameras:
        _photo(camera)


def _straight(
    pixels: NDArray[np.uint8], given: Camera, wanted: Camera, *, nearest: bool = False
) -> NDArray[np.uint8]:
    """Without what the lens did, at the working size."""
    _, flat = undistorted(given, pixels, nearest=nearest)
    size = (wanted.width_px, wanted.height_px)
    if size == (given.width_px, given.height_px):
        return flat
    kind = cv2.INTER_NEAREST if nearest else cv2.INTER_AREA
    return np.asarray(cv2.resize(flat, size, interpolation=kind), dtype=np.uint8)


def _hidden(mask: Path | None, given: Camera, wanted: Camera) -> NDArray[np.bool_] | None:
    """Where nothing is looked for: where a mask is black, and where the photo shows nothing."""
    hidden = None
    if given.distorted:
        size = (wanted.width_px, wanted.height_px)
        kept = shown(given).astype(np.uint8)
        hidden = cv2.resize(kept, size, interpolation=cv2.INTER_NEAREST) == 0
    if mask is None:
        return hidden
    black = _mask(mask, given, wanted)
    return black if hidden is None else black | hidden


def _mask(path: Path, given: Camera, wanted: Camera) -> NDArray[np.bool_]:
    grey = read_image(path).pixels[:, :, 0]
    if grey.shape != (given.height_px, given.width_px):
        fault = f"has {grey.shape[1]} x {grey.shape[0]} pixels, its photo another number"
        raise InputError(path, fault, "Give the mask at the photo's size.")
    return np.asarray(_straight(grey, given, wanted, nearest=True) < 128, dtype=np.bool_)
