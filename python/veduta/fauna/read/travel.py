"""How far an animal goes over the ground, by which it is known which way it looks.

A camera that follows it may keep it in the middle of the picture; then the ground goes the other
way. What is far behind tells nothing, for a camera that moves aside shifts it less: the ground is
what is seen around the feet.
"""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.fauna.motion.figure import Floats
from veduta.fauna.read.nearer import Frames
from veduta.fauna.read.silhouettes import Masks

_LONGEST_PX = 480
"""Longer pictures are made smaller before their motion is looked for."""
_ABOVE, _BELOW, _BESIDE = 0.15, 0.3, 0.7
"""The ground about the feet: up and down from the lowest of the silhouette by these shares of its
height, aside by this share of its width.
"""
_CLEAR = 0.1
"""So much of a silhouette's width around it may still move with it."""
_TEXTURE, _SOFT_PX, _NEAR_PX = 2.5, 1.0, 5
"""Grey levels by which neighbouring pixels of a picture that is soft by so much differ nearby, at
least: where nothing is to be followed flow is none.
"""
_FEWEST = 60
"""Pixels of such ground; of fewer nothing is told."""


def travelled(masks: Masks, middle_px: Floats, pictures: Frames | None = None) -> float:
    """How far the animal has gone to the right, in widths of its silhouettes.

    masks: (t, h, w); middle_px: (t, 2) their middles; pictures: (t, h, w, 3) of the same frames.
    Without pictures, and where no ground is seen, the picture stands for the ground.
    """
    return float(gone_by_frame(masks, middle_px, pictures).sum())


def gone_by_frame(masks: Masks, middle_px: Floats, pictures: Frames | None = None) -> Floats:
    """(t - 1,) the same from frame to frame."""
    width = max(float(np.median(masks.any(axis=1).sum(axis=1))), 1.0)
    gone = np.diff(middle_px[:, 0])
    if pictures is not None:
        gone = gone - _ground(masks, pictures)
    return np.asarray(gone / width)


def _ground(masks: Masks, pictures: Frames) -> Floats:
    """(t - 1,) px by which the ground about the feet goes to the right from frame to frame."""
    shrink = min(1.0, _LONGEST_PX / max(masks.shape[1:]))
    size = (round(masks.shape[2] * shrink), round(masks.shape[1] * shrink))
    search = cv2.DISOpticalFlow.create(cv2.DISOPTICAL_FLOW_PRESET_FAST)
    grey = [_grey(picture, size) for picture in pictures]
    moved = np.zeros(len(masks) - 1)
    for row in range(len(moved)):
        ground = _about_feet(masks[row] | masks[row + 1], size) & _textured(grey[row])
        if np.count_nonzero(ground) < _FEWEST:
            continue
        flow = search.calc(grey[row], grey[row + 1], np.zeros((*size[::-1], 2), np.float32))
        moved[row] = float(np.median(flow[ground, 0])) / shrink
    return moved


def _grey(picture: Frames, size: tuple[int, int]) -> Frames:
    small = cv2.resize(np.ascontiguousarray(picture), size, interpolation=cv2.INTER_AREA)
    return np.asarray(cv2.cvtColor(small, cv2.COLOR_RGB2GRAY), dtype=np.uint8)


def _textured(grey: Frames) -> NDArray[np.bool_]:
    soft = cv2.GaussianBlur(grey.astype(np.float32), (0, 0), _SOFT_PX)
    steep = np.hypot(*np.gradient(soft)).astype(np.float32)
    return np.asarray(cv2.dilate(steep, np.ones((_NEAR_PX, _NEAR_PX), np.uint8)) > _TEXTURE)


def _about_feet(mask: NDArray[np.bool_], size: tuple[int, int]) -> NDArray[np.bool_]:
    """(h, w) in small pictures: the ground beside and under the feet, without the animal."""
    small = cv2.resize(mask.astype(np.uint8), size, interpolation=cv2.INTER_NEAREST)
    rows, columns = np.flatnonzero(small.any(axis=1)), np.flatnonzero(small.any(axis=0))
    ground = np.zeros(small.shape, dtype=np.bool_)
    if len(rows) == 0:
        return ground
    high, wide = rows[-1] - rows[0] + 1, columns[-1] - columns[0] + 1
    first = max(0, round(float(rows[-1] - _ABOVE * high)))
    left = max(0, round(float(columns[0] - _BESIDE * wide)))
    ground[
        first : round(float(rows[-1] + _BELOW * high)) + 1,
        left : round(float(columns[-1] + _BESIDE * wide)) + 1,
    ] = True
    clear = 2 * max(1, round(_CLEAR * float(wide))) + 1
    return np.asarray(ground & (cv2.dilate(small, np.ones((clear, clear), np.uint8)) == 0))
