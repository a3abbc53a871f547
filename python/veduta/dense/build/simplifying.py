"""Fewer triangles, and how far they lie from what was measured."""

from __future__ import annotations

from dataclasses import dataclass

import fast_simplification
import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

SAMPLES = 20_000


@dataclass(frozen=True, eq=False)
class Simplified:
    """error_m: 95 % of the vertices that were given lie nearer to the new triangles' samples."""

    points_m: NDArray[np.float64]
    triangles: NDArray[np.uint32]
    error_m: float


def simplify(
    points: NDArray[np.float64], triangles: NDArray[np.uint32], most: int
) -> Simplified:
    """At most so many triangles, by quadrics (Garland and Heckbert 1997)."""
    if len(triangles) <= most:
        return Simplified(points, triangles, 0.0)
    middle = points.mean(axis=0)
    found, faces = fast_simplification.simplify(
        (points - middle).astype(np.float32),
        triangles.astype(np.int32),
        target_reduction=1.0 - most / len(triangles),
    )
    new = found.astype(np.float64) + middle
    return Simplified(new, faces.astype(np.uint32), _error(points, new, faces))


def _error(
    given: NDArray[np.float64], points: NDArray[np.float64], faces: NDArray[np.integer]
) -> float:
    """Distance from vertices, evenly picked, to the plane of the nearest new triangle."""
    picked = given[:: max(1, len(given) // SAMPLES)]
    corners = points[faces]
    cross = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals = cross / np.maximum(np.linalg.norm(cross, axis=1, keepdims=True), 1e-30)
    middles = corners.mean(axis=1)
    _, nearest = cKDTree(middles).query(picked)
    away = np.abs(np.sum((picked - middles[nearest]) * normals[nearest], axis=1))
    return float(np.quantile(away, 0.95))
