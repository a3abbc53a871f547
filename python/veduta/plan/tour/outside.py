"""Once around the house, at a distance."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from shapely.geometry import LineString, Point
from shapely.geometry.base import BaseGeometry
from shapely.ops import unary_union

from veduta.plan.house.entrance import Entrance
from veduta.plan.house.space import Space, filled, pieces_of
from veduta.plan.tour.free import BODY_M
from veduta.plan.tour.smooth import resampled

AWAY_M = 5.0
"""From the house: near enough to see its windows, far enough to see its eaves."""
ROUND_M = 4.0
"""Narrower recesses of the outline than twice this are not walked into."""
BESIDE_M = 1.0
"""So far around the house one walks to another door."""
_STEP_M = 0.1
_PATH_M = 0.6
_BEFORE_M = 0.6


@dataclass(frozen=True)
class Outside:
    """Around a house.

    ring_m: (n, 2) the way around, closed, counter-clockwise from the place before the front door.
    region: what of the surroundings one walks on to come from the ring to the doors.
    """

    ring_m: NDArray[np.float64]
    region: BaseGeometry


def outside_of(space: Space, entrance: Entrance) -> Outside:
    """The way around a storey; it begins where one sees the entrance."""
    ring = _ring(space)
    door = entrance.before(entrance.hole.line.half_m + _BEFORE_M)
    near = space.slab.buffer(BESIDE_M)
    walls = space.walls.buffer(BODY_M)
    start = _sight(ring, door, walls)
    if start is None:  # a court: the way out of it is searched
        start = int(np.linalg.norm(ring - door, axis=1).argmin())
        near = space.slab.buffer(AWAY_M + _PATH_M)
    path = LineString([door, ring[start]]).buffer(_PATH_M)
    region = unary_union([near, path, Point(ring[start]).buffer(_PATH_M)])
    turned = np.concatenate([ring[start:], ring[: start + 1]])
    return Outside(turned, region)


def _ring(space: Space) -> NDArray[np.float64]:
    """(n, 2) not closed twice."""
    reach = AWAY_M + ROUND_M
    grown = filled(space.slab.buffer(reach, quad_segs=32).buffer(-ROUND_M, quad_segs=32))
    largest = max(pieces_of(grown), key=lambda piece: piece.area)
    ring = resampled(np.array(largest.exterior.coords), _STEP_M)[:-1]
    return ring if largest.exterior.is_ccw else ring[::-1]


def _sight(ring: NDArray[np.float64], door: NDArray[np.float64], walls: BaseGeometry) -> int | None:
    """The nearest point of the ring from which one walks straight to the door."""
    away = np.linalg.norm(ring - door, axis=1)
    for row in np.argsort(away)[:: max(1, round(0.5 / _STEP_M))]:
        if not walls.intersects(LineString([door, ring[row]])):
            return int(row)
    return None
