"""Findings that are no house: better none than one of half a square metre."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from veduta.plan.document import Storey
from veduta.run.errors import NotFoundError


@dataclass(frozen=True)
class LeastHouse:
    """What a storey must have, at least, to be one. Wide: a flat of 9 m2 passes.

    rooms_m2: all rooms together. typical_m2: the median room, where there are `many`.
    windows_a_room, windows: more of them than both, under a scale that is but assumed, are strokes
    of something else.
    """

    rooms_m2: float = 4.0
    typical_m2: float = 0.4
    many: int = 5
    windows_a_room: float = 8.0
    windows: int = 12
    apart: float = 0.5
    """Of the ends of walls, so many are free where only walls that bear are drawn."""
    opened: float = 0.25
    """And for so many of them, at most, something looks like a window: no strokes of a sketch."""
    alone: int = 4
    """Fewer walls without rooms are no structure: stray lines are free at their ends, too."""


LEAST = LeastHouse()


def check_house(storey: Storey, subject: str, least: LeastHouse = LEAST) -> list[str]:
    """NotFoundError with the reason where what was found on a sheet cannot be a storey.

    Drawings of the bearing walls alone are built as what they are, walls without rooms: what is
    returned must be said of them.
    """
    fault = _fault(storey, least)
    if fault is None:
        return []
    many = len(storey.walls) >= least.alone
    if many and not storey.rooms and _stand_apart(storey, least):
        return [
            f"No house to walk in: {len(storey.walls)} walls that mostly stand apart and close no"
            " room, as drawings do that show the bearing walls or columns alone. They are built as"
            " they stand. For a house, give the plan that shows all walls of the rooms, with their"
            " doors and windows."
        ]
    remedy = "Give a cleaner or larger picture of the plan alone, or its scale with --scale."
    raise NotFoundError("a house", f"{subject} gives {fault}", remedy)


def _stand_apart(storey: Storey, least: LeastHouse) -> bool:
    """Whether walls mostly end where no other wall is, and hardly anything opens in them."""
    free = {one.id for one in storey.junctions if one.type == "end"}
    ends = [name for wall in storey.walls for name in (wall.start, wall.end)]
    doors = any(one.kind == "door" for one in storey.openings)
    opened = doors or len(storey.openings) > least.opened * len(storey.walls)
    return not opened and bool(ends) and sum(n in free for n in ends) >= least.apart * len(ends)


def _fault(storey: Storey, least: LeastHouse) -> str | None:
    windows = sum(one.kind == "window" for one in storey.openings)
    areas = [room.area_m2 for room in storey.rooms]
    if not areas:
        return f"{len(storey.walls)} walls and {windows} windows, but no room that is closed"
    total = sum(areas)
    if total < least.rooms_m2:
        return f"{len(areas)} rooms of {total:.1f} m² in all: no house is so small"
    if len(areas) >= least.many and float(np.median(areas)) < least.typical_m2:
        return f"{len(areas)} rooms, most of them below {least.typical_m2:g} m²: no house has such"
    most = max(least.windows, least.windows_a_room * len(areas))
    if storey.scale.basis == "assumed" and windows > most:
        return f"{windows} windows around {len(areas)} rooms: strokes that are none of a plan"
    return None
