"""Storeys laid onto each other: each so that its outline covers most of that below it.

A storey is moved by what brings sides or middles of both outlines onto each other: outer walls
stand over outer walls. Its drawing moves along: the plan frame is the same for all storeys.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product

from shapely.affinity import translate
from shapely.geometry.base import BaseGeometry

from veduta.plan.document import Point, Storey
from veduta.plan.house.lines import footprint, wall_lines
from veduta.plan.house.space import filled


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
            one.model_copy(update={"outline_m": [at(point) for point in one.outline_m]})
            for one in storey.stairs
        ],
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
    return moved(storey, best)


def _outline(storey: Storey) -> BaseGeometry:
    return filled(footprint(wall_lines(storey).values()))


def _shifts(own: Sequence[float], under: Sequence[float]) -> tuple[float, ...]:
    """What brings the low sides, the high sides or the middles together; or nothing at all."""
    low, high = under[0] - own[0], under[1] - own[1]
    return (0.0, low, high, (low + high) / 2.0)


def _overlap(one: BaseGeometry, other: BaseGeometry) -> float:
    """Intersection over union."""
    return float(one.intersection(other).area / one.union(other).area)
