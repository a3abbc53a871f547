"""How far points lie from a mesh, and on which side of it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from veduta import _core


def distances_from_mesh(
    points: NDArray[np.floating], positions: NDArray[np.floating], triangles: NDArray[np.integer]
) -> tuple[NDArray[np.float64], NDArray[np.uint32]]:
    """(n,) signed distances of (n, 3) points from the nearest spot of a mesh, and the triangle (n,)
    on which that lies.

    Above 0 on the side from which triangles run counter-clockwise. Where several triangles share
    the nearest corner or edge, the one whose plane lies farthest off says the side. Triangles
    without area count for nothing; ValueError where there is no other, where a corner does not
    exist, and where a coordinate is not finite.
    """
    return _core.distances_from_mesh(
        np.ascontiguousarray(points, dtype=np.float64),
        np.ascontiguousarray(positions, dtype=np.float64),
        np.ascontiguousarray(triangles, dtype=np.uint32),
    )
