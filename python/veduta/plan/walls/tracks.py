"""Strokes followed run by run: straight and curved bands of a solid mask.

A line adjacency graph (Pavlidis 1986): the vertical runs of ink of neighbouring columns are linked
where both of their ends go on smoothly. A chain of links is a band that runs rather along x; the
transposed mask gives those along y. Junctions break the chains, as a run there is much longer.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from veduta.plan.walls.runs import run_lengths

STEEPEST = 1.25
"""Runs longer than this many times the stroke along x belong to bands along y."""


@dataclass(frozen=True)
class Track:
    """A band: at each of `along` (n,), its `low` and `high` side (n,), in pixels.

    `steep`: along is y and the sides are x; otherwise along is x and the sides are y.
    """

    along: NDArray[np.float64]
    low: NDArray[np.float64]
    high: NDArray[np.float64]
    steep: bool

    def centre(self) -> NDArray[np.float64]:
        """(n, 2) points (x, y) of its centre line."""
        middle = (self.low + self.high) / 2
        pair = (middle, self.along) if self.steep else (self.along, middle)
        return np.column_stack(pair)

    def breadth(self) -> float:
        """The median of its runs: not yet the thickness, where it is slanted."""
        return float(np.median(self.high - self.low))


def find_tracks(solid: NDArray[np.bool_], jitter_px: float = 2.0) -> list[Track]:
    """The bands of an (h, w) mask along x and along y."""
    return _tracks_along_x(solid, jitter_px, steep=False) + _tracks_along_x(
        np.ascontiguousarray(solid.T), jitter_px, steep=True
    )


def _tracks_along_x(solid: NDArray[np.bool_], jitter_px: float, steep: bool) -> list[Track]:
    column, top, bottom = _column_runs(solid)
    stroke = run_lengths(solid)[((top + bottom - 1) // 2), column]
    flat = (bottom - top) <= STEEPEST * stroke
    column, top, bottom = column[flat], top[flat], bottom[flat]
    if len(column) == 0:
        return []
    first, second = _links(column, top, bottom, jitter_px)
    count = len(column)
    ones = np.ones(len(first), dtype=np.int8)
    graph = coo_matrix((ones, (first, second)), shape=(count, count))
    labels = connected_components(graph, directed=False)[1]
    order = np.lexsort((column, labels))
    starts = np.flatnonzero(np.diff(labels[order], prepend=-1))
    chains = np.split(order, starts[1:])
    return [
        Track(column[chain] + 0.5, top[chain].astype(float), bottom[chain].astype(float), steep)
        for chain in chains
        if len(chain) >= 3
    ]


def _column_runs(
    solid: NDArray[np.bool_],
) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]:
    """Column, first row and row behind the last one of each vertical run, by columns."""
    padded = np.pad(solid.T.astype(np.int8), ((0, 0), (1, 1)))
    steps = np.diff(padded, axis=1)
    column, top = np.nonzero(steps == 1)
    bottom = np.nonzero(steps == -1)[1]
    return column, top, bottom


def _links(
    column: NDArray[np.int64], top: NDArray[np.int64], bottom: NDArray[np.int64], jitter_px: float
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Pairs of runs of neighbouring columns whose both ends go on.

    A run overlaps few of the next column's runs; they are sorted, so that the first one that
    ends below its top, and the one after, are all that can go on with both ends near.
    """
    height = int(bottom.max()) + 2
    key = column * height + bottom
    wanted = (column + 1) * height + top + 1
    pairs_first: list[NDArray[np.int64]] = []
    pairs_second: list[NDArray[np.int64]] = []
    candidate = np.searchsorted(key, wanted)
    for shift in (0, 1):
        other = candidate + shift
        inside = other < len(column)
        mine, other = np.flatnonzero(inside), other[inside]
        near = (
            (column[other] == column[mine] + 1)
            & (np.abs(top[other] - top[mine]) <= jitter_px)
            & (np.abs(bottom[other] - bottom[mine]) <= jitter_px)
        )
        if pairs_first:  # one goes on to one
            near &= ~np.isin(mine, pairs_first[0])
        pairs_first.append(mine[near])
        pairs_second.append(other[near])
    return np.concatenate(pairs_first), np.concatenate(pairs_second)
