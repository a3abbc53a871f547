"""Elevations with depth: how far what stands before and behind a wall's plane is from it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from veduta.cameras import Camera
from veduta.dense.document import Elevation


@dataclass(frozen=True)
class ElevationParameters:
    """reach: depth before and behind the plane that belongs to a wall, times its height.
    gap_cells: a hole so many cells wide is filled from around it. most_points: of a wall that are
    looked at for how fine its depths are. least_cosine: of the angle between a ray and the wall's
    normal that counts.
    """

    reach: float = 0.25
    gap_cells: int = 2
    most_points: int = 2000
    least_cosine: float = 0.1


@dataclass(frozen=True, eq=False)
class WallDepth:
    """depths_m: (h, w) float32, on the grid of the wall's picture: out of its plane, towards who
    looks at it, above 0; NaN where no point is. cell_px: pixels of the picture along a cell.
    """

    depths_m: NDArray[np.float32]
    cell_px: int


def wall_depth(
    points_m: NDArray[np.float64], wall: Elevation, parameters: ElevationParameters
) -> WallDepth:
    """The depth of each pixel: the median of the points in its cell.

    Cells are squares of pixels, as small as the points allow that lie there: half have one.
    """
    height, width = wall.shape
    from_start = points_m - wall.start_m
    out = from_start @ wall.outward
    column = (from_start @ wall.along - wall.left_m) / wall.pixel_m
    row = (wall.upper_m - points_m[:, 2]) / wall.pixel_m
    near = np.abs(out) <= parameters.reach * wall.height_m
    near &= (column >= 0.0) & (column < width) & (row >= 0.0) & (row < height)
    if not near.any():
        return WallDepth(np.full(wall.shape, np.nan, dtype=np.float32), 1)
    out, column, row = out[near], column[near], row[near]
    cell = 1
    while cell < max(wall.shape) and _filled(row, column, wall.shape, cell) < 0.5:
        cell *= 2
    cells = _medians(out, row // cell, column // cell, _cells(wall.shape, cell))
    closed = _closed(cells, parameters.gap_cells)
    whole = np.kron(closed, np.ones((cell, cell), dtype=np.float32))
    return WallDepth(np.ascontiguousarray(whole[:height, :width], dtype=np.float32), cell)


def wall_detail_m(
    points_m: NDArray[np.float64],
    wall: Elevation,
    cameras: Sequence[Camera],
    window_px: float,
    parameters: ElevationParameters,
) -> float:
    """How long the windows that depths are found by are along the wall: the median over its points
    and the cameras that have them in view. What is smaller is smoothed away.
    """
    column = (points_m - wall.start_m) @ wall.along - wall.left_m
    on = np.abs((points_m - wall.start_m) @ wall.outward) <= parameters.reach * wall.height_m
    on &= (column >= 0.0) & (column < wall.pixel_m * wall.shape[1])
    points = points_m[on]
    points = points[:: max(1, -(-len(points) // parameters.most_points))]
    found = [np.zeros(0)]
    for camera in cameras:
        pixels, depth = camera.project(points)
        size = np.array([camera.width_px, camera.height_px])
        seen = (depth > 0.0) & (pixels > 0.0).all(axis=1) & (pixels < size).all(axis=1)
        ray = points[seen] - camera.centre()
        away = np.linalg.norm(ray, axis=1)
        cosine = -(ray @ wall.outward) / away
        before = cosine > 0.0  # a camera behind the wall sees something else
        aslant = np.maximum(cosine[before], parameters.least_cosine)
        found.append(away[before] / (camera.focal_px[0] * aslant))
    every = np.concatenate(found)
    return window_px * float(np.median(every)) if len(every) else wall.pixel_m


def _cells(shape: tuple[int, int], cell: int) -> tuple[int, int]:
    return -(-shape[0] // cell), -(-shape[1] // cell)


def _filled(
    row: NDArray[np.float64], column: NDArray[np.float64], shape: tuple[int, int], cell: int
) -> float:
    """The share of the cells around the points that have one."""
    rows, columns = (row // cell).astype(np.intp), (column // cell).astype(np.intp)
    taken = len(np.unique(rows * _cells(shape, cell)[1] + columns))
    box = (np.ptp(rows) + 1) * (np.ptp(columns) + 1)
    return taken / float(box)


def _medians(
    values: NDArray[np.float64],
    row: NDArray[np.float64],
    column: NDArray[np.float64],
    shape: tuple[int, int],
) -> NDArray[np.float32]:
    """The median of each cell, NaN where there is none."""
    index = row.astype(np.intp) * shape[1] + column.astype(np.intp)
    order = np.lexsort((values, index))
    index, values = index[order], values[order]
    first = np.flatnonzero(np.r_[True, index[1:] != index[:-1]])
    count = np.diff(np.r_[first, len(index)])
    middle = 0.5 * (values[first + (count - 1) // 2] + values[first + count // 2])
    found = np.full(shape[0] * shape[1], np.nan, dtype=np.float32)
    found[index[first]] = middle
    return found.reshape(shape)


def _closed(cells: NDArray[np.float32], gap: int) -> NDArray[np.float32]:
    """Holes up to so many cells wide, filled with the nearest depth."""
    known = np.isfinite(cells)
    if gap <= 0 or known.all() or not known.any():
        return cells
    away, (rows, columns) = ndimage.distance_transform_edt(~known, return_indices=True)
    found = cells.copy()
    close = ndimage.binary_closing(np.pad(known, gap), iterations=gap)[gap:-gap, gap:-gap]
    fill = close & ~known & (away <= gap)
    found[fill] = cells[rows[fill], columns[fill]]
    return found
