"""Passages: ways through the house on the ground floor, for carts, cars and people.

The eyes have no class for them: they call half of them windows or doors, of a wrong size. But a
passage is dark down to the ground, wider than any window, and as high as it is wide.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.facade.boxes import Box

Float = NDArray[np.float32]
NOT_A_PASSAGE = ("vehicle", "person", "tree", "hedge", "shop", "ground", "sky")
"""Classes of the eyes that are dark in places, and no way through."""


@dataclass(frozen=True)
class PassageParameters:
    """When a dark part of the ground floor is a passage; lengths in those of a median window.

    dark: lightness, as a share of the wall's, below which a pixel counts. closed, opened: gaps
    that are closed, and bars that are taken off. filled: the least share of its rectangle that is
    dark. narrow, wide: widths of a window. low: heights of a window. slender, squat: width over
    height. foot: how far above the lowest opening's foot it may end. sure: the chance from which
    on a pixel is of what is no passage. inside: the share of an opening within a passage from
    which on it is none of its own. windows: so many tell how large one is.
    Chosen among 24 on 60 photos of `facades/street-cc0-boxes` that the eyes were trained on, all
    with passages (`arch` there): 45 are found and 41 of them are right, of 68.
    """

    dark: float = 0.55
    closed: float = 0.12
    opened: float = 0.5
    filled: float = 0.65
    narrow: float = 2.0
    wide: float = 4.5
    low: float = 1.2
    slender: float = 0.5
    squat: float = 1.25
    foot: float = 0.7
    sure: float = 0.5
    inside: float = 0.5
    windows: int = 2


def with_passages(
    boxes: Sequence[Box],
    lightness: Float,
    wall: Float,
    other: Float,
    ground: int,
    parameters: PassageParameters | None = None,
) -> list[Box]:
    """The boxes, with passages in the place of what was taken for openings there.

    lightness: (h, w) any unit. wall, other: (h, w) the chances of wall, and of `NOT_A_PASSAGE`.
    ground: the first row of the ground floor.
    """
    p = parameters or PassageParameters()
    windows = [box for box in boxes if box.kind == "window" and not box.is_inferred]
    is_wall = wall > p.sure
    if len(windows) < p.windows or not is_wall.any():
        return list(boxes)
    wide = float(np.median([box.width for box in windows]))
    high = float(np.median([box.height for box in windows]))
    foot = max(box.y + box.height for box in boxes)
    light = float(np.median(lightness[is_wall]))
    dark = (lightness < p.dark * light) & (other <= p.sure)
    found = []
    for box in _parts(dark, wide, p):
        ends_low = box.y + box.height >= foot - p.foot * high
        is_large = p.narrow * wide <= box.width <= p.wide * wide and box.height >= p.low * high
        has_shape = p.slender <= box.width / box.height <= p.squat
        if ends_low and is_large and has_shape and box.y + 0.5 * box.height >= ground:
            found.append(box)
    return [*(box for box in boxes if not _is_in(box, found, p)), *found]


def _parts(dark: NDArray[np.bool_], wide: float, p: PassageParameters) -> list[Box]:
    """Dark parts that fill their rectangles, as passages."""
    mask = dark.astype(np.uint8)
    for way, share in ((cv2.MORPH_CLOSE, p.closed), (cv2.MORPH_OPEN, p.opened)):
        side = max(1, round(share * wide))
        mask = np.asarray(cv2.morphologyEx(mask, way, np.ones((side, side), np.uint8)), np.uint8)
    _, _, stats, _ = cv2.connectedComponentsWithStats(mask)
    found = []
    for x, y, width, height, area in stats[1:].tolist():
        filled = area / (width * height)
        if filled >= p.filled:
            score = min(1.0, filled)
            found.append(Box("door", x, y, width, height, 0, None, score, is_passage=True))
    return found


def _is_in(box: Box, passages: Sequence[Box], p: PassageParameters) -> bool:
    """Whether an opening lies in a passage, or has one in it as its only part."""
    if box.kind == "balcony":
        return False
    for one in passages:
        across = min(box.x + box.width, one.x + one.width) - max(box.x, one.x)
        down = min(box.y + box.height, one.y + one.height) - max(box.y, one.y)
        shared = max(0, across) * max(0, down)
        # A wide shop front may have a passage beside its panes: it is cut around it, not left out.
        if shared > p.inside * min(box.width * box.height, 2.0 * one.width * one.height):
            return True
    return False
