"""Lots in squares: neighbours together, so many at most to a square."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

DEEPEST = 40
"""Lots that lie on each other cannot be told apart by halving."""


def squares(points_m: NDArray[np.float64], most: int) -> list[NDArray[np.int64]]:
    """The rows of (n, 2) points by the leaves of a quadtree that hold `most` or fewer.

    The squares come in the order of their quarters (south-west, south-east, north-west,
    north-east), rows within a square in theirs.
    """
    low = points_m.min(axis=0)
    side = max(float((points_m.max(axis=0) - low).max()), 1.0)
    found: list[NDArray[np.int64]] = []
    waiting = [(np.arange(len(points_m)), low, side, 0)]
    while waiting:
        rows, corner, size, depth = waiting.pop()
        if len(rows) <= most or depth == DEEPEST:
            found += [rows[first : first + most] for first in range(0, len(rows), most)]
            continue
        middle = corner + size / 2
        is_beyond = points_m[rows] >= middle
        quarter = is_beyond[:, 0] + 2 * is_beyond[:, 1]
        for number in (3, 2, 1, 0):
            chosen = rows[quarter == number]
            if len(chosen):
                own = corner + np.array([number % 2, number // 2]) * (size / 2)
                waiting.append((chosen, own, size / 2, depth + 1))
    return found
