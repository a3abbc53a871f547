"""Which lots stand beside which: what rules may ask about with `inter`."""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from veduta.grammar.lots import Lot

NEAR_M = 5.0
"""Lots farther apart are no neighbours: balconies and eaves do not reach so far."""
MOST = 24
"""Neighbours of a lot: the nearest. It bounds the work where lots lie on each other."""
CROWD = 300
"""Lots that are looked at to find them."""


def neighbours_of(lots: Sequence[Lot]) -> list[tuple[int, ...]]:
    """For each lot the rows of those beside it, the nearest first.

    They are the lots whose boxes (along x and y, about the outline) come within `NEAR_M` of its
    own: of two lots each is a neighbour of the other, but where one has more than `MOST`.
    """
    if not lots:
        return []
    low, high = _boxes(lots)
    one, other = _near_pairs(low, high)
    both = np.concatenate([one, other]), np.concatenate([other, one])
    apart = np.maximum(low[both[1]] - high[both[0]], low[both[0]] - high[both[1]])
    gap_m = np.maximum(apart, 0.0).max(axis=1, initial=0.0)
    is_near = gap_m <= NEAR_M
    one, other, gap_m = both[0][is_near], both[1][is_near], gap_m[is_near]
    order = np.lexsort((other, gap_m, one))
    ends = np.searchsorted(one[order], np.arange(len(lots) + 1)).tolist()
    nearest = other[order]
    return [
        tuple(nearest[first : min(end, first + MOST)].tolist())
        for first, end in itertools.pairwise(ends)
    ]


def _near_pairs(
    low: NDArray[np.float64], high: NDArray[np.float64]
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Pairs of boxes (n, 2) that may be near each other, each once.

    A box finds those that are no larger, so that one huge lot does not make all look far.
    """
    middles, reach = (low + high) / 2, ((high - low) / 2).max(axis=1)
    radius = 2 * reach + NEAR_M
    tree = cKDTree(middles)
    counts = np.atleast_1d(tree.query_ball_point(middles, radius, p=np.inf, return_length=True))
    found = []
    for row, count in enumerate(counts.tolist()):
        if count > CROWD:
            _, near = tree.query(middles[row], CROWD, p=np.inf, distance_upper_bound=radius[row])
            others = np.asarray(near)[np.less(near, len(middles))]
        else:
            others = np.array(tree.query_ball_point(middles[row], radius[row], p=np.inf))
        is_smaller = (reach[others] < reach[row]) | ((reach[others] == reach[row]) & (others < row))
        found.append(others[is_smaller].astype(np.int64))
    rows = np.repeat(np.arange(len(found)), [len(others) for others in found])
    return rows, np.concatenate(found)


def _boxes(lots: Sequence[Lot]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Lower and upper corners (n, 2) of the outlines."""
    anchors = np.array([lot.anchor_m[:2] for lot in lots])
    low = np.array([lot.rings_m[0].min(axis=0) for lot in lots]) + anchors
    high = np.array([lot.rings_m[0].max(axis=0) for lot in lots]) + anchors
    return low, high
