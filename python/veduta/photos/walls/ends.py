"""Where a wall ends: strays beyond it are not taken for it, corners are closed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from veduta.photos.walls.wall import Wall

THIN = 0.15
"""Density of strays beyond a wall's end, as a part of its own."""
STRAYS = 0.01
"""Share of the points that may be strays at an end: more are a part of the wall with fewer points,
for on real walls they lie unevenly."""
SURE = 6.0
"""Logarithm of how much likelier the step has to make the points."""
_END_SHARE = 0.35
"""Part of a wall's extent, at either end, whose density is that of its end."""
CLUMP = 2.0
"""Longest clump beyond a gap, in gaps."""
_FEWEST = 12
INWARD = 0.3
"""How far an end may be moved inward to a corner, as a part of how far outward."""
SQUARE = 0.5
"""Least sine of the angle of two walls that meet in a corner: 30 degrees."""


def dense_range(places: NDArray[np.float64], gap: float = np.inf) -> tuple[float, float]:
    """Lower and upper end of (n,) places on a line, without thin tails.

    First a clump beyond a gap is left out, if it is no longer than twice the gap: the edge of a
    wall that crosses the line there, as on the other side of an alley.

    At each end a step in density is looked for: points beyond it are strays, `THIN` times as dense
    as those within. Of all steps that is taken which makes the points most likely (Poisson); the
    outermost point where none does by far.
    """
    order = np.sort(places)
    if len(order) < _FEWEST:
        return float(order[0]), float(order[-1])
    order = _without_clumps(order, gap)
    return -_upper_end(-order[::-1]), _upper_end(order)


def _without_clumps(order: NDArray[np.float64], gap: float) -> NDArray[np.float64]:
    """The sorted places without clumps beyond a gap at either end."""
    wide = np.flatnonzero(np.diff(order) > gap)
    above = [k for k in wide.tolist() if order[-1] - order[k + 1] <= CLUMP * gap]
    below = [k for k in wide.tolist() if order[k] - order[0] <= CLUMP * gap]
    first, last = max(below, default=-1) + 1, min(above, default=len(order) - 1) + 1
    return order[first:last] if last - first >= _FEWEST else order


def _upper_end(order: NDArray[np.float64]) -> float:
    low, high = np.quantile(order, [0.02, 0.98])
    within = (order >= high - _END_SHARE * (high - low)) & (order <= high)
    extent = high - float(order[within][0])
    if extent <= 0.0:
        return float(order[-1])
    density = int(within.sum()) / extent
    beyond = np.arange(len(order))[::-1]
    outer = beyond <= max(2, int(STRAYS * len(order)))
    length = order[-1] - order[outer]
    gain = (1.0 - THIN) * density * length + beyond[outer] * np.log(THIN)
    best = int(gain.argmax())
    return float(order[outer][best] if gain[best] >= SURE else order[-1])


def with_closed_corners(walls: Sequence[Wall], reach: float) -> list[Wall]:
    """The walls, with two ends that nearly meet brought to where their lines cross.

    reach: how far an end may be moved. Ends are tried from the nearest pair on, each once.
    """
    found = list(walls)
    ends = np.array([[wall.start, wall.end] for wall in walls]).reshape(-1, 2)
    pairs = []
    for one in range(len(ends)):
        apart = np.linalg.norm(ends[one + 1 :] - ends[one], axis=1)
        for other in (np.flatnonzero(apart <= 2.0 * reach) + one + 1).tolist():
            if one // 2 != other // 2:
                pairs.append((float(apart[other - one - 1]), one, int(other)))
    moved: set[int] = set()
    for _, one, other in sorted(pairs):
        if moved & {one, other}:
            continue
        corner = _crossing(found[one // 2], found[other // 2])
        if corner is None:
            continue
        if not all(_may_move(found[end // 2], end % 2, corner, reach) for end in (one, other)):
            continue
        for end in (one, other):
            wall = found[end // 2]
            found[end // 2] = (
                replace(wall, start=corner) if end % 2 == 0 else replace(wall, end=corner)
            )
        moved |= {one, other}
    return found


def _may_move(wall: Wall, end: int, corner: NDArray[np.float64], reach: float) -> bool:
    """Whether an end (0 start, 1 end) may be moved: outward by the reach, inward by a part of it,
    for there are points on what would be cut away.
    """
    further = float((corner - wall.end) @ wall.along if end else (wall.start - corner) @ wall.along)
    return -INWARD * reach <= further <= reach


def without_overshoot(walls: Sequence[Wall], reach: float) -> list[Wall]:
    """The walls, without ends that stick out behind another one: no photo sees through it.

    reach: how far an end may stick out. What does so for longer is a wall that goes on.
    """
    found = list(walls)
    for number, wall in enumerate(walls):
        for other in walls:
            corner = None if other is wall else _crossing(wall, other)
            if corner is None or not -reach <= (corner - other.start) @ other.along <= (
                other.width + reach
            ):
                continue
            now = found[number]
            for end, moved in (("start", now.start), ("end", now.end)):
                behind = -float((moved - other.start) @ other.outward)
                if behind > 0.0 and float(np.linalg.norm(moved - corner)) <= reach:
                    found[number] = (
                        replace(found[number], start=corner)
                        if end == "start"
                        else replace(found[number], end=corner)
                    )
    return found


def _crossing(one: Wall, two: Wall) -> NDArray[np.float64] | None:
    """(2,) where the lines of two walls cross; None where they hardly do, or pass at heights that
    do not meet.
    """
    matrix = np.stack([one.outward, two.outward])
    if abs(float(np.linalg.det(matrix))) < SQUARE:
        return None
    if min(one.top, two.top) <= max(one.bottom, two.bottom):
        return None
    offsets = np.array([one.outward @ one.start, two.outward @ two.start])
    corner: NDArray[np.float64] = np.linalg.solve(matrix, offsets)
    return corner
