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
    """When the visitor is in a room (or outside: None), and the number of its storey."""

    room: str | None
    title: str
    storey: int | None
    start_s: float
    end_s: float


def stretches_of(timed: Timed, grounds: Sequence[Ground]) -> tuple[Stretch, ...]:
    """One after the other, without gaps; a doorway belongs to the room that one comes from."""
    found: list[Stretch] = []
    for feet, time in zip(timed.feet_m, timed.times_s.tolist(), strict=True):
        place = _place_at(feet, grounds)
        if not found:
            found.append(Stretch(*(place or (None, OUTSIDE, None)), 0.0, 0.0))
            continue
        found[-1] = replace(found[-1], end_s=time)
        last = found[-1]
        if place is not None and place != (last.room, last.title, last.storey):
            found.append(Stretch(*place, time, time))
    return tuple(found)


def outdoor_share(stretches: Sequence[Stretch]) -> float:
    """How much of a tour is outside."""
    outside = sum(one.end_s - one.start_s for one in stretches if one.room is None)
    return outside / stretches[-1].end_s if stretches and stretches[-1].end_s > 0.0 else 0.0


def _place_at(
    feet: NDArray[np.float64], grounds: Sequence[Ground]
) -> tuple[str | None, str, int | None] | None:
    """Id and title of the room, number of its storey; None in a doorway."""
    apart = [abs(one.elevation_m - float(feet[2])) for one in grounds]
    storey = int(np.argmin(apart))
    ground = grounds[storey]
    room = ground.space.room_at(feet[:2])
    if room is not None:
        return room.id, title_of(room), storey
    return None if ground.space.slab.covers(Point(feet[:2])) else (None, OUTSIDE, None)
