"""A room that only one window joins to another room is entered there."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from veduta.plan.drawn import Cleaned, Drawn, DrawnOpening, DrawnRoom
from veduta.plan.openings.way_in import with_ways_in

METRES_PER_PX = 0.01


def window(name: str, width_px: float = 150.0) -> DrawnOpening:
    return DrawnOpening(name, "w1", "window", "filled", 10.0, width_px, "none", "none", 0.97)


def door(name: str) -> DrawnOpening:
    return replace(window(name), kind="door", type="swing")


def room(name: str, *openings: str, outdoors: bool = False) -> DrawnRoom:
    outline = np.array([(0.0, 0.0), (300.0, 0.0), (300.0, 300.0), (0.0, 300.0)])
    return DrawnRoom(name, outline, (), (), openings, False, 0.9, outdoors)


def kinds(rooms: list[DrawnRoom], openings: list[DrawnOpening]) -> tuple[list[str], list[str]]:
    """What the openings are in the end, and what is said."""
    blank = np.zeros((300, 300), np.float32)
    cleaned = Cleaned(np.zeros((300, 300, 3), np.uint8), blank, np.eye(3), False, 0.0, 1.0)
    drawn = Drawn(cleaned, (), (), tuple(openings), tuple(rooms))
    found, notes = with_ways_in(drawn, METRES_PER_PX)
    return [one.kind for one in found.openings], notes


def test_a_closet_behind_panes_has_a_door() -> None:
    rooms = [room("bed", "a", "b", "c"), room("closet", "c")]
    found, notes = kinds(rooms, [door("a"), window("b"), window("c")])
    assert found == ["door", "window", "door"]
    assert notes == [
        "c is drawn like a window, but nothing else leads into closet: it is taken for a door."
    ]


def test_it_is_of_unknown_type_and_doubted() -> None:
    blank = np.zeros((300, 300), np.float32)
    cleaned = Cleaned(np.zeros((300, 300, 3), np.uint8), blank, np.eye(3), False, 0.0, 1.0)
    rooms = (room("bed", "a", "c"), room("closet", "c"))
    drawn = Drawn(cleaned, (), (), (door("a"), window("c")), rooms)
    found = with_ways_in(drawn, METRES_PER_PX)[0].openings[1]
    assert (found.type, found.width_px) == ("unknown", 150.0)
    assert found.score < 0.5


@pytest.mark.parametrize(
    ("rooms", "openings"),
    [
        # To the outdoors, which no other room has.
        ([room("bed", "a"), room("shed", "b")], [door("a"), window("b")]),
        # A shaft that gives light to two rooms.
        (
            [room("bed", "a", "b"), room("bath", "c", "d"), room("shaft", "b", "d")],
            [door("a"), window("b"), door("c"), window("d")],
        ),
        # There is a door.
        ([room("bed", "a", "b"), room("bath", "a", "b")], [door("a"), window("b")]),
        # Too narrow to pass.
        ([room("bed", "a", "b"), room("closet", "b")], [door("a"), window("b", 40.0)]),
        # A terrace, and the window before it.
        ([room("bed", "a", "b"), room("terrace", "b", outdoors=True)], [door("a"), window("b")]),
    ],
)
def test_other_windows_stay(rooms: list[DrawnRoom], openings: list[DrawnOpening]) -> None:
    assert kinds(rooms, openings) == ([one.kind for one in openings], [])


def test_two_rooms_that_share_it_are_told_of_once() -> None:
    rooms = [room("bed", "b"), room("closet", "b")]
    found, notes = kinds(rooms, [window("b")])
    assert found == ["door"]
    assert len(notes) == 1
