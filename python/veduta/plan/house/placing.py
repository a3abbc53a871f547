"""The place of a house: its part, the plinth it stands on, and where a visitor begins."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from veduta.place.manifest import IDENTITY, Bounds, Place, PlacePart, Start, Tour, Vector
from veduta.plan.house.build import House
from veduta.plan.house.entrance import AWAY_M, entrances, free_before
from veduta.plan.house.space import Space
from veduta.plan.options import HouseOptions

EYE_M = 1.7
WHOLE = 0.7
"""From a house without a door to the visitor, in widths of it: so it fits into the picture."""


def raised_m(house: House, options: HouseOptions) -> float:
    """How much higher the house stands in its place than in the plan frame."""
    return options.plinth - house.spaces[house.ground].storey.elevation_m


def place_of(
    house: House,
    model: str,
    document: str | None,
    options: HouseOptions,
    tours: Sequence[Tour] = (),
    city_model: str | None = None,
) -> Place:
    """The manifest; x and y are those of the plan, as no plan says where the house stands.

    tours: in the world frame.
    """
    low, high = house.part.bounds_m
    transform = (*IDENTITY[:14], raised_m(house, options), IDENTITY[15])
    return Place(
        parts=[
            PlacePart(
                id=house.part.id,
                name="House",
                model=model,
                city_model=city_model,
                document=document,
                transform=transform,
                arrangement="single",
                bounds=Bounds(min=low, max=high),
            )
        ],
        tours=list(tours),
        start=_start(house.spaces[house.ground]),
    )


def _start(space: Space) -> Start:
    """Before the front door, or a gap that leads in; else before the whole house."""
    ways = entrances(space)
    if ways:
        eye = free_before(ways[0], space)
        return Start(eye=_at(eye, EYE_M), target=_at(ways[0].middle, EYE_M - 0.3))
    left, bottom, right, top = space.slab.bounds
    away = max(AWAY_M[0], WHOLE * (right - left))
    middle = np.array([(left + right) / 2.0, (bottom + top) / 2.0])
    return Start(eye=_at(np.array([middle[0], bottom - away]), EYE_M), target=_at(middle, EYE_M))


def _at(point: np.ndarray, height_m: float) -> Vector:
    return (float(point[0]), float(point[1]), height_m)
