"""The height of the ground beside the path, and which points lie on it (section 5)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from veduta.drive.build.frame import ColumnFrame, ColumnPoints


@dataclass(frozen=True)
class GroundParameters:
    """Thresholds of the ground.

    cell_m: cells along the path and across it. Streets slope slowly: a cell is ground where its
    lowest points are within `step_m` plus `slope` times its distance of the road.
    rise_m: from one cell to the next one farther out it rises by no more (a kerb), and by `slope`
    over more of them: what is higher is the foot of a wall of which the cell has more points than
    of the ground.
    over_m: points so little above it are ground: noise of the scanner and rough paving.
    lowest: quantile that stands for the lowest points; single points lie too low.
    """

    cell_m: tuple[float, float] = (1.0, 0.5)
    step_m: float = 0.35
    slope: float = 0.03
    rise_m: float = 0.25
    over_m: float = 0.08
    lowest: float = 0.08
    fewest: int = 4
    smoothed_cells: int = 5
    foot_m: float = 0.35
    """Cells in which an object takes the ground points at its foot with it,"""
    foot_height_m: float = 0.6
    """where points of it stand over them up to this height,"""
    foot_points: int = 2
    """and so many at least."""


@dataclass(frozen=True, eq=False)
class Ground:
    """heights: (a, b) over the road, by cells along and across (m), everywhere filled.

    seen: (a, b) whether scan points lie on it.
    """

    heights: NDArray[np.float64]
    seen: NDArray[np.bool_]
    cell_columns: float
    cell_m: float

    def under(
        self, column: NDArray[np.number], depth: NDArray[np.number]
    ) -> NDArray[np.float64]:
        """The ground's height over the road (m) at columns and depths of one shape."""
        at = np.stack([
            np.asarray(column, dtype=float).ravel() / self.cell_columns - 0.5,
            np.asarray(depth, dtype=float).ravel() / self.cell_m - 0.5,
        ])  # fmt: skip
        heights = ndimage.map_coordinates(self.heights, at, order=1, mode="nearest")
        return np.asarray(heights, dtype=np.float64).reshape(np.shape(column))


def find_ground(
    points: ColumnPoints, frame: ColumnFrame, parameters: GroundParameters | None = None
) -> tuple[Ground, NDArray[np.bool_]]:
    """The ground, and (n,) which points are of it."""
    chosen = parameters or GroundParameters()
    cell_columns = chosen.cell_m[0] / frame.spacing_m
    across = chosen.cell_m[1]
    rows = int(np.ceil(len(frame.origins) / cell_columns)) + 1
    columns = int(np.ceil(float(points.depth.max(initial=1.0)) / across)) + 1
    cell = (points.column / cell_columns).astype(np.int64) * columns
    cell += (points.depth / across).astype(np.int64)
    low, count = _quantile_by_cell(cell, points.height, rows * columns, chosen.lowest)
    low, count = low.reshape(rows, columns), count.reshape(rows, columns)
    away = (np.arange(columns) + 0.5) * across
    plausible = np.abs(low) < chosen.step_m + chosen.slope * away
    seen = _without_walls(low, plausible & (count >= chosen.fewest), across, chosen)
    if not seen.any():
        empty = Ground(np.zeros((rows, columns)), seen, cell_columns, across)
        return empty, np.zeros(len(points.column), dtype=bool)
    nearest = ndimage.distance_transform_edt(~seen, return_distances=False, return_indices=True)
    filled = low[tuple(nearest)]
    smooth = ndimage.median_filter(filled, size=chosen.smoothed_cells, mode="nearest")
    ground = Ground(smooth, seen, cell_columns, across)
    above = points.height - ground.under(points.column, points.depth)
    return ground, np.abs(above) < chosen.over_m + 0.003 * points.depth


def _without_walls(
    low: NDArray[np.float64], seen: NDArray[np.bool_], across_m: float, chosen: GroundParameters
) -> NDArray[np.bool_]:
    """(a, b) cells of `seen` that are no higher than the ground before them, from the road on."""
    kept = np.zeros_like(seen)
    highest = np.full(len(low), chosen.step_m)
    for cell in range(low.shape[1]):
        with np.errstate(invalid="ignore"):
            kept[:, cell] = seen[:, cell] & (low[:, cell] <= highest)
        rising = highest + chosen.slope * across_m
        highest = np.where(kept[:, cell], np.minimum(low[:, cell] + chosen.rise_m, rising), rising)
    return kept


def without_feet(
    ground: NDArray[np.bool_],
    standing: NDArray[np.bool_],
    above: NDArray[np.floating],
    points: ColumnPoints,
    frame: ColumnFrame,
    parameters: GroundParameters | None = None,
) -> NDArray[np.bool_]:
    """(n,) ground points but those at the feet of objects: `standing` (n,) is what stands there."""
    chosen = parameters or GroundParameters()
    columns = max(int(round(chosen.foot_m / frame.spacing_m)), 1)
    across = int(np.ceil(float(points.depth.max(initial=1.0)) / chosen.foot_m)) + 1
    cell = (points.column // columns).astype(np.int64) * across
    cell += (points.depth / chosen.foot_m).astype(np.int64)
    low = standing & ~ground & (above < chosen.foot_height_m)
    count = np.bincount(cell[low], minlength=int(cell.max(initial=0)) + 1)
    return np.asarray(ground & (count[cell] < chosen.foot_points))


def _quantile_by_cell(
    cell: NDArray[np.int64], values: NDArray[np.float32], cells: int, share: float
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """A quantile of the values in each cell (NaN in empty ones), and how many there are."""
    order = np.lexsort((values, cell))
    count = np.bincount(cell, minlength=cells)
    first = np.concatenate([[0], np.cumsum(count)[:-1]])
    if not len(values):
        return np.full(cells, np.nan), count
    at = np.minimum(first + (count * share).astype(np.int64), len(values) - 1)
    found = values[order][at].astype(np.float64)
    found[count == 0] = np.nan
    return found, count
