"""A flight drawn UP on one sheet and DN on the next is one; what an upper floor alone says."""

from __future__ import annotations

import numpy as np
import pytest
from sample_plan import sample_plan
from shapely.geometry import Polygon

from veduta.plan.document import PlanDocument, Stairs
from veduta.plan.house.shown_twice import going_on, shown_twice
from veduta.plan.options import HouseOptions
from veduta.plan.tour.climbs import _high
from veduta.plan.upper_floor import upper_floor, upper_floor_doubts, upper_floor_options


def stairs(
    low: float, high: float, up: tuple[float, float], treads: int = 10, left: float = 0.0
) -> Stairs:
    ring = [(left, low), (left + 0.9, low), (left + 0.9, high), (left, high)]
    return Stairs(id="s1", outline_m=ring, treads=treads, up=up, score=0.9)


def test_the_way_up_is_taken_from_the_sheet_that_tells_it() -> None:
    found, notes = shown_twice([stairs(0, 2.5, (0, 0))], [stairs(0, 2.5, (0, 1))])
    assert found[0].up == (0, 1)
    assert notes == []


def test_a_flight_is_as_long_as_both_sheets_show_it() -> None:
    found, _ = shown_twice([stairs(0, 1.5, (0, 1), 6)], [stairs(0.5, 3.0, (0, 1), 10)])
    assert found[0].treads == 12
    assert Polygon(found[0].outline_m).bounds == pytest.approx((0.0, 0.0, 0.9, 3.0))


def test_what_lies_elsewhere_says_nothing() -> None:
    own = [stairs(0, 2.5, (0, 0))]
    assert shown_twice(own, [stairs(0, 2.5, (0, 1), left=4.0)]) == (own, [])


def test_ways_that_contradict_each_other_are_told() -> None:
    found, notes = shown_twice([stairs(0, 2.5, (0, 1))], [stairs(0, 2.5, (0, -1))])
    assert found[0].up == (0, 1)
    assert "the lower one is believed" in notes[0]


def test_a_flight_by_which_one_arrives_does_not_lead_on() -> None:
    """The sheet between shows the flight from below, and the one above has its own elsewhere."""
    below, above = [stairs(0, 2.5, (0, 1))], [stairs(0, 2.5, (0, 1), left=4.0)]
    own = [stairs(0.1, 2.5, (0, 1))]
    assert going_on(below, own, above) == []
    assert going_on(below, [*own, *above], above) == above
    # Flights over each other all lead up, and so does what nothing else can.
    assert going_on(below, own, below) == own
    assert going_on(below, own, []) == own
    assert going_on([], own, above) == own


def named(name: str) -> PlanDocument:
    plan = sample_plan()
    storey = plan.storeys[0].model_copy(update={"name": name})
    return plan.model_copy(update={"storeys": [storey]})


@pytest.mark.parametrize("name", ["First floor", "2. Obergeschoss", "1er étage", "Top floor"])
def test_an_upper_floor_alone_is_told_and_has_no_garden(name: str) -> None:
    assert upper_floor(named(name).storeys) == name
    (doubt,) = upper_floor_doubts(named(name))
    assert "the visit begins inside" in doubt
    assert upper_floor_options(named(name), HouseOptions()).surroundings == "none"
    flat = named(name).model_copy(update={"flat": True})
    assert upper_floor_doubts(flat) == []


@pytest.mark.parametrize("name", ["Ground floor", "Basement", "Erdgeschoss", "My house"])
def test_other_floors_are_no_upper_ones(name: str) -> None:
    assert upper_floor_doubts(named(name)) == []
    assert upper_floor_options(named(name), HouseOptions()).surroundings == "garden"


def test_walls_over_the_foot_of_stairs_are_above_who_climbs_them() -> None:
    line = np.array([[0.45, -0.4, 0.0], [0.45, 3.0, 2.8]])
    assert _high(line, 0.8)[:, 1] == pytest.approx([3.0, -0.4 + 0.8 / 2.8 * 3.4])
    bent = np.array([[0.0, 0.0, 0.0], [0.0, 1.0, 1.0], [1.0, 1.0, 2.0], [2.0, 1.0, 2.8]])
    assert _high(bent, 0.9)[-1] == pytest.approx([0.0, 0.9, 0.9])
    assert len(_high(bent, 0.9)) == 4
