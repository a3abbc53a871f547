"""The place of a house: its part, the plinth it stands on, and where a visitor begins."""

from __future__ import annotations

import numpy as np

from veduta.place.manifest import IDENTITY, Bounds, Place, PlacePart, Start, Vector
from veduta.plan.house.build import House
from veduta.plan.house.space import Hole, Space
from veduta.plan.options import HouseOptions

EYE_M = 1.7
AWAY_M = 5.0
"""From the front door to the visitor."""


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
    """Before the front door, looking at it; where there is none, before the whole house."""
    doors = [hole for hole in space.holes if _outside(hole) and hole.opening.kind == "door"]
    if doors:
        door = max(doors, key=lambda hole: (hole.opening.type != "garage", hole.opening.score))
        middle = door.start + door.along * door.width_m / 2.0
        away = middle + AWAY_M * _outside(door) * np.array([-door.along[1], door.along[0]])
        return Start(eye=_at(away, EYE_M), target=_at(middle, EYE_M - 0.3))
    left, bottom, right, top = space.slab.bounds
    middle = np.array([(left + right) / 2.0, (bottom + top) / 2.0])
    size = max(right - left, top - bottom)
    return Start(eye=_at(middle - [0.0, size + AWAY_M], EYE_M), target=_at(middle, EYE_M))


def _outside(hole: Hole) -> int:
    """+1 where the left of an opening is outdoors and its right is not, -1 the other way, or 0."""
    left, right = (room is None or room.outdoors for room in (hole.left, hole.right))
    return int(left) - int(right)


def _at(point: np.ndarray, height_m: float) -> Vector:
    return (float(point[0]), float(point[1]), height_m)
