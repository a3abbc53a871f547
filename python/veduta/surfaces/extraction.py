"""The surface where sampled values pass a level: closed, oriented and 2-manifold."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from veduta import _core

Positions = NDArray[np.float64]
Triangles = NDArray[np.uint32]


def surface_nets(
    values: NDArray[np.floating],
    level: float,
    origin_m: ArrayLike | Sequence[float],
    cell_m: float,
    *,
    close: bool = True,
) -> tuple[Positions, Triangles]:
    """Vertices (v, 3) in metres and triangles (m, 3), counter-clockwise seen from outside.

    values: (nx, ny, nz), less than `level` inside; sample (0, 0, 0) lies at `origin_m`, samples are
    `cell_m` apart. Each vertex is the mean of the points where its sheet of the surface crosses the
    edges of a cell (surface nets, Gibson 1998), and sheets that would touch are kept apart (dual
    marching cubes, Nielson 2004), so that every edge has two triangles and every vertex one ring.

    close: what is inside at the grid's border is closed half a cell beyond it; else the surface
    ends there. Where a value is NaN nothing is known: the surface ends before it, with a rim.
    ValueError where the level is no number or the values have not three axes.
    """
    grid = np.ascontiguousarray(values, dtype=np.float32)
    if grid.ndim != 3:
        raise ValueError(f"values must have three axes, not {grid.ndim}")
    positions, triangles = _core.extract_surface(grid, float(level), close)
    return positions * cell_m + np.asarray(origin_m, dtype=np.float64), triangles
