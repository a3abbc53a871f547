"""What doors cover: the footprints of leaves as they stand when one walks through, or by."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation
from shapely.geometry import MultiPoint
from shapely.geometry.base import BaseGeometry

from veduta.place.mover import Mover
from veduta.place.part import Part
from veduta.plan.house.doors import OPENED


@dataclass(frozen=True)
class DoorLeaf:
    """A leaf as it stands: its footprint (plan frame, m) and between which heights it is.

    door: the row of its door among the features of the part.
    """

    door: int
    footprint: BaseGeometry
    low_m: float
    high_m: float


def leaves_as_toured(part: Part, shut: Collection[int] = ()) -> list[DoorLeaf]:
    """All leaves of a house, opened: a closed one opens before the visitor. `shut` doors do not."""
    movers = [mover for mover in part.movers if len(mover.polygons)]
    return [_stood(part, mover, shut) for mover in movers]


def with_shut(part: Part, shut: Collection[int]) -> Part:
    """The part in which these doors stand closed."""
    movers = [
        replace(mover, opened=0.0) if len(mover.polygons) and _door(part, mover) in shut else mover
        for mover in part.movers
    ]
    return replace(part, movers=tuple(movers))


def _door(part: Part, mover: Mover) -> int:
    return int(part.polygon_feature[mover.polygons[0]])


def _stood(part: Part, mover: Mover, shut: Collection[int]) -> DoorLeaf:
    points = _corners(part, mover.polygons)
    door = _door(part, mover)
    share = 0.0 if door in shut else mover.opened or OPENED
    turn = Rotation.from_rotvec(share * mover.turn_rad * np.array(mover.axis))
    pivot = np.array(mover.pivot_m)
    placed = turn.apply(points - pivot) + pivot + share * np.array(mover.shift_m)
    footprint = MultiPoint(placed[:, :2]).convex_hull
    return DoorLeaf(door, footprint, float(placed[:, 2].min()), float(placed[:, 2].max()))


def _corners(part: Part, polygons: NDArray[np.int64]) -> NDArray[np.float64]:
    """(n, 3) the corners of some polygons of a part."""
    first = part.ring_offsets[part.polygon_offsets]
    rows = np.concatenate([np.arange(first[row], first[row + 1]) for row in polygons])
    corners: NDArray[np.float64] = part.positions_m[rows].astype(np.float64)
    return corners
