"""What slides within walls, beams over ways in dashes, walls that go on thicker."""

from __future__ import annotations

from dataclasses import replace

import cv2
import numpy as np
import pytest

from veduta.plan.openings.along import is_thicker
from veduta.plan.openings.classify import Judged, judge
from veduta.plan.openings.evidence import look_at
from veduta.plan.openings.gaps import Gap
from veduta.plan.openings.leaf_pieces import slid, slim_panels
from veduta.plan.openings.pockets import with_pockets
from veduta.plan.openings.strip import Sheet
from veduta.plan.walls.axes import Axis, OnAxis, axes_of
from veduta.plan.walls.pieces import Piece

Y, HALF, START, END, DOOR = 250, 10, 200, 280, 80.0


def hollow(*boxes: tuple[int, int, int, int]) -> Sheet:
    """A wall of two lines 20 px apart with a way from START to END, and boxes (x, y, x, y)."""
    drawn = np.zeros((500, 500), np.uint8)
    for low, high in ((40, START), (END, 460)):
        cv2.rectangle(drawn, (low, Y - HALF), (high, Y + HALF - 1), 255, 2)
    for left, top, right, bottom in boxes:
        cv2.rectangle(drawn, (left, top), (right, bottom), 255, 2)
    ink = (drawn / 255).astype(np.float32)
    return Sheet(ink, ink > 0.3)


def axis(first: float, last: float) -> Axis:
    """The wall with a way through in which no leaf was seen."""
    line = Piece(np.array([40.0, Y]), np.array([460.0, Y]), 2.0 * HALF)
    gap = Gap.along(line, first - 40.0, last - 40.0)
    seen = Judged(gap, "gap", "plain", "none", "none", 0.5)
    return Axis(line, (OnAxis(seen, first - 40.0, last - 40.0, along=True),))


@pytest.mark.parametrize(
    ("leaf", "hinge"), [((150, Y - 3, 222, Y + 2), "start"), ((256, Y - 3, 330, Y + 2), "end")]
)
def test_a_leaf_that_comes_out_of_the_wall_is_a_pocket_door(
    leaf: tuple[int, int, int, int], hinge: str
) -> None:
    # The slot's lines part the wall, so that a way was seen there, too.
    tip = 222.0 if hinge == "start" else 256.0
    known = axis(tip, END) if hinge == "start" else axis(START, tip)
    slot = axis(130.0, 190.0) if hinge == "start" else axis(290.0, 350.0)
    both = replace(known, openings=(*known.openings, *slot.openings))
    (found,) = with_pockets([both], hollow(leaf), DOOR)
    (door,) = found.openings
    assert (door.judged.kind, door.judged.type, door.judged.hinge) == ("door", "pocket", hinge)
    assert (door.first, door.last) == pytest.approx((START - 40.0, END - 40.0), abs=3.0)


@pytest.mark.parametrize(
    "box",
    [
        (230, Y - 3, 250, Y + 2),  # in the middle of the way
        (150, Y - 3, 330, Y + 2),  # all across it
        (150, Y + 20, 222, Y + 25),  # beside the wall
    ],
)
def test_what_does_not_come_out_of_the_wall_is_none(box: tuple[int, int, int, int]) -> None:
    (found,) = with_pockets([axis(START, END)], hollow(box), DOOR)
    assert [one.judged.type for one in found.openings] == ["plain"]


def test_a_panel_that_was_taken_for_a_wall_is_told_by_the_other_one() -> None:
    walls = [
        Piece(np.array([40.0, Y]), np.array([200.0, Y]), 20.0),
        Piece(np.array([360.0, Y]), np.array([460.0, Y]), 20.0),
        Piece(np.array([201.0, Y - 5.0]), np.array([284.0, Y - 5.0]), 8.0),
        Piece(np.array([100.0, 60.0]), np.array([100.0, 140.0]), 8.0),
    ]
    assert slim_panels(walls, 20.0, DOOR) == {2}
    gap = Gap(0, True, 1, False, walls[0].end, walls[1].start, 20.0, walls[1].start)
    door = Judged(gap, "door", "sliding", "none", "none", 0.7)
    assert slid([walls[2]], [door]) == [True]
    assert slid([walls[2]], [replace(door, type="swing")]) == [False]


@pytest.mark.parametrize(
    ("dash", "between", "found"), [(True, False, True), (True, True, False), (False, False, False)]
)
def test_both_faces_in_dashes_are_a_beam_over_a_wide_way(
    dash: bool, between: bool, found: bool
) -> None:
    drawn = np.zeros((500, 900), np.uint8)
    for low, high in ((40, 200), (600, 860)):
        cv2.rectangle(drawn, (low, Y - HALF), (high, Y + HALF - 1), 255, -1)
    for left in range(204, 596, 24):
        for face in (Y - HALF, Y + HALF - 2) if dash else ():
            cv2.rectangle(drawn, (left, face), (left + 12, face + 1), 255, -1)
    if between:
        cv2.rectangle(drawn, (204, Y - 4), (596, Y + 4), 255, -1)
    ink = (drawn / 255).astype(np.float32)
    ends = np.array([200.0, Y]), np.array([600.0, Y])
    gap = Gap(0, True, 1, False, *ends, 2.0 * HALF, ends[1])
    judged = judge(gap, look_at(gap, Sheet(ink, ink > 0.3)), 2.0 * HALF, False)
    assert (judged is not None and judged.kind == "gap") is found


@pytest.mark.parametrize(("half", "middle", "thicker"), [(18, False, True), (18, True, False),
                                                         (10, False, False)])  # fmt: skip
def test_a_wall_that_goes_on_thicker_is_no_window(half: int, middle: bool, thicker: bool) -> None:
    drawn = np.zeros((500, 500), np.uint8)
    for side in (-half, half):
        cv2.line(drawn, (200, Y + side), (300, Y + side), 255, 2)
    if middle:
        cv2.line(drawn, (200, Y), (300, Y), 255, 2)
    ink = (drawn / 255).astype(np.float32)
    assert is_thicker(axis(START, END), (160.0, 260.0), Sheet(ink, ink > 0.3)) is thicker


def test_one_window_of_a_bay_is_not_two() -> None:
    pieces = [
        Piece(np.array([0.0, Y]), np.array([100.0, Y]), 20.0),
        Piece(np.array([200.0, Y]), np.array([300.0, Y]), 20.0),
    ]
    there = Gap(0, True, 1, False, pieces[0].end, pieces[1].start, 20.0, pieces[1].start)
    back = Gap(1, False, 0, True, pieces[1].start, pieces[0].end + 4.0, 20.0, pieces[0].end)
    judged = [Judged(one, "window", "filled", "none", "none", score)
              for one, score in ((there, 0.9), (back, 0.8))]  # fmt: skip
    (joined,) = axes_of(pieces, judged)
    assert [one.judged.score for one in joined.openings] == [0.9]
