"""A stretch of wall cut out of the sheet and laid straight.

The first step of AV3D, "Extraction of the Search Area of the Image's Floor Plan": the part of the
drawing that lies under a wall, with a margin on both sides.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import map_coordinates

from veduta.geometry.arcs import Arc

MARGIN = 0.6
"""Beside each face, in half thicknesses (AV3D: half a thickness in all)."""

MARGIN_PX = 4.0


@dataclass(frozen=True)
class Sheet:
    """What openings are looked for in: soft ink, and masks of marks, pale lines included."""

    ink: NDArray[np.float32]
    faint: NDArray[np.bool_]

    @cached_property
    def _framed(self) -> NDArray[np.bool_]:
        """The marks with a border of none around them, which stands for all that is outside."""
        return np.pad(self.faint, 1)

    def marked(self, points: NDArray[np.float64]) -> NDArray[np.bool_]:
        """(...) whether there is a mark at (..., 2) pixel coordinates; nothing outside."""
        height, width = self.faint.shape
        # What is converted is cut towards zero: the floor, but for the last bit of rounding.
        index = (points + 1.0).astype(np.intp)
        x = np.minimum(np.maximum(index[..., 0], 0), width + 1)
        y = np.minimum(np.maximum(index[..., 1], 0), height + 1)
        return np.asarray(self._framed[y, x])


@dataclass(frozen=True)
class Strip:
    """`steps` (rows,) are pixels across the wall, `along` (columns,) those from its start.

    `ink` and `faint` are (rows, columns): soft ink and marks at these places. `half_px` is half of
    the wall's thickness; rows are positive to the right of who goes along, as seen on the page.
    """

    steps: NDArray[np.float64]
    along: NDArray[np.float64]
    ink: NDArray[np.float32]
    faint: NDArray[np.float32]
    half_px: float

    @cached_property
    def within(self) -> NDArray[np.bool_]:
        """Rows between the faces, without what the faces' own lines blur into."""
        reach = max(self.half_px - 1.5, 0.3 * self.half_px, 1.0)
        return np.asarray(np.abs(self.steps) <= reach)

    @cached_property
    def paper(self) -> float:
        """Ink of the paper beside the wall, on its darker side."""
        away = self.half_px + 1
        sides = (self.steps < -away, self.steps > away)
        return max(float(np.median(self.ink[side])) for side in sides)


def cut_strip(
    start: NDArray[np.float64],
    end: NDArray[np.float64],
    thickness_px: float,
    sheet: Sheet,
    trim_px: float = 0.0,
    bulge: float = 0.0,
) -> Strip:
    """The strip from `start` to `end` ((2,) pixels), shorter by `trim_px` at both ends.

    That of a curved wall is laid straight, too.
    """
    line = Arc(start, end, bulge)
    width = line.length_px
    half = thickness_px / 2
    reach = (1 + MARGIN) * half + MARGIN_PX
    steps = np.arange(-reach, reach + 0.01, 1.0)
    along = np.arange(trim_px, width - trim_px + 1e-6, 1.0)
    if len(along) < 3:
        along = np.linspace(0.2, 0.8, 5) * width
    points = line.at(along[None, :], steps[:, None])
    return Strip(steps, along, sample(sheet.ink, points, 1), sample(sheet.faint, points), half)


def sample(
    grid: NDArray[np.bool_] | NDArray[np.float32], points: NDArray[np.float64], order: int = 0
) -> NDArray[np.float32]:
    """Values at (..., 2) pixel coordinates; nothing outside."""
    if order == 0:
        index = np.floor(points).astype(int)
        x, y = index[..., 0], index[..., 1]
        inside = (x >= 0) & (y >= 0) & (x < grid.shape[1]) & (y < grid.shape[0])
        values = grid[np.where(inside, y, 0), np.where(inside, x, 0)] * inside
        return np.asarray(values, dtype=np.float32)
    flat = points.reshape(-1, 2).T[::-1] - 0.5
    values = map_coordinates(
        np.asarray(grid, np.float32), flat, order=1, mode="nearest", prefilter=False
    )
    return np.asarray(values.reshape(points.shape[:-1]), dtype=np.float32)
