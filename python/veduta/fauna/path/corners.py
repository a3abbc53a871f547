"""Corners of a path in which the animal turns on the spot, and the curves between them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.fauna.motion.angles import Floats
from veduta.fauna.path.limits import CornerLimits, PathLimits
from veduta.fauna.path.plan import Ways
from veduta.fauna.path.smooth import smooth_path
from veduta.fauna.path.terrain import Terrain
from veduta.run.errors import NotFoundError


@dataclass(frozen=True, eq=False)
class Parted:
    """points_m: (n, 3) on the ground. corners: rows of them where the animal turns on the spot."""

    points_m: Floats
    corners: tuple[int, ...]


def parted_path(
    terrain: Terrain, ways: Ways, way: Floats, through: Floats, limits: PathLimits, length_m: float
) -> Parted | None:
    """The path in curves that meet in corners; None where it has none, or no such path is clear.

    way: (k, 2) cells that were planned. through: (j, 2) cells of the points it goes through.
    """
    cuts = sharp_corners(ways, way, through, limits.corner, length_m / terrain.cell_m)
    if not cuts:
        return None
    found: list[Floats] = []
    ends = [0, *cuts, len(way) - 1]
    for begin, end in zip(ends, ends[1:], strict=False):
        piece = way[begin : end + 1]
        inside = np.array([point for point in through if _nearest(piece, point)[1] <= 1.0])
        try:
            line = smooth_path(terrain, ways, piece, inside, limits.smooth, length_m, closed=False)
        except NotFoundError:
            return None
        found.append(line if not found else line[1:])
    corners = np.cumsum([len(line) for line in found])[:-1] - 1
    return Parted(np.concatenate(found), tuple(int(row) for row in corners))


def sharp_corners(
    ways: Ways, way: Floats, through: Floats, limits: CornerLimits, length: float
) -> list[int]:
    """Rows of a way (k, 2) at which it turns back sharply and there is room to turn, in order.

    length: of the body, cells. Corners are as far from each other, and from the ends, as that.
    """
    rows: list[int] = []
    arcs = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(way, axis=0), axis=1))])
    last = 0
    for point in through[1:-1]:
        row = last + _nearest(way[last:], point)[0]
        before = int(np.searchsorted(arcs, arcs[row] - length))
        after = min(int(np.searchsorted(arcs, arcs[row] + length)), len(way) - 1)
        came, goes = way[row] - way[before], way[after] - way[row]
        size = float(np.linalg.norm(came) * np.linalg.norm(goes))
        sharp = size > 0.0 and float(came @ goes) < np.cos(np.radians(limits.sharpest_deg)) * size
        apart = arcs[row] - arcs[last] >= length and arcs[-1] - arcs[row] >= length
        if sharp and apart and _has_room(ways.free, way[row], limits.room * length):
            rows.append(row)
            last = row
    return rows


def _nearest(way: Floats, point: Floats) -> tuple[int, float]:
    """The row of a way that is nearest to a point, and how far that is."""
    apart = np.linalg.norm(way - point, axis=1)
    return int(apart.argmin()), float(apart.min())


def _has_room(free: NDArray[np.bool_], cell: Floats, radius: float) -> bool:
    """Whether all cells in a circle are free."""
    reach = int(np.ceil(radius))
    row, column = np.round(cell).astype(int)
    low = np.array([row - reach, column - reach])
    high = np.array([row + reach + 1, column + reach + 1])
    if (low < 0).any() or (high > free.shape).any():
        return False
    y, x = np.indices((2 * reach + 1, 2 * reach + 1)) - reach
    inside = np.hypot(y, x) <= radius
    return bool(free[low[0] : high[0], low[1] : high[1]][inside].all())
