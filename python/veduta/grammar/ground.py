"""The ground between buildings that stand at different heights: invented, so that none floats.

The corners of the lots, each at the height of its lot, are joined by Delaunay triangles; where
neighbours of different height meet, the higher counts. Around the town the ground falls to the
plane of the place.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import Delaunay

from veduta.grammar.block import Block
from veduta.grammar.lot import Lot

LEVEL_M = 0.05
"""Lots whose heights differ by less stand on a plane."""
MARGIN_M = 25.0
"""How far the ground reaches beyond the lots."""
_BELOW_M = -0.05
"""The margin's end: just below the plane."""
_MERGED_M = 0.01
_AROUND = 12


@dataclass(frozen=True)
class Ground:
    """The ground of a block.

    points_m: (n, 3) about the origin of all lots, z up. triangles: (m, 3), counter-clockwise from
    above.
    """

    points_m: NDArray[np.float64]
    triangles: NDArray[np.int32]


def is_level(anchors_m: NDArray[np.float64]) -> bool:
    """Whether all lots stand on a plane; (n, 3) where they are."""
    return not len(anchors_m) or float(np.ptp(anchors_m[:, 2])) < LEVEL_M


def ground_of(blocks: Iterable[Block]) -> dict[str, Ground]:
    """The ground by the names of the blocks; none where all lots are level.

    The lots of one block are looked at at a time.
    """
    names, corners = [], []
    for block in blocks:
        names.append(block.name)
        corners.append(_corners(block.lots))
    if not corners or is_level(np.concatenate(corners)):
        return {}
    owner = np.repeat(np.arange(len(names)), [len(own) for own in corners])
    points, owner = _merged(np.concatenate(corners), owner)
    corners.clear()
    margin = _margin(points)
    every = np.concatenate([points, margin])
    owner = np.concatenate([owner, np.full(len(margin), -1)])
    triangles = _upward(every, Delaunay(every[:, :2]).simplices.astype(np.int32))
    # The margin's own corners belong to nobody; a triangle between three of them goes to the first.
    block_of = np.maximum(owner[triangles].max(axis=1), 0)
    found = {}
    for number, name in enumerate(names):
        used, own = np.unique(triangles[block_of == number], return_inverse=True)
        if len(used):
            found[name] = Ground(every[used], own.reshape(-1, 3).astype(np.int32))
    return found


def _corners(lots: Sequence[Lot]) -> NDArray[np.float64]:
    """(n, 3) of all rings."""
    each = [
        np.column_stack([ring, np.zeros(len(ring))]) + lot.anchor_m
        for lot in lots
        for ring in lot.rings_m
    ]
    found: NDArray[np.float64] = np.concatenate(each)
    return found


def _merged(
    points: NDArray[np.float64], owner: NDArray[np.int64]
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Corners in one place are one, at the highest of their heights."""
    cells = np.round(points[:, :2] / _MERGED_M).astype(np.int64)
    _, first, place = np.unique(cells, axis=0, return_index=True, return_inverse=True)
    found = points[first].copy()
    np.maximum.at(found[:, 2], place.reshape(-1), points[:, 2])
    return found, owner[first]


def _margin(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """(n, 3) around all points, outside of their hull."""
    hull = np.unique(Delaunay(points[:, :2]).convex_hull)
    turns = 2 * np.pi * np.arange(_AROUND) / _AROUND
    away = MARGIN_M * np.column_stack([np.cos(turns), np.sin(turns)])
    ring = (points[hull, None, :2] + away).reshape(-1, 2)
    reach = Delaunay(np.concatenate([points[:, :2], ring]))
    outer = ring[np.unique(reach.convex_hull) - len(points)]
    return np.column_stack([outer, np.full(len(outer), _BELOW_M)])


def _upward(points: NDArray[np.float64], triangles: NDArray[np.int32]) -> NDArray[np.int32]:
    """The triangles counter-clockwise seen from above."""
    a, b, c = (points[triangles[:, k], :2] for k in range(3))
    (ux, uy), (vx, vy) = (b - a).T, (c - a).T
    area = ux * vy - uy * vx
    found: NDArray[np.int32] = np.where((area < 0)[:, None], triangles[:, ::-1], triangles)
    return found
