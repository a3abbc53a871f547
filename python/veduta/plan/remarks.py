"""What a reader must know of how a plan lies on its sheet, and of rooms that nobody can enter.

None of it keeps a house from being built: the document's notes and the report say it.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray
from shapely.geometry import LineString, Polygon
from shapely.geometry.base import BaseGeometry
from shapely.ops import unary_union

from veduta.plan.document import Opening, Room
from veduta.plan.drawn import Drawn, DrawnOpening, DrawnRoom, DrawnStairs

BORDER = 0.012
"""A wall that ends within this share of the sheet's long side before its edge may go on there."""
_BORDER_WALLS = 1.5
"""Or within so many times its thickness."""
_AHEAD = 0.7
"""Cosine of the angle between a wall and the way to the edge into which it runs."""
APART_M = 1.5
"""Walls and rooms that leave a wider gap between them are two buildings."""
LEAST_SHARE = 0.25
"""A building with less of the largest one's floor is a shed, a key or a detail."""
_SHOWN = 8
R = TypeVar("R", DrawnRoom, Room)
_EDGES = {"left": (-1, 0), "right": (1, 0), "upper": (0, -1), "lower": (0, 1)}

PLOT_NOTE = (
    "a ring of walls stands around the plot, free of the house: it is a fence, is left out, and the"
    " yard within it is garden"
)
"""What is said where the walls of a plot were taken for a fence."""


def remarks(drawn: Drawn, scan_size_px: Sequence[int] | None, metres_per_px: float) -> list[str]:
    """The notes of a storey. `scan_size_px` is (height, width) before it was laid straight.

    Vectors have no sheet that could cut them off, and no size of it.
    """
    return [
        *(_cut(drawn, scan_size_px) if scan_size_px is not None else ()),
        *_apart(drawn, metres_per_px),
        *_closed_in(drawn, metres_per_px),
    ]


def false_flights(found: Sequence[DrawnStairs], true: Sequence[DrawnStairs]) -> list[str]:
    """What looked like stairs and is none. Of pictures, its lines are not looked at for walls."""
    kept = {id(one.outline_px) for one in true}
    left = [one for one in found if id(one.outline_px) not in kept]
    if not left:
        return []
    shown = ", ".join(_place(one) for one in left[:_SHOWN])
    more = f" and {len(left) - _SHOWN} more" if len(left) > _SHOWN else ""
    return [
        f"lines at pixel {shown}{more} of the cleaned drawing look like treads, but have not the"
        " size of stairs or lie in no room: they are not taken for stairs."
    ]


def _place(flight: DrawnStairs) -> str:
    x, y = flight.outline_px.mean(axis=0)
    return f"({x:.0f}, {y:.0f})"


def _cut(drawn: Drawn, scan_size_px: Sequence[int]) -> list[str]:
    """Walls that run out of the sheet: they end in nothing just before its edge."""
    height, width = scan_size_px
    back = np.linalg.inv(drawn.cleaned.clean_from_scan)
    zoom = float(np.sqrt(abs(np.linalg.det(back[:2, :2]))))
    met: Counter[str] = Counter()
    for wall in drawn.walls:
        start, end = drawn.wall_ends(wall) @ back[:2, :2].T + back[:2, 2]
        reach = max(BORDER * max(width, height), _BORDER_WALLS * wall.thickness_px * zoom)
        for name, here, there in ((wall.start, start, end), (wall.end, end, start)):
            if drawn.junction(name).type == "end":
                met.update(_edges_met(here, here - there, (width, height), reach))
    return [
        f"{number} wall{'s run' if number > 1 else ' runs'} into the {edge} edge of the sheet: the"
        " plan may be cut off, and what lies beyond is not in the house."
        for edge, number in met.items()
    ]


def _edges_met(
    at: NDArray[np.float64], way: NDArray[np.float64], size_px: tuple[int, int], reach: float
) -> list[str]:
    """The edges of a sheet (width, height) that a wall would meet within `reach` beyond its end."""
    before = {
        "left": at[0],
        "right": size_px[0] - at[0],
        "upper": at[1],
        "lower": size_px[1] - at[1],
    }
    unit = way / max(float(np.hypot(*way)), 1e-9)
    return [
        edge
        for edge, outward in _EDGES.items()
        if before[edge] <= reach and float(unit @ np.array(outward)) > _AHEAD
    ]


def _apart(drawn: Drawn, metres_per_px: float) -> list[str]:
    """Several buildings on one sheet: two storeys that ought to be on two, as a rule."""
    rooms = [Polygon(room.outline_px).buffer(0.0) for room in drawn.rooms]
    lines = [
        LineString(drawn.wall_ends(wall)).buffer(wall.thickness_px / 2) for wall in drawn.walls
    ]
    return plans_apart(rooms, lines, metres_per_px)


def plans_apart(
    rooms: Sequence[BaseGeometry], walls: Sequence[BaseGeometry], metres_per_unit: float
) -> list[str]:
    """What is to be said where rooms and bodies of walls fall into several buildings."""
    reach = APART_M / 2 / metres_per_unit
    whole = unary_union([shape.buffer(reach) for shape in [*rooms, *walls]])
    floors = [
        (sum(room.area for room in rooms if part.intersects(room)), part)
        for part in getattr(whole, "geoms", [whole])
    ]
    largest = max((area for area, _ in floors), default=0.0)
    found = [part for area, part in floors if area > 0 and area >= LEAST_SHARE * largest]
    if len(found) < 2:
        return []
    sizes = []
    for left, upper, right, lower in sorted(part.bounds for part in found)[:_SHOWN]:
        sides = (np.array([right - left, lower - upper]) - 2 * reach) * metres_per_unit
        sizes.append(f"{sides[0]:.1f} x {sides[1]:.1f} m")
    return [
        f"{len(found)} plans lie apart on this sheet ({', '.join(sizes)}): they are read as one"
        " storey. If they are storeys of one house, give a picture of each."
    ]


def closed_in(rooms: Sequence[R], openings: Sequence[DrawnOpening] | Sequence[Opening]) -> list[R]:
    """The rooms that no door and no gap leads into."""
    ways = {one.id for one in openings if one.kind != "window"}
    return [room for room in rooms if not ways & set(room.openings)]


def _closed_in(drawn: Drawn, metres_per_px: float) -> list[str]:
    """Rooms that no door and no gap leads into."""
    closed = closed_in(drawn.rooms, drawn.openings)
    if not closed:
        return []
    named = [f"{room.id} ({room.area_px2 * metres_per_px**2:.1f} m²)" for room in closed[:_SHOWN]]
    more = f" and {len(closed) - _SHOWN} more" if len(closed) > _SHOWN else ""
    which = "rooms have" if len(closed) > 1 else "room has"
    return [
        f"{len(closed)} {which} no door that was found: {', '.join(named)}{more}."
        " In plan.json a door can be added."
    ]
