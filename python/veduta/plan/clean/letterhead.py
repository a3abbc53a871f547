"""Bands of one colour along a whole edge of the sheet: letterheads and side bars, with all in them.

They may be as dark as walls, and a picture in them as thick; nothing of the plan is there. A sheet
that has one colour around it on all sides is drawn on coloured paper, and has none. Where the plan
is cut off at its outer walls, these are no band.
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

EDGE = 45
"""What lies beyond a band differs so much from it, in one channel: paper in shadow fades slowly."""

WALL = 0.08
"""No wall is deeper than this part of the sheet's side. What is not is wall, not band, ..."""

DRAWN_WITH = 0.002
"""... where so much of the rest of the sheet has its colour, ..."""

MET = 0.25
"""... and strokes of that colour meet it, together as broad as this part of its depth."""

SOFT_PX = 2
"""The edge of the band is soft."""


def letterhead(pixels: NDArray[np.uint8]) -> dict[int, int]:
    """How many pixels deep the bands of sRGB pixels (h, w, 3) are, by quarter turns.

    After so many of numpy's quarter turns (`rot90`) a band lies along the first rows.
    """
    paper = _paper(pixels)
    coloured = [turn for turn in range(4) if _colour(np.rot90(pixels, turn), paper) is not None]
    if not coloured or len(coloured) > 2:
        return {}
    depths = {turn: _depth(np.rot90(pixels, turn), paper) for turn in coloured}
    return {
        turn: depth
        for turn, depth in depths.items()
        if depth and not _is_wall(np.rot90(pixels, turn), depth, paper)
    }


def without_letterhead(pixels: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """sRGB pixels (h, w, 3) with bands painted in the paper's colour; as given without bands."""
    bands = letterhead(pixels)
    if not bands:
        return pixels
    cleared, paper = pixels.copy(), np.round(_paper(pixels))
    for turn, depth in bands.items():
        np.rot90(cleared, turn)[:depth] = paper
    return cleared


def within_letterhead(pixels: NDArray[np.uint8]) -> NDArray[np.bool_] | None:
    """(h, w) where bands are; None without any."""
    bands = letterhead(pixels)
    if not bands:
        return None
    within = np.zeros(pixels.shape[:2], np.bool_)
    for turn, depth in bands.items():
        np.rot90(within, turn)[:depth] = True
    return within


def _paper(pixels: NDArray[np.uint8]) -> NDArray[np.float64]:
    """The commonest colour (3,) of the middle of the sheet: the mean of a step of 16."""
    height, width = pixels.shape[:2]
    middle = pixels[height // 4 : -(height // 4), width // 8 : -(width // 8)][::3, ::3]
    colours = middle.reshape(-1, 3)
    # One number for each step: sorting rows of three takes seconds on a large scan.
    step = (colours // 16).astype(np.int64) @ (256, 16, 1)
    return np.asarray(colours[step == np.bincount(step).argmax()].mean(axis=0))


def _colour(pixels: NDArray[np.uint8], paper: NDArray[np.float64]) -> NDArray[np.float64] | None:
    """The one colour (3,) of the first rows, if they have one and it is not that of the paper."""
    inset = _inset(pixels)
    rows = pixels[inset : inset + 3]
    colour = np.asarray(np.median(rows.reshape(-1, 3), axis=0))
    far = np.abs(colour - paper).max() >= FROM_PAPER
    return colour if far and _alike(rows, colour).mean(axis=1).min() >= ALONG else None


def _alike(pixels: NDArray[np.uint8], colour: NDArray[np.float64]) -> NDArray[np.bool_]:
    """(h, w) where pixels have a colour (3,). Bounds of whole numbers: no copy of a large scan."""
    low = np.ceil(np.maximum(colour - ALIKE, 0.0)).astype(np.uint8)
    high = np.floor(np.minimum(colour + ALIKE, 255.0)).astype(np.uint8)
    return np.asarray(((pixels >= low) & (pixels <= high)).all(axis=2))


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
    share = _alike(pixels[: most + 1], colour).mean(axis=1)
    ended = np.flatnonzero(share[inset:] < STILL)
    depth = inset + int(ended[0]) if len(ended) else height
    if not LEAST * height <= depth <= most:
        return 0
    beyond = np.median(pixels[depth + SOFT_PX : depth + SOFT_PX + 3].reshape(-1, 3), axis=0)
    return depth + SOFT_PX if np.abs(beyond - colour).max() >= EDGE else 0


def _is_wall(pixels: NDArray[np.uint8], depth: int, paper: NDArray[np.float64]) -> bool:
    """Whether the band along the first rows is an outer wall, at which the picture ends."""
    colour = _colour(pixels, paper)
    if colour is None or depth > WALL * len(pixels):
        return False
    alike = _alike(pixels[depth:], colour)
    met = int(alike[SOFT_PX : 2 * SOFT_PX].all(axis=0).sum())
    return bool(met >= MET * depth and alike.mean() >= DRAWN_WITH)
