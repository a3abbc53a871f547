"""Strokes of hatching, so that a hatched wall is a hollow one without them.

Hatching is many short, slanted strokes of one or two directions. The direction of ink is that of
the structure tensor (Bigun and Granlund 1987); strokes of a direction that are connected are one.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

SLANT_RAD = np.radians(15.0)
"""Hatching differs by at least this angle from the drawing's axes, along which walls run."""

WITHIN_RAD = np.radians(16.0)
"""Strokes of one hatching differ from its direction by at most this angle."""

LONGEST = 0.07
"""Strokes are at most so long, as a share of the drawing's longer side: walls are no thicker."""

LEAST_STROKES = 60
"""Fewer strokes side by side are furniture."""

SIDE_BY_SIDE = 4
"""So many strokes side by side are hatching."""

NEIGHBOURS, NEAR = 3, 2.0
"""So many others lie near a stroke, within so many times its length or the usual one."""

COHERENT = 0.3

UPRIGHT_LINES = 4.0
"""Upright lines are so many times as long as broad."""


@dataclass(frozen=True)
class _Strokes:
    """Connected ink by its number in `labels` (h, w); 0 is none.

    `middles` (n, 2), `long_px` (n,): where each is and how long; `keep` (n,): whether it counts.
    """

    labels: NDArray[np.int32]
    middles: NDArray[np.float64]
    long_px: NDArray[np.float64]
    keep: NDArray[np.bool_]

    def mask(self) -> NDArray[np.bool_]:
        return np.asarray(self.keep[self.labels], dtype=np.bool_)


def hatch_strokes(ink: NDArray[np.bool_], line_px: float) -> NDArray[np.bool_]:
    """The strokes of hatching in an (h, w) mask of ink; none where there are few."""
    angle, coherent = _directions(ink, line_px)
    slanted = ink & coherent & (_off(angle, np.pi / 2) > SLANT_RAD) & ~_upright(ink, line_px)
    found = np.zeros(ink.shape, dtype=np.bool_)
    for direction in (np.pi / 4, -np.pi / 4):
        found |= _strokes(ink, slanted, angle, direction, line_px)
    return found


