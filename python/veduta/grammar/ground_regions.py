"""The ground of towns of any size: some neighbouring blocks at a time.

All corners of a town at once would need a kilobyte each. Blocks that follow each other in the order
of the quadtree are a region; its ground is made with the lots of other regions around it, and what
belongs to those is left to them. All regions see the outermost lots of the town, so that it ends
for all of them in the same way. Triangles join what is near, so that regions meet but in rare
places: where two of them choose differently between corners on one circle, or across a gap that is
wider than what is looked at around a region.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull, cKDTree

from veduta.grammar.ground import Ground, ground_of, is_level
from veduta.grammar.lot import anchors_of
from veduta.grammar.squares import Square, Squares

MOST_LOTS = 100_000
"""Of a region: 400,000 corners and more are half a gigabyte of triangles on their way."""
AROUND_M = 150.0
"""From the lots of a region to those of others that are looked at."""


def grounds_of(squares: Squares, most: int = MOST_LOTS) -> dict[str, Ground]:
    """The ground by the names of the blocks; none where all lots are level."""
    anchors = anchors_of(squares.lots)
    if is_level(anchors):
        return {}
    found: dict[str, Ground] = {}
    highest_m = float(anchors[:, 2].max())
    regions = list(_regions(squares.every, most))
    town = _town(squares) if len(regions) > 1 else None
    for region in regions:
        own = {square.name for square in region}
        every = region if town is None else _with_others(town, region)
        blocks = (squares.block(square) for square in every)
        grounds = ground_of(blocks, highest_m)
        found |= {name: ground for name, ground in grounds.items() if name in own}
    return found


@dataclass(frozen=True)
class _Town:
    """All lots by their rows: anchors_m (n, 3), (n,) numbers of squares, and `_outermost`."""

    squares: Squares
    anchors_m: NDArray[np.float64]
    square_of: NDArray[np.int64]
    outermost: NDArray[np.int64]


def _town(squares: Squares) -> _Town:
    square_of = np.empty(len(squares.lots), dtype=np.int64)
    for number, square in enumerate(squares.every):
        square_of[square.rows] = number
    return _Town(squares, anchors_of(squares.lots), square_of, _outermost(squares))


def _regions(every: Sequence[Square], most: int) -> Iterator[list[Square]]:
    """Squares that follow each other, of `most` lots together."""
    region: list[Square] = []
    for square in every:
        if region and sum(len(one.rows) for one in region) + len(square.rows) > most:
            yield region
            region = []
        region.append(square)
    if region:
        yield region


def _outermost(squares: Squares) -> NDArray[np.int64]:
    """The rows of the lots in whose corners the town ends."""
    corners, rows = np.empty((0, 2)), np.empty(0, dtype=np.int64)
    for square in squares.every:
        own = [lot.rings_m[0] + lot.anchor_m[:2] for lot in squares.block(square).lots]
        row = np.repeat(square.rows, [len(ring) for ring in own])
        corners, rows = np.concatenate([corners, *own]), np.concatenate([rows, row])
        last = ConvexHull(corners).vertices
        corners, rows = corners[last], rows[last]
    return np.unique(rows)


def _with_others(town: _Town, region: list[Square]) -> list[Square]:
    """The squares of a region between other lots, of earlier and of later squares.

    They are those around it, and the outermost of the town.

    A triangle between several blocks belongs to the last of them: so the order has to stay.
    """
    anchors, number = town.anchors_m, town.square_of
    first = town.squares.every.index(region[0])
    is_own = (number >= first) & (number < first + len(region))
    own = anchors[is_own, :2]
    low, high = own.min(axis=0) - AROUND_M, own.max(axis=0) + AROUND_M
    near = ~is_own & ((anchors[:, :2] >= low) & (anchors[:, :2] <= high)).all(axis=1)
    rows = np.flatnonzero(near)
    if len(rows):
        distance_m, _ = cKDTree(own).query(anchors[rows, :2], distance_upper_bound=AROUND_M)
        rows = rows[np.isfinite(distance_m)]
    rows = np.union1d(rows, town.outermost[~is_own[town.outermost]])
    before, after = rows[number[rows] < first], rows[number[rows] >= first]
    outside = [Square(name, some, (0.0, 0.0, 0.0)) for name, some in (("<", before), (">", after))]
    return [one for one in (outside[0], *region, outside[1]) if len(one.rows)]
