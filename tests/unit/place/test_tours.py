"""Tours in `place.json`: what is refused, and what becomes of them where places are merged."""

from __future__ import annotations

from typing import Any

import pytest
from pydantic import ValidationError

from veduta.place.manifest import Bounds, Place, PlacePart, Start, Tour, TourStretch, merge
from veduta.run.errors import InputError


def tour(name: str = "tour", **changes: Any) -> Tour:
    fields: dict[str, Any] = {
        "id": name,
        "name": "Tour",
        "times_s": [0.0, 1.0, 2.5],
        "eyes": [(0.0, 0.0, 1.7), (1.0, 0.0, 1.7), (2.0, 1.0, 1.7)],
        "directions": [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.6, 0.8)],
        "stretches": [TourStretch(room="r1", name="Hall", start_s=0.0, end_s=2.5)],
    }
    return Tour.model_validate(fields | changes)


def place(*tours: Tour, origin: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> Place:
    bounds = Bounds(min=(0.0, 0.0, 0.0), max=(1.0, 1.0, 1.0))
    part = PlacePart(id="a", name="a", model="a.glb", arrangement="single", bounds=bounds)
    start = Start(eye=(0.0, -9.0, 1.7), target=(0.0, 0.0, 1.0))
    return Place(
        parts=[part] if origin[0] == 0.0 else [], tours=list(tours), origin=origin, start=start
    )


@pytest.mark.parametrize(
    ("changes", "fault"),
    [
        ({"times_s": [0.5, 1.0, 2.0]}, "ascend"),
        ({"times_s": [0.0, 1.0, 1.0]}, "ascend"),
        ({"times_s": [0.0, 1.0]}, "one eye"),
        ({"eyes": [(0.0, 0.0, 1.7)]}, "one eye"),
        ({"directions": [(1.0, 0.0, 0.0), (0.0, 2.0, 0.0), (0.0, 0.6, 0.8)]}, "unit"),
        ({"times_s": [0.0, 1.0, float("nan")]}, "finite"),
        ({"speed": 3.0}, "Extra"),
    ],
)
def test_what_is_no_tour_is_refused(changes: dict[str, Any], fault: str) -> None:
    with pytest.raises(ValidationError, match=fault):
        tour(**changes)


def test_two_of_one_id_are_refused() -> None:
    with pytest.raises(ValidationError, match="two tours"):
        place(tour(), tour())


def test_there_and_back() -> None:
    given = place(tour())
    assert Place.model_validate_json(given.model_dump_json(by_alias=True)) == given


def test_tours_move_with_their_place() -> None:
    both = merge(place(tour()), place(tour("other"), origin=(10.0, 20.0, 1.0)))
    assert [one.id for one in both.tours] == ["tour", "other"]
    assert both.tours[0] == tour()
    assert both.tours[1].eyes == [(10.0, 20.0, 2.7), (11.0, 20.0, 2.7), (12.0, 21.0, 2.7)]
    assert both.tours[1].directions == tour().directions


def test_two_that_differ_under_one_id_are_not_merged() -> None:
    with pytest.raises(InputError, match="both places have a tour"):
        merge(place(tour()), place(tour(), origin=(10.0, 0.0, 0.0)))
