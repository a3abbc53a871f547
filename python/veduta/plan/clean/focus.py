"""Scans out of focus made sharp: how far their edges are smeared, and that undone.

In a blurred sheet a thin wall is as wide as a line, and a line beside a wall thickens it. Edges
between full ink and paper tell the blur; the deconvolution of Richardson (1972) and Lucy (1974),
for which ink is never negative, takes it back.
"""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

SHARP_PX = 0.8
"""What a step between two pixels measures: the slope is taken over two of them."""

LEAST_BLUR_PX, MOST_BLUR_PX = 0.8, 3.0
"""Standard deviations. Less is that of a good scan; more is not undone without inventing."""

FULL = 0.8
"""An edge between ink and paper has this part of the sheet's range of greys."""

SHARPEST = 10.0
"""The percentile of the edges' widths that counts: those beside other lines look wider."""

FEWEST_EDGES = 500
REACH_PX = 5
ROUNDS = 15
MANY_PX = 3000


def blur_of(pixels: NDArray[np.uint8]) -> float:
    """The standard deviation, in pixels, of the blur of (h, w, 3) sRGB pixels; 0 if not known."""
    grey = cv2.cvtColor(pixels, cv2.COLOR_RGB2GRAY).astype(np.float32)
    step = np.array([[-0.5, 0.0, 0.5]], np.float32)
    slope = cv2.magnitude(cv2.filter2D(grey, -1, step), cv2.filter2D(grey, -1, step.T))
    around = np.ones((2 * REACH_PX + 1, 2 * REACH_PX + 1), np.uint8)
    height = cv2.dilate(grey, around) - cv2.erode(grey, around)
    low, high = np.percentile(grey[::3, ::3], (1, 99))
    edge = (height > FULL * (high - low)) & (slope > 0.1 * height) & (height > 0)
    edge &= slope >= cv2.dilate(slope, np.ones((3, 3), np.uint8))
    if np.count_nonzero(edge) < FEWEST_EDGES:
        return 0.0
    widths = height[edge] / (np.sqrt(2 * np.pi) * slope[edge])
    width = float(np.percentile(widths, SHARPEST))
    return float(np.sqrt(max(0.0, width**2 - SHARP_PX**2)))


def focused(pixels: NDArray[np.uint8], left_px: float) -> NDArray[np.uint8]:
    """(h, w, 3) sRGB pixels with their blur taken back but for `left_px` (standard deviation).

    The same where they are sharp, and on a sheet of MANY_PX a side or more: there walls are much
    wider than any blur.
    """
    if min(pixels.shape[:2]) >= MANY_PX:
        return pixels
    blur_px = min(blur_of(pixels), MOST_BLUR_PX)
    if blur_px < LEAST_BLUR_PX or blur_px <= left_px:
        return pixels
    spread_px = float(np.sqrt(blur_px**2 - left_px**2))
    seen = 256.0 - pixels.astype(np.float32)  # never zero: it is divided by
    sharp = seen.copy()
    for _ in range(ROUNDS):
        again = cv2.GaussianBlur(sharp, (0, 0), spread_px)
        sharp *= cv2.GaussianBlur(seen / again, (0, 0), spread_px)
    return np.asarray(np.clip(np.round(256.0 - sharp), 0, 255), np.uint8)
