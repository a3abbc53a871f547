"""Which lots stand beside which: what rules may ask about with `inter`."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from veduta.grammar.lot import Lot, boxes_of

NEAR_M = 5.0
"""Lots farther apart are no neighbours: balconies and eaves do not reach so far."""
MOST = 24
"""Neighbours of a lot: the nearest. It bounds the work where lots lie on each other."""
CROWD = 300
"""Lots that are looked at to find them."""
AT_ONCE = 1 << 16
"""Lots whose neighbours are looked for before what is far away is forgotten."""
Rows = NDArray[np.int32]


@dataclass(frozen=True)
class Beside(Sequence[tuple[int, ...]]):
    """For each lot the rows of those beside it, the nearest first.

    ends: (n + 1,) where those of each lot begin and end in `rows`.
    """

    rows: Rows
    ends: NDArray[np.int64]

    def __len__(self) -> int:
        return len(self.ends) - 1

    def __getitem__(self, row: int) -> tuple[int, ...]:  # type: ignore[override]
        first, end = self.ends[row], self.ends[row + 1]
        return tuple(self.rows[first : min(end, first + MOST)].tolist())


def neighbours_of(lots: Sequence[Lot]) -> Beside:
    """Which stand beside each lot.

    They are the lots whose boxes (along x and y, about the outline) come within `NEAR_M` of its
    own: of two lots each is a neighbour of the other, but where one has more than `MOST`.
    """
    if not lots:
        return Beside(np.zeros(0, np.int32), np.zeros(1, np.int64))
    found = list(_near_pairs(*boxes_of(lots)))
    one = np.concatenate([pair[side] for side in (0, 1) for pair in found])
    other = np.concatenate([pair[side] for side in (1, 0) for pair in found])
    gap_m = np.concatenate([pair[2] for _ in range(2) for pair in found])
    found.clear()
    order = np.lexsort((other, gap_m, one))
    counts = np.bincount(one, minlength=len(lots))
    return Beside(other[order], np.concatenate([[0], np.cumsum(counts)]))


def _near_pairs(
    low: NDArray[np.float64], high: NDArray[np.float64]
) -> Iterator[tuple[Rows, Rows, NDArray[np.float64]]]:
    """Pairs of boxes (n, 2) that are near each other, each once, and how far apart they are (m).

    A box finds those that are no larger, so that one huge lot does not make all look far.
    """
    middles, reach = (low + high) / 2, ((high - low) / 2).max(axis=1)
    tree = cKDTree(middles)
    for first in range(0, len(middles), AT_ONCE):
        rows = np.arange(first, min(first + AT_ONCE, len(middles)))
        one, other = _found_by(rows, tree, middles, reach)
        apart = np.maximum(low[other] - high[one], low[one] - high[other])
        gap_m = np.maximum(apart, 0.0).max(axis=1, initial=0.0)
        is_near = gap_m <= NEAR_M
        yield one[is_near].astype(np.int32), other[is_near].astype(np.int32), gap_m[is_near]


def _found_by(
    rows: NDArray[np.int64],
    tree: cKDTree,
    middles: NDArray[np.float64],
    reach: NDArray[np.float64],
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """What some boxes find: their rows, and those of the others."""
    radius = 2 * reach[rows] + NEAR_M
    counts = np.atleast_1d(
        tree.query_ball_point(middles[rows], radius, p=np.inf, return_length=True)
    )
    found = []
    for row, far, count in zip(rows.tolist(), radius.tolist(), counts.tolist(), strict=True):
        if count > CROWD:
            _, near = tree.query(middles[row], CROWD, p=np.inf, distance_upper_bound=far)
            others = np.asarray(near)[np.less(near, len(middles))]
        else:
            others = np.array(tree.query_ball_point(middles[row], far, p=np.inf))
        is_smaller = (reach[others] < reach[row]) | ((reach[others] == reach[row]) & (others < row))
        found.append(others[is_smaller].astype(np.int64))
    return np.repeat(rows, [len(others) for others in found]), np.concatenate(found)
