"""Points of other sensors are sorted into the holes of the background first (the end of section 5)."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from veduta.drive.build.fill import Background, Source
from veduta.drive.build.frame import ColumnFrame, sort_into_columns
from veduta.drive.build.layers import Layers, depth_image


@dataclass(frozen=True)
class OtherParameters:
    """off_m: a point so far before or behind the main depth is none of the wall: the paper sorts by
    the split depth; what comes from aside, or from images, has more that is wrong. lowest_m: over
    the road; lower ones are of cars or of the ground.
    """

    off_m: float = 0.5
    lowest_m: float = 0.4


@dataclass(frozen=True)
class Others:
    """What points of other sensors gave. pixels: of holes that they filled. off_m: by how much
    interpolation alone gives another depth there (median, m); NaN where there are none.
    """

    pixels: int
    off_m: float


NONE = Others(0, float("nan"))


def sort_in(
    layers: Layers,
    points: NDArray[np.float64],
    frame: ColumnFrame,
    farthest_m: float,
    parameters: OtherParameters | None = None,
) -> tuple[Layers, NDArray[np.bool_]]:
    """Layers with the holes of walls filled where points (n, 3) fall into them, and those pixels
    (r, c). Of several in one hole the median depth is taken.
    """
    chosen = parameters or OtherParameters()
    found = sort_into_columns(points, frame, 1.0, farthest_m)
    row, main = frame.rows_of(found.angle), layers.depths.main[found.column]
    with np.errstate(invalid="ignore"):
        kept = (row >= 0) & (np.abs(found.depth - main) < chosen.off_m)
    kept &= found.height > chosen.lowest_m
    image = depth_image(found, row, kept, frame, 0.5)
    hole = np.isfinite(image) & np.isnan(layers.background)
    background = np.where(hole, image, layers.background)
    return replace(layers, background=background, wall=layers.wall | hole), hole


def compared(hole: NDArray[np.bool_], own: Background, alone: Background) -> Others:
    """own: filled with those points, alone: by interpolation alone."""
    used = hole & (own.source == Source.MEASURED) & own.wall & alone.wall
    if not used.any():
        return NONE
    return Others(int(used.sum()), float(np.median(np.abs(own.depth[used] - alone.depth[used]))))
