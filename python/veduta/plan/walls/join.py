"""Pieces of one wall joined: set upright, and collinear ones with solid ink between made one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import reduce

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from veduta.plan.walls.pieces import Piece

UPRIGHT_RAD = np.radians(2.5)
"""Pieces this close to an axis lie along it: drawings are upright more often than not."""

SAME_DIRECTION_RAD = np.radians(4.0)

SAME_LINE = 0.3
"""Centre lines of one wall are apart by at most this part of its thickness."""

FARTHEST = 30.0
"""Pieces farther apart than so many thicknesses are two walls, even with ink between them."""

SAME_THICKNESS = 1.45
"""Thicknesses of one wall differ by at most this factor."""


def joined(pieces: list[Piece], solid: NDArray[np.bool_]) -> list[Piece]:
    """Upright, collinear pieces joined where the mask is solid between them."""
    upright = [_upright(one) for one in pieces]
    if not upright:
        return []
    mask = solid.view(np.uint8)
    pairs = [pair for pair in _collinear_pairs(upright) if _solid_between(*pair, upright, mask)]
    rows, columns = np.array(pairs, dtype=int).reshape(-1, 2).T
    count = len(upright)
    graph = coo_matrix((np.ones(len(rows), np.int8), (rows, columns)), shape=(count, count))
    labels = connected_components(graph, directed=False)[1]
    done = []
    for label in range(labels.max() + 1):
        group = [upright[index] for index in np.flatnonzero(labels == label)]
        done.append(reduce(merged, sorted(group, key=lambda one: -one.length_px)))
    return [one for one, inside in zip(done, _inside_another(done), strict=True) if not inside]


def merged(first: Piece, second: Piece) -> Piece:
    """One piece over both, on the longer one's direction, at the mean of their centre lines."""
    longer = first if first.length_px >= second.length_px else second
    direction = longer.direction
    normal = np.array([-direction[1], direction[0]])
    weight = np.array([first.length_px, second.length_px])
    middles = np.array([(one.start + one.end) / 2 for one in (first, second)])
    if abs(direction).max() > 1 - 1e-9:
        offset = float(np.average(middles @ normal, weights=weight))
    else:
        offset = float((longer.start + longer.end) @ normal / 2)
    along = np.array([first.start, first.end, second.start, second.end]) @ direction
    thickness = float(np.average([first.thickness_px, second.thickness_px], weights=weight))
    return replace(
        longer,
        start=direction * along.min() + normal * offset,
        end=direction * along.max() + normal * offset,
        thickness_px=thickness,
    )


def gap_between(first: Piece, second: Piece) -> float:
    """Along the first one's direction, from end to end; negative where they overlap."""
    base = first.start
    one = np.sort([0.0, first.length_px])
    two = np.sort(np.array([second.start - base, second.end - base]) @ first.direction)
    return float(max(two[0] - one[1], one[0] - two[1]))


def solid_share(
    solid: NDArray[np.bool_] | NDArray[np.uint8],
    start: NDArray[np.float64],
    end: NDArray[np.float64],
) -> float:
    """The part of a line that lies on the mask."""
    count = max(2, int(np.hypot(*(end - start))) + 1)
    points = np.floor(np.linspace(start, end, count)).astype(int)
    x = np.clip(points[:, 0], 0, solid.shape[1] - 1)
    y = np.clip(points[:, 1], 0, solid.shape[0] - 1)
    return float((solid[y, x] > 0).mean())


def _upright(piece: Piece) -> Piece:
    run = piece.end - piece.start
    for axis in (0, 1):
        other = 1 - axis
        if abs(run[other]) <= np.tan(UPRIGHT_RAD) * abs(run[axis]) + 1e-9:
            middle = (piece.start[other] + piece.end[other]) / 2
            start, end = piece.start.copy(), piece.end.copy()
            start[other] = end[other] = middle
            if start[axis] > end[axis]:
                start, end = end, start
            return replace(piece, start=start, end=end)
    return piece


def _collinear_pairs(pieces: list[Piece]) -> list[tuple[int, int]]:
    """Pairs that may be one wall: direction, line and thickness agree, and no other lies between.

    For each piece, the nearest one ahead and behind.
    """
    start = np.array([one.start for one in pieces])
    end = np.array([one.end for one in pieces])
    thick = np.array([one.thickness_px for one in pieces])
    length = np.array([one.length_px for one in pieces])
    direction = (end - start) / np.maximum(length, 1e-9)[:, None]
    middle = (start + end) / 2
    thicker = np.maximum(thick[:, None], thick[None])
    thinner = np.minimum(thick[:, None], thick[None])
    longer = length[:, None] >= length[None]
    apart = middle[None] - start[:, None]
    beside = np.abs(direction[:, None, 0] * apart[..., 1] - direction[:, None, 1] * apart[..., 0])
    turn = np.abs(
        direction[:, None, 0] * direction[None, :, 1]
        - direction[:, None, 1] * direction[None, :, 0]
    )
    # The direction of a stub says little.
    stub = np.minimum(length[:, None], length[None]) < 3 * thicker
    allowed = np.sin(np.where(stub, 3, 1) * SAME_DIRECTION_RAD)
    fits = (
        longer
        & (thicker <= SAME_THICKNESS * thinner + 2)
        & (beside <= np.maximum(1.5, SAME_LINE * thinner))
        & (turn <= allowed)
    )
    np.fill_diagonal(fits, False)
    found = []
    for first, second in np.argwhere(fits):
        gap = gap_between(pieces[first], pieces[second])
        if gap <= FARTHEST * thicker[first, second]:
            found.append((int(first), int(second)))
    return found


def _solid_between(first: int, second: int, pieces: list[Piece], mask: NDArray[np.uint8]) -> bool:
    one, other = pieces[first], pieces[second]
    if gap_between(one, other) <= 2:
        return True
    ends, mine = np.array([other.start, other.end]), np.array([one.start, one.end])
    distance = np.linalg.norm(ends[:, None] - mine[None], axis=2)
    which, whose = np.unravel_index(int(np.argmin(distance)), (2, 2))
    return solid_share(mask, ends[which], mine[whose]) > 0.93


def _inside_another(pieces: Sequence[Piece]) -> NDArray[np.bool_]:
    """(n,) whether each piece lies within the body of a longer one."""
    starts, ends = np.array([one.start for one in pieces]), np.array([one.end for one in pieces])
    ways = np.array([one.direction for one in pieces])
    length = np.array([one.length_px for one in pieces])
    half = np.array([one.thickness_px for one in pieces]) / 2
    inside = []
    for start, end, own in zip(starts, ends, length, strict=True):
        within = length > own
        for point in (start, end):
            away = point - starts
            beside = np.abs(away[:, 1] * ways[:, 0] - away[:, 0] * ways[:, 1])
            along = (away * ways).sum(axis=1)
            within &= (beside <= half + 1) & (along >= -half) & (along <= length + half)
        inside.append(within.any())
    return np.array(inside)
