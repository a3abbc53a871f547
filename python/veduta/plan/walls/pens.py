"""Walls that are drawn as one line of a broader pen, told from lines by how much ink these have.

Blur, resampling and the threshold of ink change how broad a stroke looks, by whole pixels and the
thin ones the most. How much ink lies across it they do not: of lines that are 2.5 and 4.5 px broad,
and look 4 and 6 px broad when blurred, the ink is still that of 2.5 and 4.5 px.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from veduta.plan.walls.runs import run_lengths, run_lengths_down, run_sums
from veduta.plan.walls.solid import (
    ACROSS,
    LEAST_SHARE,
    PEN_SHARE,
    SINGLE_LONG,
    Thickness,
    half_perimeter,
    marks_of_size,
)

BROADER = 1.3
"""The pen of walls is so many times as broad as that of lines, or more."""

BIN = 1.04
"""Widths are counted in steps of so much."""

VALLEY = 0.35
"""Between two pens there is at most this part of what the lesser one draws, at one width."""

SAME = 0.05
"""Cuts that tell the strokes apart alike, but for this part of the ink, are one."""

MEETING = 0.5
"""Walls meet: so much of what their pen draws, or more, is in pieces that have a corner."""

FRAME, BARE = 0.8, 1.25
"""A piece that is this part of all, and has no more ink than lines around its bounds by this
factor, is the border of the sheet."""

CORNER = 3.0
"""A piece has one if it is so many times as broad as its pen, both ways."""

HALO_PX = 2.5
"""The soft edge of a stroke reaches so far beyond what was told to be ink."""

SLANTED = 4.0
"""What is not upright is judged by its own ink if it is so many times as long as broad."""


@dataclass(frozen=True)
class Pen:
    """What the pen of the walls drew: `mask` (h, w), and how broad it is."""

    mask: NDArray[np.bool_]
    thickness: Thickness


@dataclass(frozen=True)
class _Strokes:
    """Which marks are of long upright strokes, and the ink across all of them: (h, w), px.

    `thin` (h, w): how broad they look. `rest` (h, w): the pieces of what is not straight, 0 where
    there is none; `rest_size` and `rest_width` (p + 1,) their diagonals and the ink across, px.
    """

    straight: NDArray[np.bool_]
    width: NDArray[np.float32]
    thin: NDArray[np.int32]
    rest: NDArray[np.int32]
    rest_size: NDArray[np.float64]
    rest_width: NDArray[np.float64]


def broader_pens(ink: NDArray[np.float32], mask: NDArray[np.bool_]) -> list[Pen]:
    """The pens that may have drawn the walls, the likeliest first; none where there is one pen.

    ink: (h, w), 0 paper to 1 ink. mask: (h, w) of what counts as ink, without texts.
    """
    extent = half_perimeter(mask)
    strokes = _strokes(ink, mask, extent)
    at = strokes.straight
    if not at.any():
        return []
    pens: list[Pen] = []
    for cut, broad in _cuts(strokes.width[at], 1.0 / strokes.thin[at], extent):
        drawn = _drawn_by(strokes, cut)
        new = all((drawn ^ one.mask).sum() > SAME * drawn.sum() for one in pens)
        if new and _meet(drawn, CORNER * broad) and not _is_frame(drawn, broad):
            pens.append(Pen(drawn, Thickness(cut, broad)))
    return pens


def _strokes(ink: NDArray[np.float32], mask: NDArray[np.bool_], extent: float) -> _Strokes:
    gathered = _gathered(ink, mask)
    across, down = run_lengths(mask), run_lengths_down(mask)
    thin, long = np.minimum(across, down), np.maximum(across, down)
    straight = mask & (long >= ACROSS * thin) & (long >= SINGLE_LONG * extent)
    turned = np.ascontiguousarray(gathered.T), np.ascontiguousarray(mask.T)
    row, column = run_sums(gathered, mask), run_sums(*turned).T
    # Through a stroke of width w that is turned by t, these are w / sin t and w / cos t.
    width = (row * column / np.maximum(np.hypot(row, column), 1e-9)).astype(np.float32)
    return _Strokes(straight, width, thin, *_pieces(mask & ~straight, width))


def _pieces(
    mask: NDArray[np.bool_], width: NDArray[np.float32]
) -> tuple[NDArray[np.int32], NDArray[np.float64], NDArray[np.float64]]:
    """The connected pieces of a mask (h, w), with their diagonals and median widths (p + 1,)."""
    count, labels, stats, _ = cv2.connectedComponentsWithStats(
        mask.astype(np.uint8), connectivity=8
    )
    size = np.hypot(stats[:, cv2.CC_STAT_WIDTH], stats[:, cv2.CC_STAT_HEIGHT])
    median = np.zeros(count)
    if count > 1:
        median[1:] = ndimage.median(width[mask], np.asarray(labels[mask]), np.arange(1, count))
    return np.asarray(labels, dtype=np.int32), size, median


def _gathered(ink: NDArray[np.float32], mask: NDArray[np.bool_]) -> NDArray[np.float32]:
    """(h, w) the ink of each pixel of the mask, and of what lies nearest to it around."""
    away, nearest = cv2.distanceTransformWithLabels(
        (~mask).astype(np.uint8), cv2.DIST_L2, cv2.DIST_MASK_5, labelType=cv2.DIST_LABEL_PIXEL
    )
    near = away <= HALO_PX
    sums = np.bincount(nearest[near], weights=ink[near], minlength=int(nearest.max()) + 1)
    return np.where(mask, sums[nearest], 0.0).astype(np.float32)


def _cuts(
    width: NDArray[np.float32], length: NDArray[np.float64], extent: float
) -> list[tuple[float, float]]:
    """Widths (n,) px that part two pens, with how broad the broader one is; the clearest first.

    `length` (n,) is how much of a stroke each width stands for. A cut lies where few strokes are
    that broad, between two pens (Otsu 1979, on the logarithm).
    """
    place = np.log(np.maximum(width, 0.5)) / np.log(BIN)
    first = int(place.min()) - 1
    count = np.bincount((place - first).astype(int), weights=length)
    soft = np.convolve(count, [0.25, 0.5, 0.25], "same")
    steps = np.arange(len(count))
    found = []
    for at in _valleys(soft):
        low, high = count[:at], count[at:]
        enough = PEN_SHARE * LEAST_SHARE * extent, LEAST_SHARE * extent
        if low.sum() < enough[0] or high.sum() < enough[1]:
            continue
        thin = float(np.average(steps[:at], weights=low))
        broad = float(np.average(steps[at:], weights=high))
        if (broad - thin) * np.log(BIN) < np.log(BROADER):
            continue
        if soft[at] > VALLEY * min(soft[:at].max(), soft[at:].max()):
            continue
        between = low.sum() * high.sum() * (broad - thin) ** 2
        found.append((between, BIN ** (at + first), BIN ** (broad + 0.5 + first)))
    return [(cut, broad) for _, cut, broad in sorted(found, reverse=True)]


def _valleys(counts: NDArray[np.float64]) -> list[int]:
    """The middles of where counts are lowest between two peaks."""
    edges = np.flatnonzero(np.diff(counts))
    bounds = np.concatenate([[0], edges + 1, [len(counts)]])
    level = counts[bounds[:-1]]
    return [
        int((bounds[n] + bounds[n + 1]) // 2)
        for n in range(1, len(level) - 1)
        if level[n - 1] > level[n] < level[n + 1]
    ]


def _drawn_by(strokes: _Strokes, cut: float) -> NDArray[np.bool_]:
    """The mask of strokes that have so much ink across, and of what joins them."""
    broad = strokes.straight & (strokes.width >= cut)
    touched = np.zeros(len(strokes.rest_size), dtype=bool)
    near = cv2.dilate(broad.astype(np.uint8), np.ones((3, 3), np.uint8)) > 0
    touched[strokes.rest[near]] = True
    keep = np.where(strokes.rest_size >= SLANTED * cut, strokes.rest_width >= cut, touched)
    keep[0] = False
    return np.asarray(broad | keep[strokes.rest], dtype=np.bool_)


def _meet(mask: NDArray[np.bool_], least_px: float) -> bool:
    """Whether most of a mask lies in pieces that run both across and down."""
    cornered = marks_of_size(mask, least_px, both_ways=True)
    return bool(cornered.sum() >= MEETING * mask.sum())


def _is_frame(mask: NDArray[np.bool_], broad_px: float) -> bool:
    """Whether most of a mask is a rectangle of lines around the rest, as of a sheet's border."""
    _, _, stats, _ = cv2.connectedComponentsWithStats(mask.astype(np.uint8), connectivity=8)
    largest = stats[1:][np.argmax(stats[1:, cv2.CC_STAT_AREA])]
    around = largest[cv2.CC_STAT_WIDTH] + largest[cv2.CC_STAT_HEIGHT]
    area = largest[cv2.CC_STAT_AREA]
    alone = area >= FRAME * mask.sum()
    return bool(alone and area <= BARE * 2 * around * broad_px)
