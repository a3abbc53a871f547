"""Where on its plane a wall is: spans of points, split along and upwards as long as gaps part them.

After section 2.6.1 of the thesis: the points of a plane are split into runs along it, each run by
height, and each of these again, until nothing parts them; what is too small or has too few points
is no wall (its figure 2.17).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

CHANCE = 6.0
"""How much rarer than once a gap has to be, as an exponent, if points lay about evenly."""
CLUSTERED = 2.0
"""Points come in clusters: gaps are wider by this than those of even ones."""
STRETCH, MOST_STRETCHES = 8, 12
"""Points of a stretch of a wall in the mean, at least; stretches, at most."""


@dataclass(frozen=True)
class Bounds:
    """What a wall has to have at least. gap: the narrowest that parts two."""

    points: int
    width: float
    height: float
    gap: float


def spans(
    along: NDArray[np.float64], up: NDArray[np.float64], bounds: Bounds
) -> list[NDArray[np.int64]]:
    """Rows of the points of each wall on a plane; (n,) places along it and heights."""
    found: list[NDArray[np.int64]] = []
    waiting = [(np.arange(len(along)), 0, 0)]
    while waiting:
        rows, axis, settled = waiting.pop()
        if len(rows) < bounds.points:
            continue
        if settled == 2:
            if np.ptp(along[rows]) >= bounds.width and np.ptp(up[rows]) >= bounds.height:
                found.append(np.sort(rows))
            continue
        runs = _runs(rows, (along, up)[axis], bounds.gap)
        whole = settled + 1 if len(runs) == 1 else 0
        waiting += [(run, 1 - axis, whole) for run in runs]
    return found


def filled_height(along: NDArray[np.float64], up: NDArray[np.float64]) -> float:
    """Share of the height of points that they fill in the middle one of stretches along them.

    (n,) places along a wall and heights; stretches have as many points each. Most points of a wall
    are where it is seen as high as it is, though something may hide its foot for most of its width.
    Those of what ends in the sky are not, such as of the ridge of a roof with a turret on it: they
    lie on a line, and something stands up here or there.
    """
    stretches = int(np.clip(len(along) // STRETCH, 1, MOST_STRETCHES))
    rows = np.array_split(np.argsort(along, kind="stable"), stretches)
    return float(np.median([np.ptp(up[own]) for own in rows]) / np.ptp(up))


def widest_chance_gap(count: int, extent: float) -> float:
    """A gap between `count` points over `extent` that chance does not make.

    The widest of n gaps of even points exceeds (log n + c) extent / n with probability e^-c.
    """
    return CLUSTERED * extent / max(1, count) * (float(np.log(max(2, count))) + CHANCE)


def _runs(
    rows: NDArray[np.int64], places: NDArray[np.float64], least_gap: float
) -> list[NDArray[np.int64]]:
    """The rows in runs without a gap."""
    order = rows[np.argsort(places[rows], kind="stable")]
    steps = np.diff(places[order])
    # Strays far off would make the extent, and with it the gap, as long as one likes.
    low, high = np.quantile(places[order], [0.05, 0.95])
    most = max(least_gap, widest_chance_gap(len(order), float(high - low) / 0.9))
    return np.split(order, np.flatnonzero(steps > most) + 1)
