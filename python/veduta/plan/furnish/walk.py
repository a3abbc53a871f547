"""Whether one can still walk: the free floor as a grid of cells, for a person of a radius.

Cells are 5 cm; a cell is passable where a disc about its middle touches nothing.
"""

from __future__ import annotations

from collections.abc import Iterable

import cv2
import numpy as np
import shapely
from numpy.typing import NDArray
from shapely.geometry.base import BaseGeometry

CELL_M = 0.05
MOST_CELLS = 4_000_000
"""Of a grid: 100 m by 100 m. Rooms that are larger have none."""
RADIUS_M, WIDE_M = 0.25, 0.30
"""Of a person; and with a margin for what the cells do not show, where the empty room has it."""
NEAR_M = 0.25
"""A point's cell is the nearest passable one, if it is no further than this."""
LEAST_FREE_M2 = 0.3
Mask = NDArray[np.bool_]


def is_too_large(floor: BaseGeometry) -> bool:
    """Whether a floor has more cells than a grid may have."""
    left, bottom, right, top = floor.bounds
    return bool((right - left) * (top - bottom) > MOST_CELLS * CELL_M**2)


class WalkGrid:
    """The floor of a room or of a storey, without and with things on it."""

    def __init__(self, floor: BaseGeometry) -> None:
        left, bottom, right, top = floor.bounds
        self.x = np.arange(left - CELL_M, right + 2 * CELL_M, CELL_M)
        self.y = np.arange(bottom - CELL_M, top + 2 * CELL_M, CELL_M)
        self._gx, self._gy = np.meshgrid(self.x, self.y)
        shapely.prepare(floor)
        self.floor: Mask = np.asarray(shapely.contains_xy(floor, self._gx, self._gy))
        self.floor[[0, -1], :] = False
        self.floor[:, [0, -1]] = False

    def covered(self, shape: BaseGeometry) -> Mask:
        """The cells whose middles lie in a shape."""
        left, bottom, right, top = shape.bounds
        mask = np.zeros(self.floor.shape, dtype=np.bool_)
        i = slice(*np.searchsorted(self.y, [bottom, top + CELL_M]))
        j = slice(*np.searchsorted(self.x, [left, right + CELL_M]))
        mask[i, j] = shapely.contains_xy(shape, self._gx[i, j], self._gy[i, j])
        return mask

    def regions(self, things: Mask | None = None, radius_m: float = RADIUS_M) -> NDArray[np.int32]:
        """The number of the connected region of each passable cell, 0 elsewhere."""
        free = self.floor if things is None else self.floor & ~things
        # From the middle of a cell to the edge of what stands in the way; exact in OpenCV, too.
        cells = cv2.distanceTransform(free.view(np.uint8), cv2.DIST_L2, cv2.DIST_MASK_PRECISE)
        passable = (cells * CELL_M - CELL_M / 2.0 >= radius_m).view(np.uint8)
        _, labels = cv2.connectedComponents(passable, connectivity=4)
        return np.asarray(labels, dtype=np.int32)

    def number_at(self, regions: NDArray[np.int32], point: NDArray[np.float64]) -> int:
        """The region at a point or, nearest to it, within NEAR_M; 0 for none."""
        i = slice(*np.searchsorted(self.y, [point[1] - NEAR_M, point[1] + NEAR_M]))
        j = slice(*np.searchsorted(self.x, [point[0] - NEAR_M, point[0] + NEAR_M]))
        part = regions[i, j]
        if not part.any():
            return 0
        far = np.hypot(self._gx[i, j] - point[0], self._gy[i, j] - point[1])
        far = np.where(part > 0, far, np.inf)
        best = int(far.argmin())
        return int(part.flat[best]) if far.flat[best] <= NEAR_M else 0

    def numbers_at(
        self, regions: NDArray[np.int32], points: Iterable[NDArray[np.float64]]
    ) -> list[int]:
        """The regions at points."""
        return [self.number_at(regions, point) for point in points]


class Ways:
    """The doors of a room, and whether things still let one go from each to each.

    `leaves` stand open in the room: where one can go around them, one still can.
    """

    def __init__(
        self, floor: BaseGeometry, doors: NDArray[np.float64], leaves: BaseGeometry | None = None
    ) -> None:
        self.grid = WalkGrid(floor)
        self._doors = doors
        self._leaves: Mask | None = None
        if leaves is not None and not leaves.is_empty:
            self._leaves = self.grid.covered(leaves)
            self._around = self.grid.numbers_at(self.grid.regions(self._leaves), doors)
        empty = self.grid.regions()
        self._before = self.grid.numbers_at(empty, doors)
        wide = self.grid.regions(radius_m=WIDE_M)
        same = _same_parts(self._before, self.grid.numbers_at(wide, doors)) and wide.any()
        self._radius_m = WIDE_M if same else RADIUS_M
        sizes = np.bincount(empty.ravel())
        sizes[0] = 0
        self._is_open = bool(sizes.any())
        self._least = min(LEAST_FREE_M2 / CELL_M**2, 0.3 * float(sizes.max()))

    def main_region(self, things: Mask) -> Mask | None:
        """What one can walk on with things in the room; None where a door cannot be reached.

        Doors between which there was no way in the empty room need none.
        """
        regions = self.grid.regions(things, self._radius_m)
        if not self._is_open:
            return self.grid.floor & ~things
        after = self.grid.numbers_at(regions, self._doors)
        if not _still_joined(self._before, after) or not self._around_leaves(things):
            return None
        sizes = np.bincount(regions.ravel())
        sizes[0] = 0
        reached = {number for old, number in zip(self._before, after, strict=True) if old}
        main = max(reached, key=lambda number: sizes[number]) if reached else int(sizes.argmax())
        if sizes[main] < self._least or not main:
            return None
        return np.asarray(regions == main)

    def _around_leaves(self, things: Mask) -> bool:
        """Whether one comes from door to door past the leaves, where one could without things."""
        if self._leaves is None:
            return True
        regions = self.grid.regions(things | self._leaves)
        return _still_joined(self._around, self.grid.numbers_at(regions, self._doors))


def _still_joined(before: list[int], after: list[int]) -> bool:
    """Whether doors that lay in one region, by their numbers, still do; 0 is no region."""
    met: dict[int, int] = {}
    return not any(
        old and (not new or met.setdefault(old, new) != new)
        for old, new in zip(before, after, strict=True)
    )


def _same_parts(first: list[int], second: list[int]) -> bool:
    """Whether two numberings of the same doors join the same ones; 0 is no region."""
    pairs = set(zip(first, second, strict=True))
    return len({a for a, _ in pairs}) == len(pairs) == len({b for _, b in pairs}) and all(
        bool(a) == bool(b) for a, b in pairs
    )
