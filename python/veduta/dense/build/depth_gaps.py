"""Depths of one view made ready for a mesh of its own: small gaps closed, noise calmed."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

Floats = NDArray[np.float64]
UNLIKE = 50.0
"""Logarithm of an inverse depth that is like no other."""


@dataclass(frozen=True)
class GapParameters:
    """gap_px: a gap of so many pixels without a depth is closed if what is around it is one surface.
    step: share by which depths beside each other differ where one surface ends and another
    begins. window_px, spread_px: of the mean that calms depths of one surface.
    """

    gap_px: int = 80
    step: float = 0.03
    window_px: int = 5
    spread_px: float = 1.5


def closed_gaps(depths_m: NDArray[np.float32], rule: GapParameters) -> NDArray[np.float32]:
    """(h, w) depths along the camera's z, NaN where unknown, with their small gaps closed.

    A gap is a piece of unknown pixels within the picture. Its depths are those of a skin that is
    stretched over it (the inverse depth of each pixel is the mean of those beside it).
    """
    known = np.isfinite(depths_m)
    pieces, count = ndimage.label(~known)
    if not count or not known.any():
        return depths_m
    sizes = np.bincount(pieces.ravel(), minlength=count + 1)
    small = sizes <= rule.gap_px
    frame = np.concatenate([pieces[0], pieces[-1], pieces[:, 0], pieces[:, -1]])
    small[frame] = small[0] = False
    if not small.any():
        return depths_m
    inverse = np.where(known, 1.0 / np.where(known, depths_m, 1.0), 0.0).astype(np.float64)
    # What lies around a gap must be one surface: from pixel to pixel it has no step.
    wide = ndimage.maximum_filter(np.where(small[pieces], pieces, 0), 3)
    ring = known & (wide > 0)
    index = np.arange(count + 1)
    low = ndimage.minimum(inverse[ring], wide[ring], index)
    high = ndimage.maximum(inverse[ring], wide[ring], index)
    reach = np.sqrt(sizes) + 1.0
    small &= np.asarray(high) <= np.asarray(low) * (1.0 + rule.step * np.minimum(reach, 4.0))
    gap = small[pieces]
    if not gap.any():
        return depths_m
    filled = _stretched(inverse, known, gap, rounds=2 * int(np.sqrt(rule.gap_px)))
    return np.where(gap, 1.0 / np.where(gap, filled, 1.0), depths_m).astype(np.float32)


def _stretched(
    inverse: Floats, known: NDArray[np.bool_], gap: NDArray[np.bool_], rounds: int
) -> Floats:
    """The inverse depths with those of gaps as means of what is beside them, again and again."""
    nearest = ndimage.distance_transform_edt(~known, return_distances=False, return_indices=True)
    found = np.where(gap, inverse[tuple(nearest)], inverse)
    has = (known | gap).astype(np.float64)
    count = np.maximum(cv2.blur(has, (3, 3), borderType=cv2.BORDER_CONSTANT), 1e-9)
    for _ in range(rounds):
        mean = cv2.blur(found * has, (3, 3), borderType=cv2.BORDER_CONSTANT) / count
        found = np.where(gap, mean, found)
    return np.asarray(found)


def calmed(depths_m: NDArray[np.float32], rule: GapParameters) -> NDArray[np.float32]:
    """The depths with less noise: each the mean of those around it that are of the same surface.

    The mean of inverse depths (their logarithms, which are the same for so small differences), with
    weights that fall with the distance and with the difference; nothing is carried over a step.
    """
    known = np.isfinite(depths_m)
    if not known.any():
        return depths_m
    logs = np.where(known, -np.log(np.where(known, depths_m, 1.0)), UNLIKE).astype(np.float32)
    # Beyond the picture a slanted plane goes on as it came.
    rim = rule.window_px // 2
    wide = np.pad(logs, rim, mode="reflect", reflect_type="odd") if rim else logs
    calm = cv2.bilateralFilter(wide, rule.window_px, rule.step, rule.spread_px)
    calm = calm[rim : rim + logs.shape[0], rim : rim + logs.shape[1]]
    return np.where(known, np.exp(-calm), np.nan).astype(np.float32)
