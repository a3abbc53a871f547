"""Flights of stairs as ways between storeys."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from shapely.geometry import LineString

from veduta.plan.document import Stairs
from veduta.plan.house.space import Space
from veduta.plan.tour.free import BODY_M

BESIDE_M = 0.1
"""One stands so far before the first step, and behind the last, besides the body's radius."""


@dataclass(frozen=True)
class Climb:
    """A flight from a storey to the next, straight up.

    lower: the number of the storey. foot_m, head_m: (2,) where one stands below and above.
    length_m: of the way on it.
    """

    lower: int
    flight: Stairs
    foot_m: NDArray[np.float64]
    head_m: NDArray[np.float64]
    length_m: float


def climbs_of(spaces: Sequence[Space]) -> list[Climb]:
    """All flights whose direction is drawn, that lead to a storey and have no wall on their way."""
    found = []
    for number, (space, above) in enumerate(zip(spaces, spaces[1:], strict=False)):
        rise = above.storey.elevation_m - space.storey.elevation_m
        for flight in space.storey.stairs:
            climb = _climb(number, flight, rise)
            if climb is not None and not any(_blocked(climb, one) for one in (space, above)):
                found.append(climb)
    return found


def _climb(lower: int, flight: Stairs, rise_m: float) -> Climb | None:
    up = np.array(flight.up)
    size = float(np.linalg.norm(up))
    if size < 0.5:
        return None
    up /= size
    across = np.array([-up[1], up[0]])
    corners = np.array(flight.outline_m)
    along, beside = corners @ up, corners @ across
    middle = across * float(beside.min() + beside.max()) / 2.0
    foot = middle + up * (float(along.min()) - BODY_M - BESIDE_M)
    head = middle + up * (float(along.max()) + BODY_M + BESIDE_M)
    return Climb(lower, flight, foot, head, float(np.hypot(np.linalg.norm(head - foot), rise_m)))


def _blocked(climb: Climb, space: Space) -> bool:
    """Whether a wall of a storey stands in the way."""
    line = LineString([climb.foot_m, climb.head_m])
    return bool(space.walls.buffer(BODY_M / 2.0).intersects(line))
