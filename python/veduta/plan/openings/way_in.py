"""A room that only windows lead out of: the one between it and another room is its door.

The leaves of a closet's sliding doors fill a thin wall, as the panes of a window do. Which of the
two it is, the drawing does not say, but people must get in.
"""

from __future__ import annotations

from dataclasses import replace

from veduta.plan.drawn import Drawn, DrawnOpening, DrawnRoom
from veduta.plan.remarks import closed_in

NARROWEST_M = 0.55
"""What is narrower is no door."""
DOUBTED = 0.4
"""The score of a door that is known by its room alone."""


def with_ways_in(drawn: Drawn, metres_per_px: float) -> tuple[Drawn, list[str]]:
    """The storey with these windows as doors, of an unknown type, and a note for each."""
    notes = list[str]()
    for room in closed_in(drawn.rooms, drawn.openings):
        if room.outdoors or room not in closed_in(drawn.rooms, drawn.openings):
            continue
        inner = _windows_into_rooms(room, drawn)
        wide = [one for one in inner if one.width_px * metres_per_px >= NARROWEST_M]
        # Several are those of a shaft or a court, which gives light to the rooms around it.
        if len(wide) != 1:
            continue
        door = replace(wide[0], kind="door", type="unknown", score=min(wide[0].score, DOUBTED))
        openings = [door if one.id == door.id else one for one in drawn.openings]
        drawn = replace(drawn, openings=tuple(openings))
        notes.append(
            f"{door.id} is drawn like a window, but nothing else leads into {room.id}: it is taken"
            " for a door."
        )
    return drawn, notes


def _windows_into_rooms(room: DrawnRoom, drawn: Drawn) -> list[DrawnOpening]:
    """The windows between a room and another one that is indoors."""
    beside = {
        name for other in drawn.rooms if other.id != room.id and not other.outdoors
        for name in other.openings
    }  # fmt: skip
    return [
        one
        for one in drawn.openings
        if one.kind == "window" and one.id in room.openings and one.id in beside
    ]
