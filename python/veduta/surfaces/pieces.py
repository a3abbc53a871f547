"""Pieces of a mesh: what hangs together, and meshes without what nothing uses."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def vertex_pieces(triangles: NDArray[np.integer], vertices: int) -> NDArray[np.int32]:
    """(vertices,) the piece of each vertex of triangles (m, 3): what edges join is one."""
    from scipy.sparse import coo_matrix  # here, as few calls need it
    from scipy.sparse.csgraph import connected_components

    edges = np.concatenate([triangles[:, :2], triangles[:, 1:]]).astype(np.int64)
    links = coo_matrix((np.ones(len(edges), dtype=np.int8), edges.T), shape=(vertices, vertices))
    return np.asarray(connected_components(links, directed=False)[1], dtype=np.int32)


def compact(
    points: NDArray[np.float64], triangles: NDArray[np.integer]
) -> tuple[NDArray[np.float64], NDArray[np.uint32]]:
    """Rows of points (v, k) that triangles (m, 3) use, and the triangles by these."""
    used = np.zeros(len(points), dtype=np.bool_)
    used[triangles.ravel()] = True
    place = np.cumsum(used) - 1
    return points[used], place[triangles].astype(np.uint32)
