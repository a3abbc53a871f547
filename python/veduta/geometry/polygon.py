"""Convex polygons in the plane: (n, 2) float64 vertices."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Points = NDArray[np.float64]


def signed_area(polygon: Points) -> float:
    """Shoelace area; positive counter-clockwise where y goes up, clockwise where it goes down."""
    x, y = polygon[:, 0], polygon[:, 1]
    next_x, next_y = (np.concatenate([one[1:], one[:1]]) for one in (x, y))
    return float(np.dot(x, next_y) - np.dot(y, next_x)) / 2.0


def is_strictly_convex(polygon: Points, tolerance: float = 1e-9) -> bool:
    """True when all turns go the same way and none is straight (relative to the edge lengths)."""
    edges = np.roll(polygon, -1, axis=0) - polygon
    following = np.roll(edges, -1, axis=0)
    cross = edges[:, 0] * following[:, 1] - edges[:, 1] * following[:, 0]
    lengths = np.linalg.norm(edges, axis=1) * np.linalg.norm(following, axis=1)
    turns = cross > tolerance * lengths
    opposite = cross < -tolerance * lengths
    # Turning one way is not enough: a pentagram does too. It would go round more than once.
    angles = np.arctan2(cross, np.einsum("ij,ij->i", edges, following))
    return bool((turns.all() or opposite.all()) and abs(angles.sum()) < 2.0 * np.pi + 1e-6)


def clip_half_plane(polygon: Points, line: NDArray[np.float64]) -> Points:
    """The part of a convex polygon where a*x + b*y + c >= 0 for `line` = (a, b, c).

    Sutherland and Hodgman (1974), one edge. May be empty: (0, 2).
    """
    side = polygon @ line[:2] + line[2]
    kept: list[NDArray[np.float64]] = []
    for i in range(len(polygon)):
        j = (i + 1) % len(polygon)
        if side[i] >= 0.0:
            kept.append(polygon[i])
        if (side[i] >= 0.0) != (side[j] >= 0.0):
            t = side[i] / (side[i] - side[j])
            kept.append(polygon[i] + t * (polygon[j] - polygon[i]))
    return np.array(kept, dtype=np.float64).reshape(-1, 2)


def rectangle(x0: float, y0: float, x1: float, y1: float) -> Points:
    """Upper left, upper right, lower right, lower left."""
    return np.array([[x0, y0], [x1, y0], [x1, y1], [x0, y1]], dtype=np.float64)


def contains(polygon: Points, points: Points, margin: float = 0.0) -> NDArray[np.bool_]:
    """(n,) whether points lie in or on a convex polygon that goes clockwise on the screen.

    With a margin, at least as far inside of each of its sides.
    """
    inside = np.ones(len(points), dtype=np.bool_)
    for a, b in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
        within = margin * float(np.linalg.norm(b - a))
        from_a = points - a
        inside &= (b[0] - a[0]) * from_a[:, 1] >= (b[1] - a[1]) * from_a[:, 0] + within
    return inside
