"""Resampling a photo through a homography into a bounded image."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.geometry import homography
from veduta.geometry.homography import Matrix

_MINIFY_FROM = 0.75
"""Below this local scale the photo is averaged down first, or fine texture would alias."""


def warp(
    pixels: NDArray[np.uint8], target_from_source: Matrix, width_px: int, height_px: int
) -> tuple[NDArray[np.uint8], NDArray[np.bool_]]:
    """(height, width, 3) resampled pixels and the (height, width) mask of pixels inside the photo.

    Pixel coordinates as everywhere: the centre of the upper left pixel is (0.5, 0.5). Outside
    the photo the pixels are black.
    """
    source, source_from_photo = _averaged_down(pixels, target_from_source, width_px, height_px)
    target_from_reduced = target_from_source @ np.linalg.inv(source_from_photo)
    # OpenCV puts the centre of the upper left pixel at (0, 0).
    half = homography.translation(0.5, 0.5)
    matrix = np.linalg.inv(half) @ target_from_reduced @ half
    warped = cv2.warpPerspective(
        source,
        matrix,
        (width_px, height_px),
        flags=cv2.INTER_LINEAR,
        borderMode=cv2.BORDER_REPLICATE,
    )
    valid = _inside(target_from_source, pixels.shape[1], pixels.shape[0], width_px, height_px)
    result = np.asarray(warped, dtype=np.uint8)
    result[~valid] = 0
    return result, valid


def _averaged_down(
    pixels: NDArray[np.uint8], target_from_source: Matrix, width_px: int, height_px: int
) -> tuple[NDArray[np.uint8], Matrix]:
    """The photo reduced to about the target's resolution, and the map to it."""
    corners = np.array([[0.5, 0.5], [0.5, 0.1], [0.9, 0.5], [0.5, 0.9], [0.1, 0.5]]) * (
        width_px,
        height_px,
    )
    source_from_target = homography.inverse(target_from_source)
    area = np.abs(homography.area_scale(source_from_target, corners))
    scale = float(1.0 / np.sqrt(np.median(area)))
    height, width = pixels.shape[:2]
    if not scale < _MINIFY_FROM:
        return pixels, np.eye(3)
    reduced_width, reduced_height = max(1, round(width * scale)), max(1, round(height * scale))
    reduced = cv2.resize(pixels, (reduced_width, reduced_height), interpolation=cv2.INTER_AREA)
    factors = homography.scaling(reduced_width / width, reduced_height / height)
    return np.asarray(reduced, dtype=np.uint8), factors


def _inside(
    target_from_source: Matrix, width: int, height: int, width_px: int, height_px: int
) -> NDArray[np.bool_]:
    """Target pixels whose centre comes from inside the photo, on the near side of the horizon."""
    m = np.linalg.inv(target_from_source)
    middle = homography.homogeneous(target_from_source, np.array([[width / 2, height / 2]]))
    if middle[0, 2] < 0:
        m = -m
    x = np.arange(width_px)[None, :] + 0.5
    y = np.arange(height_px)[:, None] + 0.5
    u, v, w = (m[i, 0] * x + m[i, 1] * y + m[i, 2] for i in range(3))
    inside: NDArray[np.bool_] = (u >= 0) & (v >= 0) & (u <= width * w) & (v <= height * w) & (w > 0)
    return inside