def hatched_areas(strokes: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """What strokes cover that lie side by side, the paper between them with it.

    It needs no outline; but where strokes are lost it has holes.
    """
    grey = strokes.astype(np.uint8)
    gap = _usual_gap(strokes)
    count, labels = cv2.connectedComponents(grey, connectivity=8)
    square = np.ones((gap + 3, gap + 3), np.uint8)
    closed = cv2.morphologyEx(grey, cv2.MORPH_CLOSE, square)
    areas, area_of = cv2.connectedComponents(closed, connectivity=4)
    # Each stroke lies in one area.
    home = np.zeros(count, np.int64)
    home[labels[strokes]] = area_of[strokes]
    many = np.bincount(home[1:], minlength=areas) >= SIDE_BY_SIDE
    many[0] = False
    return np.asarray(many[area_of], dtype=np.bool_)


def _usual_gap(strokes: NDArray[np.bool_]) -> int:
    """Pixels of paper between neighbouring strokes along rows, three quarters of them at most."""
    row, column = np.nonzero(strokes)
    step = np.diff(column)[(np.diff(row) == 0) & (np.diff(column) > 1)] - 1
    near = step[step <= max(2, 4 * int(np.median(step)))] if len(step) else step
    return int(np.percentile(near, 75)) if len(near) else 1


def _upright(ink: NDArray[np.bool_], line_px: float) -> NDArray[np.bool_]:
    """Lines along the drawing's axes: where strokes meet them they seem to be slanted."""
    grey, long = ink.astype(np.uint8), round(UPRIGHT_LINES * line_px) + 3
    across = cv2.morphologyEx(grey, cv2.MORPH_OPEN, np.ones((1, long), np.uint8))
    down = cv2.morphologyEx(grey, cv2.MORPH_OPEN, np.ones((long, 1), np.uint8))
    return np.asarray((across > 0) | (down > 0), dtype=np.bool_)


def _strokes(
    ink: NDArray[np.bool_],
    slanted: NDArray[np.bool_],
    angle: NDArray[np.float32],
    around: float,
    line_px: float,
) -> NDArray[np.bool_]:
    """Those whose direction is within an eighth of a turn of `around`."""
    mine = slanted & (_off(angle - np.float32(around), np.pi) < np.pi / 4)
    short = _short(ink, mine, line_px)
    if short.keep.sum() < LEAST_STROKES:
        return np.zeros(ink.shape, dtype=np.bool_)
    # The commonest direction of short strokes, each counted once.
    inside = short.mask()
    bins = np.floor((angle[inside] % np.pi) / np.radians(3)).astype(int)
    counts = np.bincount(bins, minlength=60).astype(float)
    smooth = counts + np.roll(counts, 1) + np.roll(counts, -1)
    direction = np.radians(3) * (int(np.argmax(smooth)) + 0.5)
    like = mine & (_off(angle - np.float32(direction), np.pi) < WITHIN_RAD)
    short = _short(ink, like, line_px)
    if _side_by_side(short) < LEAST_STROKES:
        return np.zeros(ink.shape, dtype=np.bool_)
    return short.mask()


def _side_by_side(strokes: _Strokes) -> int:
    """How many have others beside them.

    Ticks of dimension lines, the faces of slanted walls and specks are as short, but lie apart.
    """
    kept = np.flatnonzero(strokes.keep)
    if not len(kept):
        return 0
    tree, long = KDTree(strokes.middles[kept]), strokes.long_px[kept]
    reach = NEAR * np.maximum(long, np.median(long))
    others = tree.query_ball_point(tree.data, reach, return_length=True) - 1
    return int((others >= NEIGHBOURS).sum())


def _short(ink: NDArray[np.bool_], mask: NDArray[np.bool_], line_px: float) -> _Strokes:
    """Connected parts of a mask; kept are those that are no longer than walls are broad."""
    _, labels, stats, middles = cv2.connectedComponentsWithStats(
        mask.astype(np.uint8), connectivity=8
    )
    rows, columns = np.flatnonzero(ink.any(axis=1)), np.flatnonzero(ink.any(axis=0))
    extent = max(np.ptp(rows), np.ptp(columns)) + 1 if len(rows) else 1
    long = np.hypot(stats[:, cv2.CC_STAT_WIDTH], stats[:, cv2.CC_STAT_HEIGHT])
    keep = (long <= LONGEST * extent) & (long >= 1.5 * line_px)
    keep[0] = False
    return _Strokes(np.asarray(labels, np.int32), np.asarray(middles), long, keep)


def _directions(
    ink: NDArray[np.bool_], line_px: float
) -> tuple[NDArray[np.float32], NDArray[np.bool_]]:
    """(h, w) the direction of lines at each pixel, and whether there is one direction alone."""
    grey = cv2.GaussianBlur(ink.astype(np.float32), (0, 0), max(0.7, 0.25 * line_px))
    dx, dy = cv2.Scharr(grey, cv2.CV_32F, 1, 0), cv2.Scharr(grey, cv2.CV_32F, 0, 1)
    sigma = max(1.0, 0.5 * line_px)
    xx, yy, xy = (cv2.GaussianBlur(a * b, (0, 0), sigma) for a, b in ((dx, dx), (dy, dy), (dx, dy)))
    # The direction of a line is across that of its gradient.
    angle = 0.5 * np.arctan2(2 * xy, xx - yy) + np.float32(np.pi / 2)
    spread = np.hypot(xx - yy, 2 * xy) / np.maximum(xx + yy, 1e-6)
    return np.asarray(angle, np.float32), np.asarray(spread > COHERENT, dtype=np.bool_)


def _off(angle: NDArray[np.float32], period: float) -> NDArray[np.float32]:
    """How far an angle is from the nearest multiple of the period."""
    half = np.float32(period / 2)
    return np.asarray(np.abs((angle + half) % np.float32(period) - half), np.float32)
