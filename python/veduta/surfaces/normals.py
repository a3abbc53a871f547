"""Directions of triangles and vertices."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


def face_normals(positions: NDArray[np.floating], triangles: NDArray[np.integer]) -> Floats:
    """(m, 3) unit normals, to the side from which the corners run counter-clockwise.

    Zero for a triangle without area.
    """
    return _unit(_crosses(positions, triangles))


def vertex_normals(positions: NDArray[np.floating], triangles: NDArray[np.integer]) -> Floats:
    """(v, 3) unit normals: those of the triangles around, weighted by their areas.

    Zero for a vertex of no triangle.
    """
    crosses = np.repeat(_crosses(positions, triangles), 3, axis=0)
    corners = np.asarray(triangles).reshape(-1)
    count = len(positions)
    summed = [np.bincount(corners, crosses[:, axis], minlength=count) for axis in range(3)]
    return _unit(np.stack(summed, axis=1))


def _crosses(positions: NDArray[np.floating], triangles: NDArray[np.integer]) -> Floats:
    corners = np.asarray(positions, dtype=np.float64)[triangles]
    return np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])


def _unit(vectors: Floats) -> Floats:
    lengths = np.linalg.norm(vectors, axis=1, keepdims=True)
    return np.asarray(np.where(lengths > 0.0, vectors / np.maximum(lengths, 1e-300), 0.0))
