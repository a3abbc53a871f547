"""By how much a sheet lies askew, and the map that lays it straight at a good size."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.imaging.segments import detect_segments

MOST_SKEW_RAD = np.radians(12)
"""Drawings turned by more are meant so."""

LEAST_SKEW_RAD = np.radians(0.08)
"""Less than a pixel over a sheet: not worth the blur."""

WORK_SIDE_PX = (1500, 2600)
"""Smaller sheets are enlarged up to four times, larger ones reduced."""

MOST_ENLARGED = 4.0


def skew(pixels: NDArray[np.uint8]) -> float:
    """The angle in radians by which (h, w, 3) pixels must turn counter-clockwise to lie straight.

    The commonest direction of line segments modulo a right angle, by length; 0 where no direction
    within 12 degrees of the axes has a third of all lengths.
    """
    segments = detect_segments(pixels, shortest_part=0.025)
    if len(segments) < 4:
        return 0.0
    direction, length = segments.directions(), segments.lengths()
    angle = np.arctan2(direction[:, 1], direction[:, 0])
    turned = (angle + np.pi / 4) % (np.pi / 2) - np.pi / 4
    near = np.abs(turned) < MOST_SKEW_RAD
    if length[near].sum() < length.sum() / 3:
        return 0.0
    bins = np.radians(np.arange(-12.25, 12.3, 0.5))
    weights = np.histogram(turned[near], bins, weights=length[near])[0]
    smooth = np.convolve(weights, [0.5, 1, 0.5], "same")
    peak = (bins[:-1] + bins[1:])[int(np.argmax(smooth))] / 2
    around = near & (np.abs(turned - peak) < np.radians(0.8))
    found = _weighted_median(turned[around], length[around])
    return float(found) if abs(found) > LEAST_SKEW_RAD else 0.0


def work_scale(width_px: int, height_px: int) -> float:
    """By how much to resample a sheet: small scans have walls of a few pixels."""
    side = max(width_px, height_px)
    least, most = WORK_SIDE_PX
    if side > most:
        return most / side
    enlarged = min(MOST_ENLARGED, least / side)
    return enlarged if enlarged > 1.3 else 1.0


def laid_straight(
    pixels: NDArray[np.uint8], rotation_rad: float, scale: float
) -> tuple[NDArray[np.uint8], NDArray[np.float64]]:
    """The turned and resampled sheet, and the (3, 3) map of pixel coordinates to it.

    The new sheet holds all of the old one; what is new at its corners is paper.
    """
    height, width = pixels.shape[:2]
    cos, sin = np.cos(rotation_rad) * scale, np.sin(rotation_rad) * scale
    # y points down: turning counter-clockwise, as one sees it.
    linear = np.array([[cos, sin], [-sin, cos]])
    corners = np.array([[0, 0], [width, 0], [width, height], [0, height]]) @ linear.T
    low, high = corners.min(axis=0), corners.max(axis=0)
    size = np.maximum(1, np.round(high - low)).astype(int)
    matrix = np.eye(3)
    matrix[:2, :2], matrix[:2, 2] = linear, -low
    if rotation_rad == 0:
        matrix[0, 0], matrix[1, 1] = size[0] / width, size[1] / height
        return _resized(pixels, size), matrix
    # OpenCV puts the centre of the upper left pixel at (0, 0).
    half = np.array([[1, 0, 0.5], [0, 1, 0.5], [0, 0, 1.0]])
    shifted = np.linalg.inv(half) @ matrix @ half
    source = pixels
    if scale < 0.75:
        source = _resized(pixels, np.round(np.array([width, height]) * scale).astype(int))
        shifted = shifted @ np.diag([width / source.shape[1], height / source.shape[0], 1.0])
    turned = cv2.warpAffine(
        source,
        shifted[:2],
        (int(size[0]), int(size[1])),
        flags=cv2.INTER_CUBIC,
        borderMode=cv2.BORDER_CONSTANT,
        borderValue=_paper_colour(pixels),
    )
    return np.asarray(turned, dtype=np.uint8), matrix


def _resized(pixels: NDArray[np.uint8], size: NDArray[np.int_]) -> NDArray[np.uint8]:
    height, width = pixels.shape[:2]
    target = (max(1, int(size[0])), max(1, int(size[1])))
    if target == (width, height):
        return pixels
    factor = max(width / target[0], height / target[1])
    if factor < 1:
        return np.asarray(cv2.resize(pixels, target, interpolation=cv2.INTER_CUBIC), np.uint8)
    if factor >= 2:
        # Averaging would drown lines of one pixel: they are widened to a pixel of the result.
        reach = round(factor)
        pixels = np.asarray(cv2.erode(pixels, np.ones((reach, reach), np.uint8)), np.uint8)
    return np.asarray(cv2.resize(pixels, target, interpolation=cv2.INTER_AREA), np.uint8)


def _paper_colour(pixels: NDArray[np.uint8]) -> tuple[float, float, float]:
    edge = np.concatenate([pixels[0], pixels[-1], pixels[:, 0], pixels[:, -1]])
    red, green, blue = np.median(edge, axis=0)
    return float(red), float(green), float(blue)


def _weighted_median(values: NDArray[np.float64], weights: NDArray[np.float64]) -> float:
    order = np.argsort(values)
    total = np.cumsum(weights[order])
    return float(values[order][np.searchsorted(total, total[-1] / 2)])
