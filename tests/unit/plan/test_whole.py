"""A house whose rooms cannot be walked to is no whole house, and that is said first."""

from __future__ import annotations

import numpy as np
from sample_plan import sample_plan

from veduta.place.camera_path import CameraPath
from veduta.plan.doubts import doubts
from veduta.plan.tour.find import Tour
from veduta.plan.tour.stretches import Stretch
from veduta.plan.whole import parts_only


def tour_through(*rooms: str | None) -> Tour:
    """A tour of a second in each room of the lowest storey."""
    still = CameraPath("tour", np.arange(2.0), np.zeros((2, 3)), np.eye(2, 3), 1.0)
    stretches = tuple(
        Stretch(room, room or "outside", None if room is None else 0, i, i + 1.0)
        for i, room in enumerate(rooms)
    )
    return Tour(still, stretches, 1.0, ("a note of the tour",), ())


def test_a_house_with_a_way_to_its_rooms_is_whole() -> None:
    assert parts_only(sample_plan(), tour_through(None, "living", "bath")) == []


def test_half_of_the_rooms_are_enough() -> None:
    assert parts_only(sample_plan(), tour_through("living")) == []


def test_without_a_tour_nothing_is_known() -> None:
    assert parts_only(sample_plan(), None) == []


def test_rooms_without_a_way_are_counted_first_of_all() -> None:
    first, *others = doubts(sample_plan(), tour_through(None))
    assert first.startswith("This is no whole house: the tour reaches 0 of 2 rooms")
    assert "a note of the tour" in others


def test_a_storey_that_is_not_reached_is_named() -> None:
    plan = sample_plan()
    upper = plan.storeys[0].model_copy(update={"name": "attic"})
    both = plan.model_copy(update={"storeys": [plan.storeys[0], upper]})
    (said,) = parts_only(both, tour_through("living", "bath"))
    assert "2 of 4 rooms, and none of attic" in said
