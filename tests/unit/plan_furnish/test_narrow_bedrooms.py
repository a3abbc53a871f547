"""Bedrooms in which hardly a bed finds place: a narrow one, one whose open leaf bars the way."""

from __future__ import annotations

import numpy as np
import pytest
from sample_plan import room
from shapely.geometry import MultiPolygon, Polygon, box
from shapely.geometry.base import BaseGeometry

from veduta.plan.furnish.catalogue.read import builtin_catalogue
from veduta.plan.furnish.choice import Choice
from veduta.plan.furnish.furnish import FurnishedRoom, furnish_room
from veduta.plan.furnish.room import RoomSpace, Stretch
from veduta.plan.furnish.walk import Ways

Bounds = tuple[float, float, float, float]


def bedroom(
    size_m: tuple[float, float], doors: list[tuple[float, float]], kept: list[Bounds],
    leaves: list[Bounds],
) -> RoomSpace:  # fmt: skip
    """A bare rectangle. doors: points before them; kept: free of things; leaves: as they stand."""
    floor = Polygon([(0.0, 0.0), (size_m[0], 0.0), size_m, (0.0, size_m[1])])
    corners = np.array(floor.exterior.coords)
    edges = np.diff(corners, axis=0)
    stretches = tuple(
        Stretch(start, edge / np.hypot(*edge), float(np.hypot(*edge)), 1.0, True, True)
        for start, edge in zip(corners[:-1], edges, strict=True)
    )
    own = room("r1", [(x, y) for x, y in corners[:-1].tolist()], use="bedroom")
    return RoomSpace(
        own, floor, floor, stretches, np.array(doors), _all(kept), (), 2.5, _all(leaves)
    )


def _all(bounds: list[Bounds]) -> BaseGeometry:
    return MultiPolygon([box(*one) for one in bounds])


def beds(done: FurnishedRoom) -> list[tuple[float, float, float]]:
    return [one.size_m for one in done.stood if one.entry.kind == "bed"]


@pytest.mark.parametrize("seed", range(3))
def test_a_room_of_one_and_a_half_metres_has_a_bed_of_seventy_centimetres(seed: int) -> None:
    """Before its door, in the middle of a long wall, 65 cm are free: 86 cm are left beside it."""
    space = bedroom((1.51, 4.07), [(0.32, 2.17)], [(0.0, 1.75, 0.65, 2.59)], [])
    done = furnish_room(space, Choice(builtin_catalogue(), seed), "ground floor")
    ((width, _, _),) = beds(done)
    assert width == pytest.approx(0.78)
    assert done.notes == ()


def test_a_bed_comes_before_a_leaf_that_stands_open() -> None:
    """With both leaves open one comes from door to door, past a bed one does not."""
    doors = [(1.3, 0.32), (1.6, 2.93)]
    kept = [(0.85, 0.0, 1.76, 0.88), (0.95, 2.43, 1.92, 3.43)]
    leaves = [(1.67, 0.0, 1.73, 0.85), (0.98, 2.46, 1.92, 2.52)]
    space = bedroom((1.92, 3.99), doors, kept, leaves)
    done = furnish_room(space, Choice(builtin_catalogue(), 0), "ground floor")
    assert len(beds(done)) == 1
    assert any("leaf" in note for note in done.notes)
    things = Ways(space.floor, space.doors).grid
    mask = np.any([things.covered(one.shape) for one in done.stood if one.is_in_the_way], axis=0)
    assert Ways(space.floor, space.doors).main_region(mask) is not None
    assert Ways(space.floor, space.doors, space.leaves).main_region(mask) is None
