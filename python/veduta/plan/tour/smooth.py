"""Ways without the corners of the grid, that stay where one can walk."""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely.geometry import LineString
from shapely.geometry.base import BaseGeometry

STEP_M = 0.1
"""From point to point of a way."""
ROUNDS = 60
"""Of a diffusion with a share of one half: corners are rounded over about half a metre."""


def smoothed(
    points_m: NDArray[np.float64], free: BaseGeometry, grazed: BaseGeometry
) -> NDArray[np.float64]:
    """(m, 2) a way (n, 2) of which each point is drawn to the middle of its neighbours.

    A point that would leave `free` stays where it is, so that no corner is cut; the ends stay, too.
    Where the pieces between points leave `grazed` nevertheless, the way remains as it was.
    """
    way = resampled(points_m, STEP_M)
    given = way.copy()
    shapely.prepare(free)
    for _ in range(ROUNDS if len(way) > 2 else 0):
        moved = way.copy()
        moved[1:-1] = 0.5 * way[1:-1] + 0.25 * (way[:-2] + way[2:])
        stays = ~shapely.contains_xy(free, moved[:, 0], moved[:, 1])
        moved[stays] = way[stays]
        way = moved
    way = resampled(way, STEP_M)
    return way if _within(way, grazed) else given


def resampled(points_m: NDArray[np.float64], step_m: float) -> NDArray[np.float64]:
    """(m, k) points at equal distances of about a step along a line (n, k), both ends with it."""
    along = lengths_along(points_m)
    if along[-1] == 0.0:
        return points_m[:1]
    count = max(2, round(along[-1] / step_m) + 1)
    at = np.linspace(0.0, along[-1], count)
    return np.stack([np.interp(at, along, column) for column in points_m.T], axis=1)


def lengths_along(points_m: NDArray[np.float64]) -> NDArray[np.float64]:
    """(n,) how far along a line (n, k) its points lie."""
    steps = np.linalg.norm(np.diff(points_m, axis=0), axis=1)
    return np.concatenate([[0.0], np.cumsum(steps)])


def _within(way: NDArray[np.float64], grazed: BaseGeometry) -> bool:
    return len(way) < 2 or bool(grazed.covers(LineString(way)))
