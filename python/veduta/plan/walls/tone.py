"""Walls filled with a tone between those of paper and lines: grey, or hatched too finely to see."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.plan.walls.cells import NARROW, longer_side

LEAST_TONE = 0.2
"""Paler than this part of the darkest ink is no wall, but a shaded floor."""

FULL_TONE = 0.85
"""Darker than this part of it is not a tone, but ink."""

WITHIN = 0.35
"""What is paler or darker by this part of the tone is another one."""

LEAST_LENGTH = 1.0
"""Walls are together at least so many times as long as the longer side of the drawing."""


def toned_areas(ink: NDArray[np.float32], line_px: float) -> NDArray[np.bool_]:
    """The (h, w) mask of what is filled with the commonest tone of narrow areas; empty without one.

    `ink` is 0 on paper to 1. Lines are no areas, and rooms are too broad.
    """
    core = _cores(ink > LEAST_TONE, line_px)
    level = _commonest(ink[core])
    nothing = np.zeros(ink.shape, dtype=np.bool_)
    if level is None or level > FULL_TONE:
        return nothing
    like = core & (np.abs(ink - np.float32(level)) < WITHIN * level)
    # The middle of a band is a pixel wide for each pixel of its length.
    depth = cv2.distanceTransform(like.astype(np.uint8), cv2.DIST_L2, 3)
    middle = (depth > 0) & (depth >= cv2.dilate(depth, np.ones((3, 3), np.uint8)) - 0.05)
    if middle.sum() < LEAST_LENGTH * longer_side(ink > 0.5):
        return nothing
    reach = 2 * round(line_px) + 3
    near = cv2.dilate(like.astype(np.uint8), np.ones((reach, reach), np.uint8)) > 0
    toned = near & (ink > (1 - WITHIN) * level)
    # Grain leaves holes.
    return np.asarray(
        cv2.morphologyEx(toned.astype(np.uint8), cv2.MORPH_CLOSE, np.ones((3, 3), np.uint8)) > 0,
        dtype=np.bool_,
    )


def _cores(mask: NDArray[np.bool_], line_px: float) -> NDArray[np.bool_]:
    """The mask without lines and without what is broader than walls."""
    grey = mask.astype(np.uint8)
    thin, broad = round(2 * line_px) + 1, round(NARROW * longer_side(mask)) + 1
    areas = cv2.morphologyEx(grey, cv2.MORPH_OPEN, np.ones((thin, thin), np.uint8))
    rooms = cv2.morphologyEx(grey, cv2.MORPH_OPEN, np.ones((broad, broad), np.uint8))
    inside = cv2.erode(areas, np.ones((3, 3), np.uint8))
    return np.asarray((inside > 0) & (rooms == 0), dtype=np.bool_)


def _commonest(values: NDArray[np.float32]) -> float | None:
    """The peak of their histogram; None for few values."""
    if values.size < 100:
        return None
    counts, edges = np.histogram(values, bins=40, range=(0.0, 1.0))
    smooth = np.convolve(counts, [0.5, 1.0, 0.5], "same")
    best = int(np.argmax(smooth))
    return float(edges[best] + edges[best + 1]) / 2
