"""Leaves that are not drawn hang where a builder would hang them."""

from __future__ import annotations

from typing import Any

import pytest
from sample_plan import opening, rectangle, room, sample_storey, wall

from veduta.plan.document import Junction
from veduta.plan.house.hole import Hole
from veduta.plan.house.space import space_of

LIVING = rectangle(0.15, 0.15, 4.94, 4.85)
BEYOND = rectangle(5.06, 0.15, 7.85, 4.85)


def hung(name: str, *openings: Any, **beyond: Any) -> Hole:
    """An opening of the sample house, whose second room is what `beyond` says."""
    rooms = [room("living", LIVING), room("beyond", BEYOND, **({"use": "bedroom"} | beyond))]
    space = space_of(sample_storey(openings=list(openings), rooms=rooms), 2.55)
    return next(hole for hole in space.holes if hole.opening.id == name)


INNER = opening("inner", "middle", 1.0, 0.9)
"""Its wall goes north: the living room is on the left, 1 m of wall is south of it, 3.1 m north."""


def test_it_opens_into_the_smaller_room_against_the_nearest_wall() -> None:
    hole = hung("inner", INNER)
    assert (hole.hinge, hole.swing) == ("start", "right")
    far = hung("inner", opening("inner", "middle", 3.4, 0.9))
    assert (far.hinge, far.swing) == ("end", "right")


@pytest.mark.parametrize("beyond", [{"use": "corridor"}, {"use": "stairs"}])
def test_it_does_not_open_into_a_way(beyond: dict[str, Any]) -> None:
    assert hung("inner", INNER, **beyond).swing == "left"


def test_it_does_not_fill_a_closet() -> None:
    storey = sample_storey(openings=[INNER])
    closet = room("beyond", rectangle(5.06, 0.15, 5.9, 2.9), use="wardrobe")
    rooms = [room("living", LIVING), closet]
    (hole,) = space_of(storey.model_copy(update={"rooms": rooms}), 2.55).holes
    assert hole.swing == "left"


def test_what_is_too_wide_for_one_leaf_has_two_or_slides() -> None:
    """Only where no leaf is drawn: a drawn one stays as it is."""
    wide = opening("inner", "middle", 1.0, 1.6, type="unknown")
    assert (hung("inner", wide).type, hung("inner", wide).hinge) == ("double", "both")
    assert hung("inner", wide.model_copy(update={"width_m": 1.0})).type == "unknown"
    drawn = wide.model_copy(update={"hinge": "start", "swing": "left"})
    assert hung("inner", drawn).type == "unknown"
    assert hung("front", opening("front", "south-1", 0.6, 1.9, type="unknown")).type == "sliding"
    closet = room("beyond", rectangle(5.06, 0.15, 5.9, 2.9), use="wardrobe")
    storey = sample_storey(openings=[wide], rooms=[room("living", LIVING), closet])
    (hole,) = space_of(storey, 2.55).holes
    assert hole.type == "sliding"


def test_a_front_door_opens_inward() -> None:
    """The south wall goes east, and the house is on its left."""
    assert hung("front", opening("front", "south-1", 0.6, 1.0)).swing == "left"


def test_it_does_not_stand_before_another_opening() -> None:
    """The west wall goes south: its door is beside the front door's first end."""
    front = opening("front", "south-1", 0.3, 0.9)
    beside = opening("beside", "west", 3.6, 1.0, kind="gap", type="plain")
    assert hung("front", front).hinge == "start"
    assert hung("front", front, beside).hinge == "end"


@pytest.mark.parametrize("hinge", ["start", "end", "both"])
@pytest.mark.parametrize("swing", ["left", "right", "both"])
def test_what_is_drawn_stays(hinge: str, swing: str) -> None:
    hole = hung("inner", opening("inner", "middle", 1.0, 0.9, hinge=hinge, swing=swing))
    assert (hole.hinge, hole.swing) == (hinge, swing)


def test_half_of_it_may_be_drawn() -> None:
    hole = hung("inner", opening("inner", "middle", 1.0, 0.9, hinge="end"))
    assert (hole.hinge, hole.swing) == ("end", "right")
    hole = hung("inner", opening("inner", "middle", 1.0, 0.9, swing="left"))
    assert (hole.hinge, hole.swing) == ("start", "left")


