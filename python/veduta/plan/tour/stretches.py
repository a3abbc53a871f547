"""Which rooms a tour passes, and when."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from shapely.geometry import Point

from veduta.plan.tour.free import Ground
from veduta.plan.tour.pace import Timed
from veduta.plan.tour.stops import title_of

OUTSIDE = "Outside"


@dataclass(frozen=True)
class Stretch:
    """When the visitor is in a room (or outside: None)."""

    room: str | None
    title: str
    start_s: float
    end_s: float


def stretches_of(timed: Timed, grounds: Sequence[Ground]) -> tuple[Stretch, ...]:
    """One after the other, without gaps; a doorway belongs to the room that one comes from."""
    found: list[Stretch] = []
    for feet, time in zip(timed.feet_m, timed.times_s.tolist(), strict=True):
        place = _place_at(feet, grounds)
        if not found:
            found.append(Stretch(*(place or (None, OUTSIDE)), 0.0, 0.0))
            continue
        found[-1] = replace(found[-1], end_s=time)
        if place is not None and place != (found[-1].room, found[-1].title):
            found.append(Stretch(*place, time, time))
    return tuple(found)


def _place_at(
    feet: NDArray[np.float64], grounds: Sequence[Ground]
) -> tuple[str | None, str] | None:
    """Id and title of the room; None in a doorway."""
    ground = min(grounds, key=lambda one: abs(one.elevation_m - float(feet[2])))
    room = ground.space.room_at(feet[:2])
    if room is not None:
        return room.id, title_of(room)
    return None if ground.space.slab.covers(Point(feet[:2])) else (None, OUTSIDE)
