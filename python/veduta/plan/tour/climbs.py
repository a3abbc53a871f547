"""Flights of stairs as ways between storeys."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from shapely.geometry import LineString

from veduta.plan.house.flights import Flight, Stairwell
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
    foot_m: NDArray[np.float64]
    head_m: NDArray[np.float64]
    length_m: float


def climbs_of(spaces: Sequence[Space], wells: Sequence[Stairwell]) -> list[Climb]:
    """All flights of a house that have no wall on their way; one stairwell for each storey."""
    found = []
    for number, (space, above) in enumerate(zip(spaces, spaces[1:], strict=False)):
        for flight in wells[number].flights:
            climb = _climb(number, flight)
            if not any(_blocked(climb, one) for one in (space, above)):
                found.append(climb)
    return found


def _climb(lower: int, flight: Flight) -> Climb:
    away = BODY_M + BESIDE_M
    middle = flight.foot + flight.right * flight.width_m / 2.0
    foot = middle - away * flight.along
    head = middle + (flight.run_m + away) * flight.along
    return Climb(lower, foot, head, float(np.hypot(flight.run_m + 2.0 * away, flight.rise_m)))


def _blocked(climb: Climb, space: Space) -> bool:
    """Whether a wall of a storey stands in the way."""
    line = LineString([climb.foot_m, climb.head_m])
    return bool(space.walls.buffer(BODY_M / 2.0).intersects(line))
