"""The vertical planes in which a segment of the path is scanned, side by side along it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

Side = Literal["left", "right"]
_ROUNDS = 4
"""Steps to the nearest plane; quasi-linear pieces need two."""


@dataclass(frozen=True, eq=False)
class ColumnFrame:
    """Planes n = 0.. along a path. origins: (c, 3) where the scanner is (m). along: (c, 2) unit,
    the driving direction. outward: (c, 2) unit, to which it looks. angles_rad: (r,) the beams,
    ascending, 0 level. road_m: (c,) height of the road below the scanner (m, world z).
    """

    side: Side
    spacing_m: float
    origins: NDArray[np.float64]
    along: NDArray[np.float64]
    outward: NDArray[np.float64]
    angles_rad: NDArray[np.float64]
    road_m: NDArray[np.float64]

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns of the depth image."""
        return len(self.angles_rad), len(self.origins)

    def vertices(self, depth: NDArray[np.floating]) -> NDArray[np.float64]:
        """(r, c, 3) the points at these depths (r, c) (m); NaN where the depth is."""
        flat = self.origins[:, :2] + depth[..., None] * self.outward
        height = self.origins[:, 2] + depth * np.tan(self.angles_rad)[:, None]
        return np.concatenate([flat, height[..., None]], axis=2).astype(np.float64)

    def rows_of(self, angles: NDArray[np.floating]) -> NDArray[np.int64]:
        """The nearest beam of each angle; -1 outside of the fan."""
        step = float(self.angles_rad[1] - self.angles_rad[0])
        rows = np.rint((angles - self.angles_rad[0]) / step).astype(np.int64)
        return np.where((rows >= 0) & (rows < len(self.angles_rad)), rows, -1)


def column_frame(
    line: NDArray[np.float64],
    side: Side,
    angles_rad: NDArray[np.float64],
    road_m: NDArray[np.float64],
) -> ColumnFrame:
    """line: (c, 3) equally spaced scanner positions, in the driving direction."""
    along = np.gradient(line[:, :2], axis=0)
    spacing = float(np.median(np.linalg.norm(np.diff(line[:, :2], axis=0), axis=1)))
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    left = np.stack([-along[:, 1], along[:, 0]], axis=1)
    return ColumnFrame(
        side, spacing, line, along, left if side == "left" else -left, angles_rad, road_m
    )


@dataclass(frozen=True, eq=False)
class ColumnPoints:
    """Scan points sorted into the planes. points: (n, 3) world. column: (n,) int32.

    depth: (n,) float32, how far from the scanner in the ground plane, d = cos(v) s (m).
    angle: (n,) float32 rad. height: (n,) float32 over the road below the scanner (m).
    """

    points: NDArray[np.float64]
    column: NDArray[np.int32]
    depth: NDArray[np.float32]
    angle: NDArray[np.float32]
    height: NDArray[np.float32]
    index: NDArray[np.int64]
    """(n,) the row of each point among those that were given."""


def sort_into_columns(
    points: NDArray[np.float64], frame: ColumnFrame, nearest_m: float, farthest_m: float
) -> ColumnPoints:
    """Those of (n, 3) points that lie on the frame's side, each in its nearest plane.

    Section 5 of the paper sorts points of other sensors into the planes so; a full scan is sorted
    in the same way.
    """
    count = len(frame.origins)
    middle = count // 2
    chord = frame.origins[-1, :2] - frame.origins[0, :2]
    chord = chord / max(float(np.linalg.norm(chord)), 1e-9)
    flat = points[:, :2]
    place = middle + (flat - frame.origins[middle, :2]) @ chord / frame.spacing_m
    column = np.clip(np.rint(place), 0, count - 1).astype(np.int64)
    for _ in range(_ROUNDS):
        offset = flat - frame.origins[column, :2]
        step = np.einsum("ij,ij->i", offset, frame.along[column]) / frame.spacing_m
        column = np.clip(column + np.rint(step).astype(np.int64), 0, count - 1)
    offset = flat - frame.origins[column, :2]
    beside = np.abs(np.einsum("ij,ij->i", offset, frame.along[column]))
    depth = np.einsum("ij,ij->i", offset, frame.outward[column])
    kept = (beside <= frame.spacing_m) & (depth > nearest_m) & (depth < farthest_m)
    index = np.flatnonzero(kept)
    column, depth, chosen = column[index], depth[index], points[index]
    above = chosen[:, 2] - frame.origins[column, 2]
    return ColumnPoints(
        chosen,
        column.astype(np.int32),
        depth.astype(np.float32),
        np.arctan2(above, depth).astype(np.float32),
        (chosen[:, 2] - frame.road_m[column]).astype(np.float32),
        index,
    )
