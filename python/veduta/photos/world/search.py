"""Hypotheses: pairs of walls that may be pairs of facades, by shape and neighbourhood (2.6.2).

The thesis compares the height-to-width ratio of single facades. A pair says more and is as
independent of scale: how the two widths compare with the distance between them, how the second
faces, and where it lies seen from the first. Pairs of facades are kept in a tree of these numbers;
each pair of walls asks it for its like.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

from veduta.photos.city.facades import Facades
from veduta.photos.world.columns import (
    Complex,
    Placements,
    WallColumns,
    complex_of,
    plane_fit,
)

NARROWEST_M = 2.5
"""Of the facades that make hypotheses."""
NEIGHBOURS = 28
"""Facades that each is paired with; walls are paired with half as many."""
FACING, BEARING, RATIO = 0.07, 0.1, 0.17
"""What counts as one step of difference: of facing and bearing in radians, of log ratios."""
REACH = 2.0
"""Steps up to which two pairs are alike."""
TALLER = 0.55
"""Log ratio by which height to width of a wall and its facade may differ: feet are hidden."""
MOST_HYPOTHESES = 400_000
SAME_SCALE, SAME_TURN_RAD, SAME_SHIFT_M = 0.04, 0.035, 1.5
"""Hypotheses in one cell of this size are one."""


def hypotheses(walls: WallColumns, facades: Facades) -> Placements:
    """The placements that a pair of walls speaks for, without repetitions."""
    start, end, height = _candidates(facades)
    if len(walls) < 2 or len(start) < 2:
        return Placements(np.zeros(0, dtype=complex), np.zeros(0, dtype=complex))
    one, other = _pairs(start, end, NEIGHBOURS)
    tree = KDTree(_shape(start, end, one, other))
    first, second = _pairs(walls.start, walls.end, NEIGHBOURS // 2)
    asked = KDTree(_shape(walls.start, walls.end, first, second))
    near = asked.query_ball_tree(tree, REACH)
    counts = np.array([len(found) for found in near])
    if counts.sum() == 0:
        return Placements(np.zeros(0, dtype=complex), np.zeros(0, dtype=complex))
    pair = np.array([one for found in near for one in found], dtype=np.int64)
    asking = np.repeat(np.arange(len(first)), counts)
    i, j, a, b = first[asking], second[asking], one[pair], other[pair]
    alike = np.ones(len(i), dtype=bool)
    for wall, facade in ((i, a), (j, b)):
        drawn = np.log(walls.height / walls.width)[wall]
        known = np.log(height / np.abs(end - start))[facade]
        alike &= np.abs(drawn - known) < TALLER
    i, j, a, b = i[alike], j[alike], a[alike], b[alike]
    if len(i) > MOST_HYPOTHESES:
        step = np.linspace(0, len(i) - 1, MOST_HYPOTHESES).astype(np.int64)
        i, j, a, b = i[step], j[step], a[step], b[step]
    found = plane_fit(
        np.stack([walls.start[i], walls.end[i], walls.start[j], walls.end[j]], axis=1),
        np.stack([start[a], end[a], start[b], end[b]], axis=1),
    )
    return distinct(found, walls.middle.mean())


def distinct(placements: Placements, middle: complex) -> Placements:
    """One placement of each cell of scale, turn and place of the middle."""
    there = placements.turn * middle + placements.shift
    cells = np.column_stack(
        [
            np.log(np.abs(placements.turn)) / SAME_SCALE,
            np.angle(placements.turn) / SAME_TURN_RAD,
            there.real / SAME_SHIFT_M,
            there.imag / SAME_SHIFT_M,
        ]
    )
    _, kept = np.unique(np.round(cells).astype(np.int64), axis=0, return_index=True)
    return placements.taken(np.sort(kept))


def _candidates(facades: Facades) -> tuple[Complex, Complex, NDArray[np.float64]]:
    """Start, end and height of what a wall may be: facades, and two or three side by side."""
    rows = np.flatnonzero(~facades.hidden & (facades.width >= NARROWEST_M))
    start, end = complex_of(facades.start), complex_of(facades.end)
    height = facades.top - facades.bottom
    following = _continued(facades)
    chains = [(rows, rows)]
    last = rows
    first = rows
    for _ in range(2):
        goes_on = following[last] >= 0
        first, last = first[goes_on], following[last[goes_on]]
        chains.append((first, last))
    first = np.concatenate([one for one, _ in chains])
    last = np.concatenate([one for _, one in chains])
    return start[first], end[last], np.maximum(height[first], height[last])


def _continued(facades: Facades) -> NDArray[np.int64]:
    """(f,) the facade that goes on to the right in the same plane; -1 where there is none."""
    tree = KDTree(facades.start)
    distances, others = tree.query(facades.end, k=[1, 2, 3, 4][: len(facades)])
    distance, other = np.asarray(distances), np.asarray(others)
    found = np.full(len(facades), -1, dtype=np.int64)
    for column in range(other.shape[1] - 1, -1, -1):
        next_one = other[:, column]
        turned = (facades.outward * facades.outward[next_one]).sum(axis=1)
        step = ((facades.start[next_one] - facades.end) * facades.outward).sum(axis=1)
        fits = (turned > 0.999) & (distance[:, column] < 0.3) & (np.abs(step) < 0.15)
        fits &= next_one != np.arange(len(facades))
        found[fits] = next_one[fits]
    return found


def _pairs(start: Complex, end: Complex, count: int) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Each with its nearest, both ways round as they come."""
    middle = (start + end) / 2.0
    places = np.column_stack([middle.real, middle.imag])
    k = min(count + 1, len(start))
    _, near = KDTree(places).query(places, k=k)
    one = np.repeat(np.arange(len(start)), k)
    other = near.reshape(-1)
    kept = (one != other) & (np.abs(middle[one] - middle[other]) > 1e-9)
    return one[kept], other[kept]


def _shape(
    start: Complex, end: Complex, one: NDArray[np.int64], other: NDArray[np.int64]
) -> NDArray[np.float64]:
    """(n, 6) what does not change with scale, turn and shift, in steps."""
    edge = end - start
    width = np.abs(edge)
    middle = (start + end) / 2.0
    way = (middle[other] - middle[one]) / edge[one] * width[one]
    distance = np.abs(way)
    facing = edge[other] / edge[one]
    facing /= np.abs(facing)
    bearing = way / distance
    # Where the other is near, its direction is known less well.
    return np.column_stack(
        [
            facing.real / FACING,
            facing.imag / FACING,
            bearing.real / BEARING,
            bearing.imag / BEARING,
            np.log(width[one] / distance) / RATIO,
            np.log(width[other] / distance) / RATIO,
        ]
    )
