"""Pieces of a mesh: what hangs together, and meshes without what nothing uses."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from veduta import _core


def vertex_pieces(triangles: NDArray[np.integer], vertices: int) -> NDArray[np.int32]:
    """(vertices,) the piece of each vertex of triangles (m, 3): what edges join is one."""
    found: NDArray[np.int32] = _core.pieces_of_mesh(
        np.asarray(triangles, dtype=np.uint32), vertices
    )
    return found


def compact(
    points: NDArray[np.float64], triangles: NDArray[np.integer]
) -> tuple[NDArray[np.float64], NDArray[np.uint32]]:
    """Rows of points (v, k) that triangles (m, 3) use, and the triangles by these."""
    used = np.zeros(len(points), dtype=np.bool_)
    used[triangles.ravel()] = True
    place = np.cumsum(used) - 1
    return points[used], place[triangles].astype(np.uint32)
