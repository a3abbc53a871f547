"""A straight street of points with known classes: flat road, two walls, a car, a pole."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

SENSOR_M = 1.8
WALL_M = 9.0


def grid(*axes: NDArray[np.float64]) -> NDArray[np.float64]:
    """(n, 3) all combinations."""
    return np.stack([a.ravel() for a in np.meshgrid(*axes, indexing="ij")], axis=1)


def street(seed: int = 1) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Points of the left side of a path along +y, and what they are: 0 road, 1 wall, 2 object.

    The wall is seen above 0.4 m but behind the car, whose shadow leaves a hole.
    """
    random = np.random.default_rng(seed)
    along = np.arange(0.0, 20.0, 0.05)
    road = grid(-np.arange(1.5, WALL_M, 0.1), along, np.zeros(1))
    wall = grid(np.array([-WALL_M]), along, np.arange(0.05, 3.0, 0.08))
    hole = (wall[:, 1] > 8.0) & (wall[:, 1] < 11.0) & (wall[:, 2] < 1.4)
    car = grid(-np.array([4.0]), np.arange(8.0, 11.0, 0.05), np.arange(0.1, 1.4, 0.08))
    pole = grid(-np.array([6.0]), np.arange(15.0, 15.2, 0.05), np.arange(0.2, 3.0, 0.05))
    shadow = (road[:, 1] > 8.0) & (road[:, 1] < 11.0) & (road[:, 0] < -4.0)
    parts = [road[~shadow], wall[~hole], car, pole]
    kinds = [0, 1, 2, 2]
    points = np.concatenate(parts)
    kind = np.concatenate([np.full(len(p), k) for p, k in zip(parts, kinds, strict=True)])
    return points + random.normal(0.0, 0.015, points.shape), kind


def path(spacing_m: float = 0.12) -> NDArray[np.float64]:
    """(c, 3) the scanner's way along the street."""
    y = np.arange(0.5, 19.5, spacing_m)
    return np.stack([np.zeros_like(y), y, np.full_like(y, SENSOR_M)], axis=1)
