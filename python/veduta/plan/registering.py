"""Storeys laid onto each other: each so that its outline covers most of that below it.

A storey is moved by what brings sides or middles of both outlines onto each other: outer walls
stand over outer walls. So do flights of stairs that run the same way and have the same size, as
long as outlines then cover each other nearly as well. Its drawing moves along: the plan frame is
the same for all storeys.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product

import numpy as np
from shapely.affinity import translate
from shapely.geometry import Polygon
from shapely.geometry.base import BaseGeometry

from veduta.plan.document import Point, Storey
from veduta.plan.house.lines import footprint, wall_lines
from veduta.plan.house.space import filled

SAME_FLIGHT_M = 0.25
"""Flights over each other differ in size by at most so much: a tread may be hidden on one."""
STAIRS_SHARE = 0.93
"""Outlines cover each other so much as well, at least, where stairs are laid onto each other."""


def registered(storeys: Sequence[Storey]) -> list[Storey]:
    """The storeys from the lowest up; the lowest stays where it is."""
    found: list[Storey] = []
    for storey in storeys:
        found.append(_onto(storey, found[-1]) if found else storey)
    return found


def moved(storey: Storey, by_m: Point) -> Storey:
    """The storey moved in the plan frame; its drawing stays under it."""

    def at(point: Point) -> Point:
        return (round(point[0] + by_m[0], 5), round(point[1] + by_m[1], 5))

    sheet = storey.sheet
    x, y = sheet.origin_px
    origin = (x - by_m[0] / sheet.metres_per_px, y + by_m[1] / sheet.metres_per_px)
    rooms = [
        room.model_copy(
            update={
                "outline_m": [at(point) for point in room.outline_m],
                "holes_m": [[at(point) for point in hole] for hole in room.holes_m],
            }
        )
        for room in storey.rooms
    ]
    changes = {
        "sheet": sheet.model_copy(update={"origin_px": origin}),
        "junctions": [one.model_copy(update={"at_m": at(one.at_m)}) for one in storey.junctions],
        "rooms": rooms,
        "stairs": [
            one.model_copy(
                update={
                    "outline_m": [at(point) for point in one.outline_m],
                    "steps_m": [[at(point) for point in step] for step in one.steps_m],
                    "path_m": [at(point) for point in one.path_m],
                }
            )
            for one in storey.stairs
        ],
        "fittings": [one.model_copy(update={"at_m": at(one.at_m)}) for one in storey.fittings],
    }
    return storey.model_copy(update=changes)


def _onto(storey: Storey, below: Storey) -> Storey:
    own, under = _outline(storey), _outline(below)
    if own.is_empty or under.is_empty:
        return storey
    across = _shifts(own.bounds[0::2], under.bounds[0::2])
    up = _shifts(own.bounds[1::2], under.bounds[1::2])
    # The first of the best: of equal ones that which moves least.
    ways = sorted(product(across, up), key=lambda way: abs(way[0]) + abs(way[1]))
    best = max(ways, key=lambda way: round(_overlap(translate(own, *way), under), 6))
    covered = _overlap(translate(own, *best), under)
    by_stairs = [
        way
        for way in _stair_shifts(storey, below)
        if _overlap(translate(own, *way), under) >= STAIRS_SHARE * covered
    ]
    if by_stairs:
        best = max(by_stairs, key=lambda way: _overlap(translate(own, *way), under))
    return moved(storey, best)


def _stair_shifts(storey: Storey, below: Storey) -> list[Point]:
    """What brings a flight of a storey onto one of that below."""
    shifts = []
    for own, under in product(storey.stairs, below.stairs):
        here, there = Polygon(own.outline_m), Polygon(under.outline_m)
        sizes = [np.ptp(np.array(one.outline_m), axis=0) for one in (own, under)]
        opposed = float(np.dot(own.up, under.up)) < 0.5 and own.up != (0.0, 0.0) != under.up
        if opposed or np.abs(sizes[0] - sizes[1]).max() > SAME_FLIGHT_M:
            continue
        shifts.append((there.centroid.x - here.centroid.x, there.centroid.y - here.centroid.y))
    return shifts


def _outline(storey: Storey) -> BaseGeometry:
    return filled(footprint(wall_lines(storey).values()))


def _shifts(own: Sequence[float], under: Sequence[float]) -> tuple[float, ...]:
    """What brings the low sides, the high sides or the middles together; or nothing at all."""
    low, high = under[0] - own[0], under[1] - own[1]
    return (0.0, low, high, (low + high) / 2.0)


def _overlap(one: BaseGeometry, other: BaseGeometry) -> float:
    """Intersection over union."""
    return float(one.intersection(other).area / one.union(other).area)
