"""Charts: pieces of the surface as one photo shows them, packed into one picture."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.surfaces.texturing.choice import patches
from veduta.surfaces.texturing.sight import NO_VIEW

SWATCH_PX = 3
"""Side of the square for a triangle that no photo shows: its corners are three of the texels."""
_SPARE = 1.05
_STEP = 0.84
_LEAST = 0.02


class TooLargeError(ValueError):
    """The charts do not fit, however small they are made."""


@dataclass(frozen=True, eq=False)
class Charts:
    """views: (c,) of each chart. lows, sizes: (c, 2) its box in that photo at `scale`, whole px.

    corners: (c, 2) where the box lies in the atlas. chart_of: (m,) of each triangle, -1 where no
    photo shows it. swatches: (s, 2) corners of the squares of those, in their order.
    """

    views: NDArray[np.int32]
    lows: NDArray[np.int64]
    sizes: NDArray[np.int64]
    corners: NDArray[np.int64]
    chart_of: NDArray[np.int32]
    swatches: NDArray[np.int64]
    scale: float
    width_px: int
    height_px: int


def chart(
    labels: NDArray[np.int32],
    beside: NDArray[np.int32],
    places: NDArray[np.float64],
    *,
    detail: float,
    largest_px: int,
    padding_px: int,
) -> Charts:
    """Charts of connected triangles with one view, as fine as fits.

    places: (m, 3, 2) px of each triangle's corners in its own photo. TooLargeError where even the
    coarsest is larger than `largest_px` a side.
    """
    count, piece = patches(labels, beside)
    seen = labels != NO_VIEW
    used = np.zeros(count, dtype=np.bool_)
    used[piece[seen]] = True
    number = np.where(used, np.cumsum(used) - 1, -1).astype(np.int32)
    chart_of = np.where(seen, number[piece], -1).astype(np.int32)
    charts = int(used.sum())
    rows = np.flatnonzero(seen)
    views = np.zeros(charts, dtype=np.int32)
    views[chart_of[rows]] = labels[rows]
    low = np.full((charts, 2), np.inf)
    high = np.full((charts, 2), -np.inf)
    for corner in range(3):
        np.minimum.at(low, chart_of[rows], places[rows, corner])
        np.maximum.at(high, chart_of[rows], places[rows, corner])
    swatches = int((~seen).sum())
    scale = detail
    while scale > _LEAST * detail:
        lows = np.floor(low * scale).astype(np.int64) - padding_px
        sizes = np.ceil(high * scale).astype(np.int64) + padding_px - lows
        boxes = np.concatenate([sizes, np.full((swatches, 2), SWATCH_PX)])
        laid = packed(boxes, largest_px)
        if laid is not None:
            corners, width, height = laid
            return Charts(
                views,
                lows,
                sizes,
                corners[:charts],
                chart_of,
                corners[charts:],
                scale,
                width,
                height,
            )
        scale *= _STEP
    raise TooLargeError(f"{charts} charts do not fit into {largest_px} px")


def packed(boxes: NDArray[np.int64], largest_px: int) -> tuple[NDArray[np.int64], int, int] | None:
    """(b, 2) corners of the boxes on shelves, the tallest first, and the size; None: too large."""
    if not len(boxes):
        return np.zeros((0, 2), dtype=np.int64), 4, 4
    area = float(boxes.prod(axis=1).sum())
    wanted = max(int(np.sqrt(area * _SPARE)), int(boxes[:, 0].max()))
    width = min(-(-wanted // 4) * 4, largest_px)
    if boxes[:, 0].max() > width or area > float(largest_px) ** 2:
        return None
    order = np.lexsort((-boxes[:, 0], -boxes[:, 1]))
    corners = np.zeros_like(boxes)
    x = y = shelf = 0
    for box in order:
        across, down = int(boxes[box, 0]), int(boxes[box, 1])
        if x + across > width:
            x, y, shelf = 0, y + shelf, 0
        if y + down > largest_px:
            return None
        corners[box] = x, y
        x, shelf = x + across, max(shelf, down)
    return corners, width, -(-(y + shelf) // 4) * 4
