"""Fewer triangles under a stated error."""

from __future__ import annotations

from dataclasses import dataclass

import fast_simplification
import numpy as np
from numpy.typing import NDArray

SAMPLES = 20_000
NEAREST = 8
ROUNDS = 7
FEWEST = 16
"""Triangles below which nothing is taken away."""


@dataclass(frozen=True, eq=False)
class Simplified:
    """positions: (v, 3). triangles: (m, 3), counter-clockwise from outside as before.

    error_m: 95 % of the vertices that were given lie nearer to the new surface.
    """

    positions: NDArray[np.float64]
    triangles: NDArray[np.uint32]
    error_m: float


def simplify(
    positions: NDArray[np.floating],
    triangles: NDArray[np.integer],
    *,
    most: int | None = None,
    error_m: float | None = None,
) -> Simplified:
    """At most so many triangles, or as few as keep 95 % of the vertices within an error.

    By quadrics (Garland and Heckbert 1997). With both, `most` is the limit and the error is kept
    as long as that allows. A surface that would vanish stays as it is. ValueError where neither
    is given.
    """
    if most is None and error_m is None:
        raise ValueError("say how many triangles, or what error")
    given = np.asarray(positions, dtype=np.float64)
    faces = np.asarray(triangles, dtype=np.uint32)
    found = _fewest(given, faces, most, error_m)
    return found if len(found.triangles) else Simplified(given, faces, 0.0)


def _fewest(
    given: NDArray[np.float64], faces: NDArray[np.uint32], most: int | None, error_m: float | None
) -> Simplified:
    count = len(faces)
    if count <= FEWEST or (error_m is None and most is not None and count <= most):
        return Simplified(given, faces, 0.0)
    if error_m is None:
        return _reduced(given, faces, max(FEWEST, most or 0))
    limit = count if most is None else min(most, count)
    best = _reduced(given, faces, limit) if limit < count else Simplified(given, faces, 0.0)
    if best.error_m > error_m:
        return best
    few, many = FEWEST, limit
    for _ in range(ROUNDS):  # halving in the logarithm
        middle = int(np.sqrt(few * many))
        tried = _reduced(given, faces, middle)
        if tried.error_m <= error_m:
            best, many = tried, middle
        else:
            few = middle
        if many <= 1.1 * few:
            break
    return best


def _reduced(given: NDArray[np.float64], faces: NDArray[np.uint32], most: int) -> Simplified:
    middle = given.mean(axis=0)
    found, new = fast_simplification.simplify(
        (given - middle).astype(np.float32), faces.astype(np.int32), 1.0 - most / len(faces)
    )
    positions = found.astype(np.float64) + middle
    new = new.astype(np.uint32)
    flat = (new[:, 0] == new[:, 1]) | (new[:, 1] == new[:, 2]) | (new[:, 0] == new[:, 2])
    new = new[~flat]
    return Simplified(positions, new, _error(given, positions, new))


def _error(
    given: NDArray[np.float64], positions: NDArray[np.float64], faces: NDArray[np.uint32]
) -> float:
    """Distance of vertices, evenly picked, from the nearest of the triangles with near middles."""
    from scipy.spatial import cKDTree  # here, as few calls need it

    if not len(faces):
        return float("inf")  # nothing is left of it
    picked = given[:: max(1, len(given) // SAMPLES)]
    corners = positions[faces]
    near = min(NEAREST, len(faces))
    _, nearest = cKDTree(corners.mean(axis=1)).query(picked, k=near)
    nearest = nearest.reshape(len(picked), near)
    distances = [distance_to_triangles(picked, corners[nearest[:, k]]) for k in range(near)]
    return float(np.quantile(np.min(distances, axis=0), 0.95))


def distance_to_triangles(
    points: NDArray[np.float64], corners: NDArray[np.float64]
) -> NDArray[np.float64]:
    """(n,) distance of each of (n, 3) points from its own of (n, 3, 3) triangles."""
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    normal = np.cross(b - a, c - a)
    square = np.maximum((normal**2).sum(axis=1), 1e-300)
    inside = np.ones(len(points), dtype=bool)
    edges = []
    for start, end in ((a, b), (b, c), (c, a)):
        along, to = end - start, points - start
        inside &= (np.cross(along, to) * normal).sum(axis=1) >= 0.0
        share = (along * to).sum(axis=1) / np.maximum((along**2).sum(axis=1), 1e-300)
        nearest = start + np.clip(share, 0.0, 1.0)[:, None] * along
        edges.append(np.linalg.norm(points - nearest, axis=1))
    over = np.abs(((points - a) * normal).sum(axis=1)) / np.sqrt(square)
    return np.asarray(np.where(inside, over, np.min(edges, axis=0)))
