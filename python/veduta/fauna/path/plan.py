"""The way through the terrain's graph: the paper's weights, and the least score through all points.

Nodes are the cells without obstacles; an edge joins neighbours. The paper weighs an edge by the
variance of the heights along it alone; on even ground that is nothing, and any detour would be as
good: its length is added, and the variance counts by the height of a step. Of a large terrain the
way is planned on cells four times as large first, and then in a corridor around it.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra

from veduta.fauna.motion.angles import Floats
from veduta.fauna.path.limits import PathLimits
from veduta.fauna.path.terrain import Terrain
from veduta.run.errors import InputError, NotFoundError


@dataclass(frozen=True, eq=False)
class Ways:
    """Where the animal can be: (rows, columns), and the heights with gaps filled by 0."""

    free: NDArray[np.bool_]
    heights_m: Floats


def free_cells(terrain: Terrain, limits: PathLimits, length_m: float) -> Ways:
    """The cells on which the animal's body is clear of obstacles and of the terrain's end."""
    reach = max(1, int(np.ceil(limits.half_width * length_m / terrain.cell_m)))
    around = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (2 * reach + 1, 2 * reach + 1))
    padded = np.pad(terrain.blocked.astype(np.uint8), reach, constant_values=1)
    wide = cv2.dilate(padded, around)[reach:-reach, reach:-reach]
    return Ways(wide == 0, np.nan_to_num(terrain.heights_m))


def planned_way(
    terrain: Terrain, ways: Ways, points_m: Floats, limits: PathLimits, length_m: float
) -> Floats:
    """(n, 2) cells, row and column, of the way of the least score through points (k, 2 or 3).

    InputError where a point is beside the terrain or in an obstacle; NotFoundError where no way
    leads from one to the next.
    """
    cells = _cells_of(terrain, ways, points_m)
    found: list[NDArray[np.int64]] = []
    for first, second in zip(cells[:-1], cells[1:], strict=True):
        piece = _between(ways, terrain.cell_m, first, second, limits, length_m)
        found.append(piece if not found else piece[1:])
    return np.concatenate(found).astype(np.float64)


def _cells_of(terrain: Terrain, ways: Ways, points_m: Floats) -> NDArray[np.int64]:
    if len(points_m) < 2:
        raise InputError("--path", "has one point only", "Give two points at least.")
    cells = np.round(terrain.cell_of(points_m)).astype(np.int64)
    rows, columns = ways.free.shape
    for point, (row, column) in zip(points_m, cells, strict=True):
        where = f"has a point at {point[0]:g}, {point[1]:g}, which"
        if not (0 <= row < rows and 0 <= column < columns):
            raise InputError("--path", f"{where} is outside of the terrain", "Move it onto it.")
        if not ways.free[row, column]:
            fault = f"{where} is in an obstacle, or too near to one or to the terrain's end"
            raise InputError("--path", fault, "Move it into the open.")
    return cells


def _between(
    ways: Ways, cell_m: float, first: NDArray[np.int64], second: NDArray[np.int64],
    limits: PathLimits, length_m: float,
) -> NDArray[np.int64]:  # fmt: skip
    """(n, 2) cells from one to another."""
    if ways.free.size > limits.large:
        corridor = _corridor(ways, cell_m, first, second, limits, length_m)
        if corridor is not None:
            narrow = Ways(ways.free & corridor, ways.heights_m)
            found = _shortest(narrow, cell_m, first, second, limits, length_m)
            if found is not None:
                return found
    found = _shortest(ways, cell_m, first, second, limits, length_m)
    if found is None:
        raise NotFoundError(
            "a way",
            f"obstacles or slopes of more than {limits.slope_deg:g} degrees part two points of the"
            " path",
            "Choose other points.",
        )
    return found


def _corridor(
    ways: Ways, cell_m: float, first: NDArray[np.int64], second: NDArray[np.int64],
    limits: PathLimits, length_m: float,
) -> NDArray[np.bool_] | None:  # fmt: skip
    """Cells around the way on cells that are larger; None where there is none on those."""
    by = limits.coarse
    rows, columns = (-(-side // by) for side in ways.free.shape)
    padded = np.zeros((rows * by, columns * by), dtype=np.bool_)
    padded[: ways.free.shape[0], : ways.free.shape[1]] = ways.free
    blocks = padded.reshape(rows, by, columns, by)
    heights = np.zeros(padded.shape)
    heights[: ways.free.shape[0], : ways.free.shape[1]] = ways.heights_m
    count = np.maximum(blocks.sum(axis=(1, 3)), 1)
    mean = (heights.reshape(rows, by, columns, by) * blocks).sum(axis=(1, 3)) / count
    coarse = Ways(blocks.mean(axis=(1, 3)) > 0.5, mean)
    coarse.free[tuple(first // by)] = coarse.free[tuple(second // by)] = True
    found = _shortest(coarse, cell_m * by, first // by, second // by, limits, length_m)
    if found is None:
        return None
    canvas = np.zeros(coarse.free.shape, dtype=np.uint8)
    canvas[found[:, 0], found[:, 1]] = 1
    size = 2 * limits.corridor + 1
    wide = cv2.dilate(canvas, np.ones((size, size), np.uint8))
    fine = np.repeat(np.repeat(wide, by, axis=0), by, axis=1)
    return fine[: ways.free.shape[0], : ways.free.shape[1]] > 0


def _shortest(
    ways: Ways, cell_m: float, first: NDArray[np.int64], second: NDArray[np.int64],
    limits: PathLimits, length_m: float,
) -> NDArray[np.int64] | None:  # fmt: skip
    """The way of the least score by Dijkstra's algorithm; None where there is none."""
    graph, number, rows, columns = _graph(ways, cell_m, limits, length_m)
    start, end = int(number[tuple(first)]), int(number[tuple(second)])
    if start == end:
        return np.stack([first, second])
    found = dijkstra(graph, directed=False, indices=np.array([start]), return_predecessors=True)
    if not np.isfinite(found[0][0, end]):
        return None
    before, way = found[1][0], [end]
    while way[-1] != start:
        way.append(int(before[way[-1]]))
    order = np.array(way[::-1])
    return np.stack([rows[order], columns[order]], axis=1).astype(np.int64)


