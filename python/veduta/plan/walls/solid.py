"""Where a sheet is solid wall: thick strokes told from thin lines."""

from __future__ import annotations

import math
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.plan.walls.runs import run_lengths, run_lengths_down

LEAST_SHARE = 0.25
"""The thickest walls are together at least this part of the drawing's half perimeter."""

THINNEST_WALL = 0.3
"""The thinnest wall is at least this part of the thickest common one."""

THINNEST_COMMON = 0.15
"""Or this part of it, where strokes of one thickness are as common as the thickest walls."""

OVER_LINE = 2.2
"""Such are at least so many times as thick as lines ..."""

PARTED = 0.2
"""... and parted from these by thicknesses that are this rare beside theirs."""

OF_THICKER = 0.25
"""And so long, as a part of all that is thicker: leaves of doors and frames of windows are not."""

BELOW_COMMON = 0.75
"""What is thinner than them by this factor is no wall."""

PALE_PX = 1.0
"""So much of the breadth of a stroke may be lost in its edges."""

LEAST_OVER_LINE = 1.6
"""Walls are at least so many times as thick as lines."""

SINGLE_LINE = 4.0
"""Walls that are thinner than so many lines may be lines themselves, of a broader pen."""

ACROSS, SINGLE_LONG = 8, 0.02
"""Strokes that tell pens apart are so many times as long as broad, and so long as a share of the
half perimeter: no letters."""

PEN_EDGE = 0.65
"""Lines are walls if they are nearer to the broad pen than to the thin one: leaves of doors may be
broader than other lines."""

PEN_SHARE = 0.4
"""The thin pen draws at least so much, as a part of what the walls are asked for."""

LEAST_MARK = 4.0
"""Connected ink is part of the house if so many times as long as its walls are thick."""


@dataclass(frozen=True)
class Thickness:
    """Of walls on a sheet, in pixels: the thinnest that counts, and the thickest common one."""

    least_px: float
    most_px: float


def wall_thickness(ink: NDArray[np.bool_], line_px: float) -> Thickness | None:
    """How thick the solid walls of a mask of ink are; None where there are no thick strokes.

    Lengths of straight strokes by thickness: at each pixel the shorter of its two runs, where the
    longer is three times as long.
    """
    across, down = run_lengths(ink), run_lengths_down(ink)
    thin, long = np.minimum(across, down), np.maximum(across, down)
    stroke = ink & (long >= 3 * thin)
    lengths = _lengths(thin[stroke])
    extent = half_perimeter(ink)
    at_least = np.cumsum(lengths[::-1])[::-1]
    thick = np.flatnonzero(at_least >= LEAST_SHARE * extent)
    most = float(thick[-1]) if len(thick) else 0.0
    least = max(LEAST_OVER_LINE * line_px, THINNEST_WALL * most)
    # Thin walls hang on thick ones; a frame around the sheet, or furniture, is not of the house.
    hanging = _lengths(thin[_hanging_on(ink, stroke, thin >= least)])
    least = _with_thin_walls(hanging, line_px, Thickness(least, most), LEAST_SHARE * extent)
    if most >= SINGLE_LINE * line_px and most >= least:
        return Thickness(least, most)
    # A pen that is twice as broad as another draws a wall as one line.
    straight = ink & (long >= ACROSS * thin) & (long >= SINGLE_LONG * extent)
    pens = two_pens(_lengths(thin[straight]), LEAST_SHARE * extent)
    if pens is None and most >= max(2 * line_px, least):
        return Thickness(least, most)
    return pens


def _lengths(thin: NDArray[np.int32]) -> NDArray[np.float64]:
    """How long strokes of 0, 1, 2... pixels are; `thin` (n,) is how thick, at each pixel."""
    counts = np.bincount(thin, minlength=4).astype(np.float64)
    return np.asarray(counts / np.maximum(1, np.arange(len(counts))))


def _hanging_on(
    ink: NDArray[np.bool_], stroke: NDArray[np.bool_], thick: NDArray[np.bool_]
) -> NDArray[np.bool_]:
    """The strokes of what is one piece of ink with a thick stroke."""
    count, labels = cv2.connectedComponents(ink.astype(np.uint8), connectivity=8)
    has_thick = np.zeros(count, dtype=bool)
    has_thick[labels[stroke & thick]] = True
    has_thick[0] = False
    return np.asarray(stroke & has_thick[labels])


