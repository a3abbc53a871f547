"""Foreground, background, ground and glass: each scan point belongs to exactly one (section 5, 6.1).

The layers are depth images, too: of each the nearest or the middle depth that falls on a beam.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from veduta.drive.build.behind import Behind, find_behind
from veduta.drive.build.frame import ColumnFrame, ColumnPoints
from veduta.drive.build.ground import Ground, find_ground, without_feet
from veduta.drive.build.main_depth import MainDepth, find_main_depth


class PointClass(IntEnum):
    """Classes in `points.laz`: ASPRS's where there is one, the user's range from 64 on."""

    UNCLASSIFIED = 1
    GROUND = 2
    BUILDING = 6
    FOREGROUND = 64
    GLASS = 65
    FILLED = 66


@dataclass(frozen=True)
class LayerParameters:
    """Thresholds of the layers.

    behind_m: a point so far behind the main depth is seen through glass, or is of another house.
    framed_m: it is glass where wall points of its height are so near on both sides (section 6.1).
    beyond_m: without a main structure nothing but the ground is kept so far out.
    """

    behind_m: float = 0.6
    framed_m: float = 2.0


@dataclass(frozen=True, eq=False)
class Layers:
    """What was found in a segment. kind: (n,) uint8 `PointClass` of each point.

    first, background, foreground: (r, c) float32 depth images (m), NaN where there is no point.
    wall: (r, c) where the background is not ground. above: (n,) over the ground (m). behind: walls
    behind balconies and in arcades.
    """

    points: ColumnPoints
    kind: NDArray[np.uint8]
    above: NDArray[np.float32]
    ground: Ground
    depths: MainDepth
    first: NDArray[np.float32]
    background: NDArray[np.float32]
    foreground: NDArray[np.float32]
    wall: NDArray[np.bool_]
    behind: Behind


def split_layers(
    points: ColumnPoints,
    frame: ColumnFrame,
    farthest_m: float,
    parameters: LayerParameters | None = None,
) -> Layers:
    """All of section 5, and the glass of 6.1."""
    chosen = parameters or LayerParameters()
    ground, on_ground = find_ground(points, frame)
    above = (points.height - ground.under(points.column, points.depth)).astype(np.float32)
    depths = find_main_depth(points, above, frame, farthest_m)
    split, main = depths.split[points.column], depths.main[points.column]
    with np.errstate(invalid="ignore"):
        before = points.depth <= split
        behind = points.depth > main + chosen.behind_m
    on_ground = without_feet(on_ground, before, above, points, frame)
    kind = np.full(len(points.column), PointClass.BUILDING, dtype=np.uint8)
    kind[np.isnan(split)] = PointClass.UNCLASSIFIED
    kind[behind] = PointClass.UNCLASSIFIED
    kind[before] = PointClass.FOREGROUND
    kind[on_ground] = PointClass.GROUND
    across = depths.across[points.column]
    kind[across & (kind == PointClass.UNCLASSIFIED) & behind] = PointClass.BUILDING
    row = frame.rows_of(points.angle)
    behind &= kind == PointClass.UNCLASSIFIED
    kind[_through_glass(points, row, kind, behind, frame, chosen)] = PointClass.GLASS
    more = find_behind(points, row, above, on_ground, depths.main, frame)
    kind[more.of_walls(points, row, above) & ~on_ground] = PointClass.BUILDING
    images = {
        name: depth_image(points, row, chosen_points, frame, share)
        for name, chosen_points, share in (
            ("first", np.ones(len(kind), dtype=bool), 0.0),
            ("building", kind == PointClass.BUILDING, 0.5),
            ("ground", kind == PointClass.GROUND, 0.5),
            ("foreground", kind == PointClass.FOREGROUND, 0.0),
        )
    }
    wall = np.isfinite(images["building"])
    background = np.where(wall, images["building"], images["ground"])
    return Layers(
        points, kind, above, ground, depths,
        images["first"], background, images["foreground"], wall, more,
    )  # fmt: skip


def _through_glass(
    points: ColumnPoints,
    row: NDArray[np.int64],
    kind: NDArray[np.uint8],
    behind: NDArray[np.bool_],
    frame: ColumnFrame,
    chosen: LayerParameters,
) -> NDArray[np.bool_]:
    """(n,) points behind the main depth that are framed by wall: glass, not a gap."""
    wall = np.zeros(frame.shape, dtype=bool)
    building = (kind == PointClass.BUILDING) & (row >= 0)
    wall[row[building], points.column[building]] = True
    some = ndimage.binary_dilation(wall, np.ones((5, 1), dtype=bool))
    reach = max(int(round(chosen.framed_m / frame.spacing_m)), 1)
    before = np.zeros_like(some)
    after = np.zeros_like(some)
    for column in range(1, reach + 1):
        before[:, column:] |= some[:, :-column]
        after[:, :-column] |= some[:, column:]
    framed = before & after
    return np.asarray(behind & (row >= 0) & framed[np.maximum(row, 0), points.column])


def depth_image(
    points: ColumnPoints,
    row: NDArray[np.int64],
    kept: NDArray[np.bool_],
    frame: ColumnFrame,
    share: float,
) -> NDArray[np.float32]:
    """(r, c) a quantile of the depths of the kept points on each beam."""
    kept = kept & (row >= 0)
    cell = row[kept] * frame.shape[1] + points.column[kept]
    depth = points.depth[kept]
    order = np.lexsort((depth, cell))
    cell, depth = cell[order], depth[order]
    count = np.bincount(cell, minlength=frame.shape[0] * frame.shape[1])
    first = np.concatenate([[0], np.cumsum(count)[:-1]])
    image = np.full(len(count), np.nan, dtype=np.float32)
    filled = np.flatnonzero(count)
    image[filled] = depth[first[filled] + ((count[filled] - 1) * share).astype(np.int64)]
    return image.reshape(frame.shape)
