"""What moved between two views: where the second sees through what the first one measured.

A thing that stands still is met by the second camera's rays at the depth that the pose says, or is
hidden. If they go on to something further, it is no longer there.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.walk.build.local_model import LocalModel
from veduta.walk.build.sampling import sampled

Matrix = NDArray[np.float64]
Mask = NDArray[np.bool_]


@dataclass(frozen=True)
class MovingLimits:
    """through_px: by how much the disparity there must be smaller than that of the thing. through:
    the same, as a share of it. open_px: strips thinner than this are errors at the edges of depth.
    piece: smallest piece, as a share of the picture. grow_px: how far a piece goes on over what is
    as far away and was not met where it should be; alike: a share of the depth that is as far away.
    still_px: disparities this near are the same. rim_px: whose colours are mixed with it.
    contrast: least spread of the light (0..255) over window_px: no depth is believed of blank sky.
    """

    through_px: float = 2.0
    through: float = 0.25
    open_px: int = 7
    piece: float = 0.0015
    grow_px: int = 24
    alike: float = 0.06
    still_px: float = 1.0
    rim_px: int = 5
    contrast: float = 2.0
    window_px: int = 9


def find_moving(
    first: LocalModel, second: LocalModel, second_from_first: Matrix, stereo_px_m: float,
    limits: MovingLimits = MovingLimits(),
) -> Mask:  # fmt: skip
    """(h, w) of the first view. stereo_px_m: focal length times baseline, by which disparity is 1
    over depth.
    """
    points = first.points @ second_from_first[:, :3].T + second_from_first[:, 3]
    there, ahead = second.screen.project(points)
    inside = (there[..., 0] >= 2) & (there[..., 1] >= 2) & (ahead > 0.5)
    inside &= (there[..., 0] < second.screen.width_px - 2) & (
        there[..., 1] < second.screen.height_px - 2
    )
    pixels = np.where(inside[..., None], np.nan_to_num(there), 0.0)
    # The nearest around: an edge that is a pixel off does not look like a gap.
    nearest = cv2.erode(second.depth_m, np.ones((5, 5), np.uint8))
    known = sampled(second.measured | second.sky, pixels, nearest=True) > 0
    with np.errstate(divide="ignore", invalid="ignore"):
        expected = stereo_px_m / np.maximum(ahead, 0.5)
    seen = stereo_px_m / np.maximum(sampled(nearest, pixels, nearest=True), 0.5)
    gap = np.maximum(limits.through_px, limits.through * expected)
    through = inside & known & first.measured & (expected - seen > gap)
    through &= _spread(first.grey, limits.window_px) > limits.contrast
    side = np.ones((limits.open_px, limits.open_px), np.uint8)
    firm = cv2.morphologyEx(through.astype(np.uint8), cv2.MORPH_OPEN, side)
    _, numbers, stats, _ = cv2.connectedComponentsWithStats(firm, connectivity=8)
    large = stats[:, cv2.CC_STAT_AREA] >= limits.piece * firm.size
    large[0] = False
    met = np.abs(expected - seen) <= np.maximum(limits.still_px, 0.05 * expected)
    return _grown(np.asarray(large[numbers]), first, inside & known & met, limits)


def _spread(grey: NDArray[np.float32], window_px: int) -> NDArray[np.float32]:
    """(h, w) standard deviation of the light around."""
    size = (window_px, window_px)
    mean = cv2.blur(grey, size)
    squares = cv2.blur(grey * grey, size)
    return np.asarray(np.sqrt(np.maximum(squares - mean * mean, 0.0)), dtype=np.float32)


def _grown(found: Mask, model: LocalModel, still: Mask, limits: MovingLimits) -> Mask:
    """Over what is as far away around it, unless the second view met it where it should be, and a
    little over what stereo lost at its rim.
    """
    if not found.any():
        return found
    depth, lost = model.depth_m, ~model.measured & ~model.sky
    side = np.ones((3, 3), np.uint8)
    near = np.where(found, depth, 0.0).astype(np.float32)
    for step in range(limits.grow_px):
        around = cv2.dilate(near, side)
        beside = (near == 0.0) & (around > 0.0)
        alike = beside & ~still & (np.abs(around - depth) < limits.alike * depth)
        near = np.where(alike, depth, near)
        if 2 * step < limits.grow_px:
            near = np.where(beside & lost & ~alike, around, near)
    closed = cv2.morphologyEx((near > 0.0).astype(np.uint8), cv2.MORPH_CLOSE, np.ones((7, 7), np.uint8))
    return np.asarray(cv2.dilate(closed, np.ones((limits.rim_px, limits.rim_px), np.uint8)) > 0)
