"""What open doors cover: the footprints of leaves as they stand when one walks through."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation
from shapely.geometry import MultiPoint
from shapely.geometry.base import BaseGeometry

from veduta.place.mover import Mover
from veduta.place.part import Part
from veduta.plan.house.doors import OPENED


@dataclass(frozen=True)
class OpenLeaf:
    """A leaf that stands open: its footprint (plan frame, m) and between which heights it is."""

    footprint: BaseGeometry
    low_m: float
    high_m: float


def open_leaves(part: Part) -> list[OpenLeaf]:
    """All leaves of a house, opened. A closed one opens before the visitor, so that none is."""
    return [_opened(part, mover) for mover in part.movers if len(mover.polygons)]


def _opened(part: Part, mover: Mover) -> OpenLeaf:
    points = _corners(part, mover.polygons)
    share = mover.opened or OPENED
    turn = Rotation.from_rotvec(share * mover.turn_rad * np.array(mover.axis))
    pivot = np.array(mover.pivot_m)
    placed = turn.apply(points - pivot) + pivot + share * np.array(mover.shift_m)
    footprint = MultiPoint(placed[:, :2]).convex_hull
    return OpenLeaf(footprint, float(placed[:, 2].min()), float(placed[:, 2].max()))


def _corners(part: Part, polygons: NDArray[np.int64]) -> NDArray[np.float64]:
    """(n, 3) the corners of some polygons of a part."""
    first = part.ring_offsets[part.polygon_offsets]
    rows = np.concatenate([np.arange(first[row], first[row + 1]) for row in polygons])
    corners: NDArray[np.float64] = part.positions_m[rows].astype(np.float64)
    return corners
