"""Bands of one colour along a whole edge of the sheet: letterheads and side bars, with all in them.

They may be as dark as walls, and a picture in them as thick; nothing of the plan is there. A sheet
that has one colour around it on all sides is drawn on coloured paper, and has none.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

ALONG = 0.9
"""So much of the edge has the band's colour ..."""

ALIKE = 26
"""... but for this much in each channel (0 to 255)."""

FROM_PAPER = 60
"""The band's colour differs so much from that of the paper, in one channel."""

LEAST, MOST = 0.025, 0.35
"""It is so deep, as parts of the sheet's side: a strip is the scanner's, more is no margin."""

STILL = 0.4
"""Where less of a row has the band's colour, the band has ended."""


def without_letterhead(pixels: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """sRGB pixels (h, w, 3) with bands along one or two edges painted white; as given without."""
    paper = _paper(pixels)
    coloured = [turn for turn in range(4) if _colour(np.rot90(pixels, turn), paper) is not None]
    if not coloured or len(coloured) > 2:
        return pixels
    depths = {turn: _depth(np.rot90(pixels, turn), paper) for turn in coloured}
    deep = [turn for turn in coloured if depths[turn]]
    if not deep:
        return pixels
    cleared = pixels.copy()
    for turn in deep:
        np.rot90(cleared, turn)[: depths[turn]] = 255
    return cleared


def _paper(pixels: NDArray[np.uint8]) -> NDArray[np.float64]:
    """The commonest colour (3,), in steps of 16, of the middle of the sheet."""
    height, width = pixels.shape[:2]
    middle = pixels[height // 4 : -(height // 4), width // 8 : -(width // 8)][::3, ::3]
    steps, counts = np.unique(middle.reshape(-1, 3) // 16, axis=0, return_counts=True)
    return np.asarray(16.0 * steps[int(counts.argmax())] + 8.0)


def _colour(pixels: NDArray[np.uint8], paper: NDArray[np.float64]) -> NDArray[np.float64] | None:
    """The one colour (3,) of the first rows, if they have one and it is not that of the paper."""
    inset = _inset(pixels)
    rows = pixels[inset : inset + 3].astype(np.float64)
    colour = np.asarray(np.median(rows.reshape(-1, 3), axis=0))
    alike = np.abs(rows - colour).max(axis=2) <= ALIKE
    far = np.abs(colour - paper).max() >= FROM_PAPER
    return colour if far and alike.mean(axis=1).min() >= ALONG else None


def _inset(pixels: NDArray[np.uint8]) -> int:
    """So many rows at the very edge may be anything."""
    return max(2, round(0.004 * len(pixels)))


def _depth(pixels: NDArray[np.uint8], paper: NDArray[np.float64]) -> int:
    """How deep the band along the first rows is; 0 without one."""
    colour = _colour(pixels, paper)
    if colour is None:
        return 0
    height, inset = len(pixels), _inset(pixels)
    most = round(MOST * height)
    alike = np.abs(pixels[: most + 1].astype(np.int16) - colour).max(axis=2) <= ALIKE
    share = alike.mean(axis=1)
    ended = np.flatnonzero(share[inset:] < STILL)
    depth = inset + int(ended[0]) if len(ended) else height
    # The edge of the band is soft.
    return depth + 2 if LEAST * height <= depth <= most else 0