def _graph(
    ways: Ways, cell_m: float, limits: PathLimits, length_m: float
) -> tuple[csr_array, NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]:
    """The graph of the free cells, the number of each cell, and row and column of each number."""
    rows, columns = np.nonzero(ways.free)
    number = np.full((ways.free.shape[0] + 1, ways.free.shape[1] + 2), -1, dtype=np.int64)
    number[rows, columns + 1] = np.arange(len(rows))
    heights = ways.heights_m
    mean = cv2.blur(heights, (3, 3))
    spread = np.maximum(cv2.blur(heights * heights, (3, 3)) - mean * mean, 0.0)
    flat_heights, flat_spread = heights[rows, columns], spread[rows, columns]
    step = (limits.step * length_m) ** 2
    steepest = np.tan(np.radians(limits.slope_deg))
    pairs = []
    for down, right in ((0, 1), (1, 0), (1, 1), (1, -1)):
        other = number[rows + down, columns + 1 + right]
        near = np.flatnonzero(other >= 0)
        far = other[near]
        length = cell_m * float(np.hypot(down, right))
        rise = np.abs(flat_heights[far] - flat_heights[near])
        fits = rise <= steepest * length
        near, far = near[fits], far[fits]
        varied = 0.5 * (flat_spread[near] + flat_spread[far])
        pairs.append((near, far, length * (1.0 + varied / step)))
    near, far, weight = (np.concatenate(column) for column in zip(*pairs, strict=True))
    graph = csr_array((weight, (near, far)), shape=(len(rows), len(rows)))
    return graph, number[:-1, 1:-1], rows.astype(np.int64), columns.astype(np.int64)