def _with_thin_walls(
    lengths: NDArray[np.float64], line_px: float, thickness: Thickness, enough_px: float
) -> float:
    """The thinnest wall that counts, where there are so many thin walls that they count, too.

    `lengths` are those of strokes of 0, 1, 2... pixels, `thickness` what counts without them.
    """
    low, high = THINNEST_COMMON * thickness.most_px, thickness.least_px
    line = LEAST_OVER_LINE * line_px
    # Where edges are pale, some of the walls that are just thick enough seem to be too thin.
    for highest in (high, high + PALE_PX):
        thin = _thin_walls(lengths, line_px, (low, highest))
        if thin is None:
            continue
        # Lines are no walls, however near in breadth; nothing is compared with itself.
        own = lengths[max(thin - 1, math.floor(line) + 1) : thin + 2].sum()
        thicker = lengths[max(math.ceil(high), thin + 2) :].sum()
        if own >= max(enough_px, OF_THICKER * thicker):
            return min(high, max(line, BELOW_COMMON * thin))
    return high


def _thin_walls(
    lengths: NDArray[np.float64], line_px: float, between_px: tuple[float, float]
) -> int | None:
    """The commonest thickness between two that is parted from lines; None where none is.

    `lengths` are those of strokes of 0, 1, 2... pixels.
    """
    low, high = max(between_px[0], OVER_LINE * line_px), between_px[1]
    near = np.arange(math.ceil(low), min(math.floor(high) + 2, len(lengths)))
    if len(near) == 0:
        return None
    best = int(near[np.argmax(lengths[near])])
    valley = lengths[max(1, round(line_px)) : best]
    if best > high or not len(valley) or valley.min() > PARTED * lengths[best]:
        return None
    return best


def two_pens(lengths: NDArray[np.float64], least_length: float) -> Thickness | None:
    """The broader of two pens, by the lengths of lines of 0, 1, 2... pixels; None if there is one.

    Parted where the variance within both is least (Otsu 1979), on the logarithm of the width.
    """
    width = np.arange(1, len(lengths))
    length, place = lengths[1:], np.log(width)
    best: tuple[float, Thickness] | None = None
    for cut in range(1, len(width)):
        low, high = length[:cut], length[cut:]
        if low.sum() < PEN_SHARE * least_length or high.sum() < least_length:
            continue
        means = [
            float(np.average(place[part], weights=length[part]))
            for part in (slice(None, cut), slice(cut, None))
        ]
        between = low.sum() * high.sum() * (means[1] - means[0]) ** 2
        if means[1] - means[0] > np.log(LEAST_OVER_LINE) and (best is None or between > best[0]):
            edge = float(np.exp((1 - PEN_EDGE) * means[0] + PEN_EDGE * means[1]))
            best = between, Thickness(edge, float(np.exp(means[1])))
    return None if best is None else best[1]


def thick_strokes(ink: NDArray[np.bool_], thickness: Thickness) -> NDArray[np.bool_]:
    """The mask of what is at least as thick as the thinnest wall, letters and marks with it."""
    reach = max(2, round(0.85 * thickness.least_px))
    square = np.ones((reach, reach), np.uint8)
    grey = ink.astype(np.uint8)
    disc = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (reach, reach))
    # A square keeps the corners of upright walls, a disc follows slanted ones.
    opened = np.maximum(
        cv2.morphologyEx(grey, cv2.MORPH_OPEN, square), cv2.morphologyEx(grey, cv2.MORPH_OPEN, disc)
    )
    return opened.astype(np.bool_)


def without_marks(
    strokes: NDArray[np.bool_], ink: NDArray[np.bool_], thickness: Thickness
) -> NDArray[np.bool_]:
    """Thick strokes of connected ink that is large enough for a house."""
    return strokes & marks_of_size(ink, LEAST_MARK * thickness.most_px)


def stroke_length(mask: NDArray[np.bool_], least_px: float) -> float:
    """How long the strokes that are at least so thick are together."""
    across, down = run_lengths(mask), run_lengths_down(mask)
    thin, long = np.minimum(across, down), np.maximum(across, down)
    stroke = mask & (long >= 2 * thin) & (thin >= least_px)
    return float((1.0 / np.maximum(thin[stroke], 1)).sum())


def marks_of_size(
    ink: NDArray[np.bool_], least_px: float, *, both_ways: bool = False
) -> NDArray[np.bool_]:
    """Connected ink of at least that size, one way or both: letters and specks are smaller."""
    _, labels, stats, _ = cv2.connectedComponentsWithStats(ink.astype(np.uint8), connectivity=8)
    size = np.minimum if both_ways else np.maximum
    keep = size(stats[:, cv2.CC_STAT_WIDTH], stats[:, cv2.CC_STAT_HEIGHT]) >= least_px
    keep[0] = False
    return np.asarray(keep[labels], dtype=np.bool_)


def half_perimeter(ink: NDArray[np.bool_]) -> float:
    """Of the box around all ink, px; 1 where there is none."""
    rows, columns = np.flatnonzero(ink.any(axis=1)), np.flatnonzero(ink.any(axis=0))
    if len(rows) == 0:
        return 1.0
    return float(rows[-1] - rows[0] + columns[-1] - columns[0] + 2)
