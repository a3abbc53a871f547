"""The place of a house: its part, the plinth it stands on, and where a visitor begins."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from veduta.place.camera_path import CameraPath
from veduta.place.manifest import Start, Tour, Vector
from veduta.place.place import ModelFile, Place, Standing
from veduta.place.sunlight import Sunlight
from veduta.plan.house.build import House
from veduta.plan.house.entrance import AWAY_M, entrances, free_before
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
    paths: Sequence[CameraPath] = (),
    sunlight: Sunlight | None = None,
) -> Place:
    """The house in a place; x and y are those of the plan, as no plan says where it stands.

    model, document, city_model: its files. tours: in the world frame. paths, sunlight: what its
    model shows by itself.
    """
    transform = np.eye(4)
    transform[2, 3] = raised_m(house, options)
    place = Place(tours=list(tours), start=visitor_start(house))
    place.add(
        house.part,
        Standing("House", transform, document=document, city_model=city_model),
        ModelFile(model, tuple(paths), sunlight),
    )
    return place


def visitor_start(house: House) -> Start:
    """Before the front door, or a gap that leads in; else before the whole house."""
    space = house.spaces[house.ground]
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
