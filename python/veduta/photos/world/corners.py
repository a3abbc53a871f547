"""The corners of walls as their points place them: a finer rectangle than the wall's own.

A wall stands upright in a frame whose up is only inferred; its points do not. The plane is fitted
to them anew, with its lean. Points thin out before an edge: the edge is looked for beyond the last
of them by as much as the last few lie apart.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from veduta.photos.walls.wall import Wall

FEWEST = 16
LAST = 6
"""Points whose spacing says how far beyond the last the edge is."""
LEAN_SD = 0.05
"""How far walls lean from the up that was inferred (radians)."""
ITERATIONS = 4
CUT = 2.5


def wall_corners(walls: Sequence[Wall], points: NDArray[np.float64]) -> NDArray[np.float64]:
    """(w, 4, 3) start and end at the foot, end and start at the top; (p, 3) points."""
    found = [_corners(wall, points[wall.point_rows]) for wall in walls]
    return np.array(found).reshape(-1, 4, 3)


def _corners(wall: Wall, points: NDArray[np.float64]) -> NDArray[np.float64]:
    about = points[:, :2] - wall.start
    along, off, height = about @ wall.along, about @ wall.outward, points[:, 2]
    low, high, bottom, top = 0.0, wall.width, wall.bottom, wall.top
    shape = np.zeros(3)
    if len(points) >= FEWEST:
        shape = _plane(along, height, off, wall)
        on = np.abs(off - _off(shape, along, height)) <= 3.0 * max(wall.rms, 1e-9)
        on &= (along > -0.05 * wall.width) & (along < 1.05 * wall.width)
        if on.sum() >= FEWEST:
            low, high = _extent(along[on])
            bottom, top = _extent(height[on])
    places = np.array([[low, bottom], [high, bottom], [high, top], [low, top]])
    off = _off(shape, places[:, 0], places[:, 1])
    flat = wall.start + places[:, :1] * wall.along + off[:, None] * wall.outward
    return np.column_stack([flat, places[:, 1]])


def _plane(
    along: NDArray[np.float64], height: NDArray[np.float64], off: NDArray[np.float64], wall: Wall
) -> NDArray[np.float64]:
    """(3,) how far in front of the wall's plane, and its change along and up, least squares."""
    columns = np.column_stack([np.ones(len(along)), along, height])
    spread = max(wall.rms, 1e-9)
    kept = np.abs(off) <= 4.0 * spread
    shape = np.zeros(3)
    for _ in range(ITERATIONS):
        if kept.sum() < FEWEST // 2:
            break
        normal = columns[kept].T @ columns[kept] + np.diag(
            [0.0, (spread / LEAN_SD) ** 2, (spread / LEAN_SD) ** 2]
        )
        shape = np.linalg.solve(normal, columns[kept].T @ off[kept])
        left = off - columns @ shape
        kept = np.abs(left) <= CUT * max(1.4826 * float(np.median(np.abs(left))), 1e-9)
    return shape


def _off(
    shape: NDArray[np.float64], along: NDArray[np.float64], height: NDArray[np.float64]
) -> NDArray[np.float64]:
    found: NDArray[np.float64] = shape[0] + shape[1] * along + shape[2] * height
    return found


def _extent(places: NDArray[np.float64]) -> tuple[float, float]:
    """The ends of what is spread evenly before them."""
    ordered = np.sort(places)
    below = (ordered[LAST] - ordered[0]) / LAST
    above = (ordered[-1] - ordered[-1 - LAST]) / LAST
    return float(ordered[0] - below), float(ordered[-1] + above)
