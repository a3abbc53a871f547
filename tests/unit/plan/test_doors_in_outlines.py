"""A door in an outer wall that is a thin line: the wall passes it straight, the door is in it."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

from veduta.plan.document import Text
from veduta.plan.drawn import Drawn, DrawnOpening
from veduta.plan.openings.along import doubled_stretches
from veduta.plan.openings.strip import Sheet, cut_strip
from veduta.plan.reading import read_storey
from veduta.plan.rooms.sweeps import doors_in, without_sweeps
from veduta.plan.walls.pieces import Piece

Pixels = NDArray[np.uint8]
BLACK, WHITE = (0, 0, 0), (255, 255, 255)
DOOR = 90


def _swinging(
    page: Pixels, hinge: tuple[int, int], jamb: tuple[int, int], tip: tuple[int, int]
) -> None:
    """A gap of the line, the leaf, and the quarter circle from its tip to the jamb."""
    cv2.line(page, hinge, jamb, WHITE, 5)
    cv2.line(page, hinge, tip, BLACK, 2)
    shut, opened = (np.subtract(end, hinge) for end in (jamb, tip))
    turned = np.linspace(0.0, np.pi / 2, 60)[:, None]
    trace = hinge + np.cos(turned) * shut + np.sin(turned) * opened
    cv2.polylines(page, [trace.round().astype(np.int32)], False, BLACK, 2)


def _written(text: str, x: float, y: float) -> Text:
    box = [(x - 50, y - 10), (x + 50, y - 10), (x + 50, y + 10), (x - 50, y + 10)]
    return Text(text=text, box_px=box, score=0.99)


def _flat(*, inwards: bool = True) -> Drawn:
    """A flat of two rooms and one above, whose sides are a line of 2 px: a door in its left one."""
    page = np.full((1000, 1000, 3), 255, np.uint8)
    cv2.rectangle(page, (150, 500), (770, 820), BLACK, 14)
    cv2.line(page, (460, 500), (460, 820), BLACK, 10)
    for x, y in ((460, 620), (300, 500)):
        across = (6, 0) if x == 460 else (0, 8)
        along = (0, DOOR) if x == 460 else (DOOR, 0)
        low, high = np.subtract((x, y), across), np.add(np.add((x, y), across), along)
        cv2.rectangle(page, low.tolist(), high.tolist(), WHITE, -1)
    _swinging(page, (460, 620), (460, 710), (550, 620))
    _swinging(page, (300, 507), (390, 507), (300, 597))
    for start in (180, 560):
        cv2.rectangle(page, (start, 812), (start + 110, 828), WHITE, -1)
        for y in (814, 820, 826):
            cv2.line(page, (start, y), (start + 110, y), BLACK, 2)
    cv2.line(page, (160, 500), (160, 150), BLACK, 2)
    cv2.line(page, (160, 150), (640, 150), BLACK, 2)
    cv2.line(page, (640, 150), (640, 500), BLACK, 2)
    # Glazing has a second line.
    cv2.line(page, (380, 140), (560, 140), BLACK, 2)
    cv2.line(page, (380, 140), (380, 150), BLACK, 2)
    cv2.line(page, (560, 140), (560, 150), BLACK, 2)
    way = 1 if inwards else -1
    _swinging(page, (160, 380), (160, 380 - DOOR), (160 + way * DOOR, 380))
    texts = [_written("Wohnen", 420, 340), _written("Zimmer", 280, 700), _written("Bad", 600, 650)]
    return read_storey(page, texts)


def _at(drawn: Drawn, one: DrawnOpening) -> NDArray[np.float64]:
    """The middle of an opening on the page."""
    start, end = drawn.wall_ends(next(wall for wall in drawn.walls if wall.id == one.wall))
    way = (end - start) / np.hypot(*(end - start))
    place = start + (one.along_px + one.width_px / 2) * way
    to_page = np.linalg.inv(drawn.cleaned.clean_from_scan)
    return np.asarray((to_page @ (*place, 1.0))[:2])


@pytest.mark.parametrize("inwards", [True, False])
def test_the_wall_passes_a_door_straight_and_has_it(inwards: bool) -> None:
    drawn = _flat(inwards=inwards)
    to_page = np.linalg.inv(drawn.cleaned.clean_from_scan)
    corners = {
        tuple(np.round((to_page @ (*one.at_px, 1.0))[:2] / 10).astype(int) * 10)
        for one in drawn.junctions
    }
    # No wall runs along leaf or trace.
    assert not [at for at in corners if 180 < at[0] < 280 and 270 < at[1] < 400]
    doors = [one for one in drawn.openings if one.kind == "door"]
    (door,) = [one for one in doors if np.abs(_at(drawn, one) - (160, 335)).max() < 25]
    assert door.type == "swing"
    assert door.width_px * np.sqrt(np.linalg.det(to_page[:2, :2])) == pytest.approx(DOOR, rel=0.1)
    assert len(doors) == 3


def test_a_thin_line_is_a_wall_and_two_are_a_window() -> None:
    drawn = _flat()
    windows = [_at(drawn, one) for one in drawn.openings if one.kind == "window"]
    above = [at for at in windows if at[1] < 480]
    assert len(windows) == 3
    assert len(above) == 1
    assert np.abs(above[0] - (470, 145)).max() < 20


def _room(bite: bool) -> NDArray[np.bool_]:
    """A room from (50, 50) to (350, 350) with a quarter of a circle cut out of its left side."""
    room = np.zeros((400, 400), np.uint8)
    room[50:350, 50:350] = 1
    if bite:
        cv2.ellipse(room, (50, 250), (90, 90), 0, 270, 360, 0, -1)
    return room.astype(np.bool_)


def test_a_bite_is_filled_and_is_a_door() -> None:
    whole, sweeps = without_sweeps(_room(bite=True), 85.0, 10.0)
    assert (whole == _room(bite=False)).mean() > 0.999
    (one,) = sweeps
    assert one.hinge == pytest.approx((50, 250), abs=4)
    assert one.jamb == pytest.approx((50, 160), abs=6)
    wall = Piece(np.array([45.0, 350.0]), np.array([45.0, 50.0]), 10.0)
    (door,) = doors_in(wall, sweeps)
    assert (door.judged.hinge, door.judged.swing) == ("start", "right")
    assert doors_in(Piece(np.array([345.0, 350.0]), np.array([345.0, 50.0]), 10.0), sweeps) == ()


@pytest.mark.parametrize("door_px", [40.0, 200.0])
def test_a_quarter_circle_of_another_size_is_no_door(door_px: float) -> None:
    room = _room(bite=True)
    whole, sweeps = without_sweeps(room, door_px, 10.0)
    assert sweeps == []
    assert np.array_equal(whole, room)


def test_a_round_corner_is_no_door() -> None:
    """As a shower has: no leaf stands into the room."""
    room = _room(bite=False).astype(np.uint8)
    cv2.ellipse(room, (50, 350), (90, 90), 0, 270, 360, 0, -1)
    assert without_sweeps(room.astype(np.bool_), 85.0, 10.0)[1] == []


def test_two_lines_along_a_wall_are_told_from_one() -> None:
    picture = np.zeros((100, 400), np.uint8)
    cv2.line(picture, (20, 50), (380, 50), 1, 2)
    cv2.line(picture, (150, 42), (280, 42), 1, 2)
    sheet = Sheet(picture.astype(np.float32), picture.astype(np.bool_))
    strip = cut_strip(np.array([20.0, 47.0]), np.array([380.0, 47.0]), 20.0, sheet)
    ((low, high),) = doubled_stretches(strip, 60.0)
    assert (low, high) == pytest.approx((130, 260), abs=6)
    assert doubled_stretches(strip, 200.0) == []
