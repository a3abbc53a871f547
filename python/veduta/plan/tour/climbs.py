"""Stairs as ways between storeys."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from shapely.geometry import LineString

from veduta.plan.house.flights import AnyFlight, Flight, Stairwell
from veduta.plan.house.headroom import HEADROOM_M
from veduta.plan.house.space import Space
from veduta.plan.tour.free import BODY_M

BESIDE_M = 0.1
"""One stands so far before the first step, and behind the last, besides the body's radius."""


@dataclass(frozen=True)
class Climb:
    """A way up stairs, from a storey to the next.

    lower: the number of the storey. line_m: (n, 3) the feet above the lower floor, from where one
    stands below to where one stands above.
    """

    lower: int
    line_m: NDArray[np.float64]

    @property
    def foot_m(self) -> NDArray[np.float64]:
        """(2,) where one stands below."""
        return np.asarray(self.line_m[0, :2])

    @property
    def head_m(self) -> NDArray[np.float64]:
        """(2,) where one stands above."""
        return np.asarray(self.line_m[-1, :2])

    @property
    def length_m(self) -> float:
        """Of the way on it."""
        return float(np.linalg.norm(np.diff(self.line_m, axis=0), axis=1).sum())


def climbs_of(spaces: Sequence[Space], wells: Sequence[Stairwell]) -> list[Climb]:
    """All stairs of a house that have no wall on their way; one stairwell for each storey."""
    found = []
    for number, (space, above) in enumerate(pairwise(spaces)):
        for flight in wells[number].flights:
            climb = Climb(number, _line(flight))
            if not _blocked(climb, flight.rise_m, space, above):
                found.append(climb)
    return found


def _line(flight: AnyFlight) -> NDArray[np.float64]:
    """(n, 3) from one standing place to the other."""
    away = BODY_M + BESIDE_M
    if isinstance(flight, Flight):
        middle = flight.foot + flight.right * flight.width_m / 2.0
        ends = (middle - away * flight.along, middle + (flight.run_m + away) * flight.along)
        return np.array([[*ends[0], 0.0], [*ends[1], flight.rise_m]])
    path = flight.path_m
    first, last = path[0] - path[1], path[-1] - path[-2]
    foot = path[0] + away * first / np.hypot(*first)
    head = path[-1] + away * last / np.hypot(*last)
    return np.array([[*foot, 0.0], *flight.line_m, [*head, flight.rise_m]])


def _blocked(climb: Climb, rise_m: float, lower: Space, upper: Space) -> bool:
    """Whether a wall stands in the way; those above count where a head comes up to them."""
    line = climb.line_m
    ways = [(lower, line), (upper, _high(line, rise_m - HEADROOM_M))]
    return any(
        space.walls.buffer(BODY_M / 2.0).intersects(LineString(way[:, :2]))
        for space, way in ways
        if len(way) > 1
    )


def _high(line: NDArray[np.float64], under_m: float) -> NDArray[np.float64]:
    """What of a climb (n, 3), from its head down, is higher: a room may stand over its foot."""
    high = [line[-1]]
    for start, end in zip(line[-2::-1], line[:0:-1], strict=True):
        if start[2] <= under_m < end[2]:
            share = float((under_m - start[2]) / (end[2] - start[2]))
            high.append(start + share * (end - start))
        if start[2] <= under_m:
            break
        high.append(start)
    return np.array(high)