def test_what_a_leaf_sweeps_is_a_quarter_disc() -> None:
    hole = hung("inner", INNER)
    swept = hole.sweep("start", -1.0, 0.9)
    assert swept.area == pytest.approx(3.14159 * 0.81 / 4.0, rel=0.02)
    left, bottom, right, top = swept.bounds
    assert (left, bottom, right, top) == pytest.approx((5.06, 1.0, 5.96, 1.9), abs=0.02)


def test_a_leaf_slides_where_there_is_wall_to_slide_along() -> None:
    """South of the opening is 1 m of wall, north of it 3.1 m; 0.9 m of them go to a door."""
    sliding = opening("inner", "middle", 1.0, 1.2, type="sliding")
    assert hung("inner", sliding).hinge == "end"
    door = opening("beside", "middle", 2.9, 0.9)
    assert hung("inner", sliding, door).hinge == "both"
    near = opening("beside", "middle", 2.3, 0.9)
    assert hung("inner", sliding.model_copy(update={"width_m": 0.9}), near).hinge == "start"
    drawn = sliding.model_copy(update={"hinge": "start", "swing": "left"})
    assert (hung("inner", drawn, door).hinge, hung("inner", drawn, door).swing) == (
        "start",
        "left",
    )


def test_a_pocket_is_where_the_wall_is_long_enough() -> None:
    assert hung("inner", opening("inner", "middle", 0.4, 0.8, type="pocket")).hinge == "end"
    assert hung("inner", opening("inner", "middle", 3.6, 0.8, type="pocket")).hinge == "start"


def test_what_leads_outdoors_slides_indoors() -> None:
    front = hung("front", opening("front", "south-1", 0.6, 1.9, type="sliding"))
    assert (front.right if front.swing == "right" else front.left) is not None


def l_shaped(*openings: Any) -> dict[str, Hole]:
    """A room of 8 m by 6 m without its upper right quarter, 4 m by 3 m; walls of 30 cm."""
    corners = {
        "a": (0.0, 0.0), "b": (8.0, 0.0), "c": (8.0, 3.0), "d": (4.0, 3.0), "e": (4.0, 6.0),
        "f": (0.0, 6.0),
    }  # fmt: skip
    floor = [(0.15, 0.15), (7.85, 0.15), (7.85, 2.85), (3.85, 2.85), (3.85, 5.85), (0.15, 5.85)]
    storey = sample_storey(
        junctions=[Junction(id=name, at_m=at, type="L") for name, at in corners.items()],
        walls=[wall(name, name[0], name[1]) for name in ("ab", "bc", "cd", "de", "ef", "fa")],
        openings=list(openings),
        rooms=[room("living", floor)],
    )
    return {hole.opening.id: hole for hole in space_of(storey, 2.55).holes}


@pytest.mark.parametrize("beside_m", [0.2, 0.3])
def test_no_leaf_slides_past_a_corner_into_the_room(beside_m: float) -> None:
    """North of the door in "de" is 1 m of wall; south of it is the corner, and the free room."""
    door = opening("door", "de", beside_m, 1.5, type="sliding", swing="left")
    assert l_shaped(door)["door"].hinge in ("end", "both")
    long = opening("door", "cd", 4.0 - 1.2 - beside_m, 1.2, type="sliding")
    found = l_shaped(long)["door"]
    assert (found.hinge, found.swing) == ("start", "left")


def test_outdoors_on_both_sides_it_slides_where_the_wall_is() -> None:
    storey = sample_storey(
        openings=[opening("gate", "middle", 0.1, 1.2, type="sliding", swing="both")], rooms=[]
    )
    (hole,) = space_of(storey, 2.55).holes
    assert hole.hinge == "end"


def test_a_pocket_is_in_no_window_and_in_no_bend() -> None:
    pocket = opening("door", "fa", 1.2, 1.0, type="pocket")
    window = opening("window", "fa", 2.4, 1.5, kind="window", type="double-line")
    assert l_shaped(pocket, window)["door"].hinge == "start"
