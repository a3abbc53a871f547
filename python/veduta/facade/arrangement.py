"""Several facades of one call as one place: side by side along a street.

Nothing in the photos says where the buildings stand to each other, so the arrangement is marked
as invented. World frame: x along the street, y away from it, z up; the fronts are at y = 0.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from veduta.place.manifest import IDENTITY, Bounds, PlacePart, Start
from veduta.place.place import Place

GAP_M = 3.0
"""Between neighbours: wide enough to see the sides, too narrow to lose the street."""
EYE_M = 1.7
MIN_DISTANCE_M, MAX_DISTANCE_M = 12.0, 40.0

Vector = tuple[float, float, float]


@dataclass(frozen=True)
class Placed:
    """A finished building: the folder of its files, and its box in its own frame (m)."""

    name: str
    low: Vector
    high: Vector


def arrange(buildings: Sequence[Placed], out: Path) -> Place:
    """The place of these buildings, from left to right in the order given.

    Their models lie in OUT already, each written when its photo was done.
    """
    place = Place()
    at_m = 0.0
    for building in buildings:
        shift_m = at_m - building.low[0] if place.parts else 0.0
        place.lay(_part(building, shift_m, alone=len(buildings) == 1), out)
        at_m = building.high[0] + shift_m + GAP_M
    place.start = _start(buildings, at_m - GAP_M)
    return place


def _part(building: Placed, shift_m: float, alone: bool) -> PlacePart:
    transform = list(IDENTITY)
    transform[12] = shift_m
    folder = building.name
    return PlacePart(
        id=folder,
        name=folder,
        model=f"{folder}/model.glb",
        city_model=f"{folder}/model.city.json",
        document=f"{folder}/facade.json",
        photo=f"{folder}/rectified.jpg",
        transform=tuple(transform),
        arrangement="single" if alone else "invented",
        bounds=Bounds(min=building.low, max=building.high),
    )


def _start(buildings: Sequence[Placed], right_m: float) -> Start:
    """Before the middle of the row, far enough to see a whole front."""
    left_m = buildings[0].low[0]
    height_m = max(building.high[2] for building in buildings)
    middle_m = (left_m + right_m) / 2
    distance_m = min(max(MIN_DISTANCE_M, 1.3 * height_m), MAX_DISTANCE_M)
    front_m = min(building.low[1] for building in buildings)
    return Start(
        eye=(middle_m, front_m - distance_m, EYE_M), target=(middle_m, 0.0, 0.4 * height_m)
    )
