"""Panels that slide: two that meet in a tick, or one that hangs before its wall.

Sheets of Japan, and closets everywhere, draw two panels as the faces of the wall, a line between
them and a stroke across where they meet. A panel that hangs on a rail before the wall is a line or
a thin box beside it, as long as the way is wide, which lies partly before the way and partly before
the wall.
"""

from __future__ import annotations

import numpy as np

from veduta.plan.openings.gaps import Gap
from veduta.plan.openings.lines import runs
from veduta.plan.openings.strip import Sheet, Strip, sample

MIDDLE = (0.38, 0.62)
"""Panels meet within this part of an opening."""

ACROSS = 0.85
"""A stroke across covers so much of what is between the faces ..."""
ELSEWHERE = 0.6
"""... and columns beside it at most so much of that."""
STROKE = 0.08
"""It is no thicker than this part of the opening."""

AWAY = 0.14
"""A panel hangs before its wall by at most this part of the way's width ..."""
LENGTHS = (0.85, 1.3)
"""... is so many widths long ..."""
BEFORE = 0.3
"""... of which so much lies before the way ..."""
BESIDE = 0.08
"""... and so much before the wall: a sill ends with the way."""
BROKEN = 0.04
"""Breaks in its line, in widths."""


def meets(strip: Strip) -> bool:
    """Whether one stroke crosses an opening near its middle, and no other does elsewhere."""
    near = np.abs(strip.steps) <= max(strip.half_px, 2.0)
    dark = strip.faint[near].mean(axis=0)
    count = len(dark)
    low, high = (round(share * count) for share in MIDDLE)
    starts, ends = runs(dark >= ACROSS)
    inner = [
        (start, end)
        for start, end in zip(starts.tolist(), ends.tolist(), strict=True)
        if start > 0.06 * count and end < 0.94 * count
    ]
    if len(inner) != 1:
        return False
    start, end = inner[0]
    if start < low or end > high or end - start > max(STROKE * count, 3.0):
        return False
    rest = np.concatenate([dark[: max(start - 3, 1)], dark[end + 3 :]])
    return bool(np.median(rest) <= ELSEWHERE)


def find_panel(gap: Gap, sheet: Sheet) -> float:
    """How well a panel is drawn before the wall, 0 to 1."""
    width = gap.width_px
    way = (gap.end - gap.start) / max(width, 1e-9)
    normal = np.array([-way[1], way[0]])
    along = np.arange(-1.25 * width, 2.25 * width + 0.5)
    offsets = np.arange(gap.thickness_px / 2 + 1.5, gap.thickness_px / 2 + AWAY * width + 1.0)
    best = 0.0
    for side in (1.0, -1.0):
        points = gap.start + along[:, None] * way + side * offsets[:, None, None] * normal
        lines = (_line(row, along, width) for row in sample(sheet.faint, points) > 0)
        # A narrow gap in a thick wall has no row where a panel could hang.
        best = max([best, *lines])
    return best


def _line(row: np.ndarray, along: np.ndarray, width: float) -> float:
    """How well a row (n,) of marks shows a panel of a way of that width."""
    starts, ends = runs(_mended(row, max(1, round(BROKEN * width))))
    found = 0.0
    for start, end in zip(starts.tolist(), ends.tolist(), strict=True):
        low, high = float(along[start]), float(along[end - 1]) + 1.0
        before = min(high, width) - max(low, 0.0)
        beside = max(-low, high - width)
        sized = LENGTHS[0] * width <= high - low <= LENGTHS[1] * width
        if sized and before >= BEFORE * width and beside >= BESIDE * width:
            found = max(found, float(row[start:end].mean()))
    return found


def _mended(row: np.ndarray, most: int) -> np.ndarray:
    """The marks without breaks of so many pixels."""
    filled = row.copy()
    for low, high in zip(*runs(~row), strict=True):
        if high - low <= most and low > 0 and high < len(row):
            filled[low:high] = True
    return filled
