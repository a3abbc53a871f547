"""The door of a garage: what is drawn there tells it from a wide window less than the room does.

Some sheets draw it as a thin box in the wall, as others draw a window: the word in the room says
what it is.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import replace

from veduta.plan.document import RoomUse
from veduta.plan.drawn import Drawn, DrawnOpening

LEAST_M = 2.1
"""A car does not pass through what is narrower."""


def with_garage_doors(drawn: Drawn, uses: Mapping[str, RoomUse], metres_per_px: float) -> Drawn:
    """The drawing in which each garage has a way in for a car, where an opening is wide enough.

    `uses` are those that are written on the sheet, by the ids of rooms. The widest opening that
    leads outdoors is the door, unless one is drawn as such.
    """
    rooms = Counter(name for room in drawn.rooms for name in room.openings)
    of = {one.id: one for one in drawn.openings}
    doors: dict[str, DrawnOpening] = {}
    for room in drawn.rooms:
        if uses.get(room.id) != "garage":
            continue
        out = [of[name] for name in room.openings if rooms[name] == 1]
        wide = [one for one in out if one.width_px * metres_per_px >= LEAST_M]
        if wide and not any(one.type == "garage" for one in out):
            door = max(wide, key=lambda one: one.width_px)
            doors[door.id] = replace(door, kind="door", type="garage", hinge="none", swing="none")
    openings = tuple(doors.get(one.id, one) for one in drawn.openings)
    return replace(drawn, openings=openings) if doors else drawn
