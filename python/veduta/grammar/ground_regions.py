"""The ground of towns of any size: some neighbouring blocks at a time.

All corners of a town at once would need a kilobyte each. Blocks that follow each other in the order
of the quadtree are a region; its ground is made with the lots of other regions around it, and what
belongs to those is left to them. Triangles join what is near, so that regions meet but in rare
places: where two of them choose differently between corners on one circle, or across a gap that is
wider than what is looked at around a region.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

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
    for region in _regions(squares.every, most):
        own = {square.name for square in region}
        blocks = (squares.block(square) for square in _with_others(squares, region, anchors))
        found |= {name: ground for name, ground in ground_of(blocks).items() if name in own}
    return found


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


def _with_others(
    squares: Squares, region: list[Square], anchors: NDArray[np.float64]
) -> list[Square]:
    """The squares of a region between the lots around it of earlier and of later squares.

    A triangle between several blocks belongs to the last of them: so the order has to stay.
    """
    if len(region) == len(squares.every):
        return region
    number = np.empty(len(anchors), dtype=np.int64)
    for row, square in enumerate(squares.every):
        number[square.rows] = row
    first = squares.every.index(region[0])
    is_own = (number >= first) & (number < first + len(region))
    own = anchors[is_own, :2]
    low, high = own.min(axis=0) - AROUND_M, own.max(axis=0) + AROUND_M
    near = ~is_own & ((anchors[:, :2] >= low) & (anchors[:, :2] <= high)).all(axis=1)
    rows = np.flatnonzero(near)
    if not len(rows):
        return region
    distance_m, _ = cKDTree(own).query(anchors[rows, :2], distance_upper_bound=AROUND_M)
    rows = rows[np.isfinite(distance_m)]
    before, after = rows[number[rows] < first], rows[number[rows] >= first]
    outside = [Square(name, some, (0.0, 0.0, 0.0)) for name, some in (("<", before), (">", after))]
    return [one for one in (outside[0], *region, outside[1]) if len(one.rows)]
