"""The place of a house: its part, the plinth it stands on, and where a visitor begins."""

from __future__ import annotations

import numpy as np
from shapely.geometry import LineString, Point

from veduta.place.manifest import IDENTITY, Bounds, Place, PlacePart, Start, Vector
from veduta.plan.house.build import House
from veduta.plan.house.space import Hole, Space
from veduta.plan.options import HouseOptions

EYE_M = 1.7
AWAY_M = (5.0, 4.0, 3.0, 2.0)
"""From the front door to the visitor: the first from which nothing is in the way."""
WHOLE = 0.7
"""From a house without a door to the visitor, in widths of it: so it fits into the picture."""


def place_of(house: House, model: str, document: str | None, options: HouseOptions) -> Place:
    """The manifest; x and y are those of the plan, as no plan says where the house stands."""
    low, high = house.part.bounds_m
    transform = (*IDENTITY[:14], options.plinth - house.spaces[0].storey.elevation_m, IDENTITY[15])
    return Place(
        parts=[
            PlacePart(
                id=house.part.id,
                name="House",
                model=model,
                document=document,
                transform=transform,
                arrangement="single",
                bounds=Bounds(min=low, max=high),
            )
        ],
        start=_start(house.spaces[0]),
    )


def _start(space: Space) -> Start:
    """Before the front door, or a gap that leads in; else before the whole house."""
    ways = [hole for hole in space.holes if hole.opening.kind != "window" and _outside(hole, space)]
    if ways:
        front = max(ways, key=_inviting)
        middle = front.start + front.along * front.width_m / 2.0
        return Start(eye=_at(_before(front, middle, space), EYE_M), target=_at(middle, EYE_M - 0.3))
    left, bottom, right, top = space.slab.bounds
    away = max(AWAY_M[0], WHOLE * (right - left))
    middle = np.array([(left + right) / 2.0, (bottom + top) / 2.0])
    return Start(eye=_at(np.array([middle[0], bottom - away]), EYE_M), target=_at(middle, EYE_M))


def _inviting(hole: Hole) -> tuple[bool, bool, float]:
    """Doors before gaps, garages last of doors, the surest first."""
    opening = hole.opening
    return opening.kind == "door", opening.type != "garage", opening.score


def _before(hole: Hole, middle: np.ndarray, space: Space) -> np.ndarray:
    """Where the visitor stands: outside, with nothing of the house between."""
    out = _outside(hole, space) * np.array([-hole.along[1], hole.along[0]])
    near = middle + (hole.line.half_m + 0.1) * out
    free = [
        middle + away * out
        for away in AWAY_M
        if not space.covered.intersects(LineString([near, middle + away * out]))
    ]
    return free[0] if free else middle + AWAY_M[-1] * out


def _outside(hole: Hole, space: Space) -> int:
    """+1 where the left of an opening is outdoors and its right is not, -1 the other way, or 0."""
    middle = hole.start + hole.along * hole.width_m / 2.0
    left = np.array([-hole.along[1], hole.along[0]]) * (hole.line.half_m + 0.1)
    on_left, on_right = (
        not space.covered.covers(Point(middle + side * left)) for side in (1.0, -1.0)
    )
    return int(on_left) - int(on_right)


def _at(point: np.ndarray, height_m: float) -> Vector:
    return (float(point[0]), float(point[1]), height_m)
