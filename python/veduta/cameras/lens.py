"""A picture without what its lens did: as a camera with straight lines would have taken it."""

from __future__ import annotations

from dataclasses import replace

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.cameras.camera import Camera

BAND_PX = 512
"""Rows that are drawn at once: the places of all pixels of a large photo would be 0.4 GB."""


def straight_camera(camera: Camera) -> Camera:
    """The camera of the same size and place without distortion and skew."""
    return replace(camera, distortion=(), skew_px=0.0)


def undistorted(
    camera: Camera, pixels: NDArray[np.uint8], *, nearest: bool = False
) -> tuple[Camera, NDArray[np.uint8]]:
    """The camera without distortion, and (h, w) or (h, w, 3) pixels as it sees them.

    Black where the photo shows nothing. The same pixels where the camera has no distortion.
    nearest: take a pixel's value as it is (masks), and not the mean of four.
    ValueError where the pixels have not the camera's size.
    """
    height, width = pixels.shape[:2]
    if (width, height) != (camera.width_px, camera.height_px):
        wanted = f"{camera.width_px} x {camera.height_px}"
        raise ValueError(f"{camera.name}: {width} x {height} px, not {wanted}")
    plain = straight_camera(camera)
    if not camera.distorted:
        return plain, pixels
    how = cv2.INTER_NEAREST if nearest else cv2.INTER_LINEAR
    drawn = np.empty_like(pixels)
    for top in range(0, height, BAND_PX):
        rows = min(BAND_PX, height - top)
        x, y = _places(camera, plain, top, rows)
        drawn[top : top + rows] = cv2.remap(pixels, x, y, how, borderMode=cv2.BORDER_CONSTANT)
    return plain, drawn


def shown(camera: Camera) -> NDArray[np.bool_]:
    """(h, w) where the picture without distortion shows something of the photo."""
    white = np.full((camera.height_px, camera.width_px), 255, dtype=np.uint8)
    _, drawn = undistorted(camera, white)
    return np.asarray(drawn == 255, dtype=np.bool_)


def _places(
    camera: Camera, plain: Camera, top: int, rows: int
) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """(rows, w) the columns and rows of the photo, for OpenCV, whose first pixel is at 0."""
    columns = np.arange(camera.width_px) + 0.5
    downs = top + np.arange(rows) + 0.5
    grid = np.stack(np.meshgrid(columns, downs), axis=-1).reshape(-1, 2)
    found = camera.pixels_of(plain.plane_of(grid)) - 0.5
    found = found.reshape(rows, camera.width_px, 2).astype(np.float32)
    return np.ascontiguousarray(found[..., 0]), np.ascontiguousarray(found[..., 1])
