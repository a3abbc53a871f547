"""Sheets of rooms in flat colours, whose walls are what is left light between them."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.plan.clean.coloured import on_white, with_black_walls
from veduta.plan.clean.sheet import clean_sheet
from veduta.synthetic.plans.foreign.coloured import coloured_page

ROOMS = (
    ((120, 120, 470, 370), (198, 222, 170)),
    ((490, 120, 880, 370), (236, 206, 120)),
    ((120, 390, 470, 680), (150, 194, 226)),
    ((490, 390, 880, 680), (150, 194, 226)),
)


def sheet(paper: int = 225, *, walls: int = 255) -> NDArray[np.uint8]:
    """Four rooms, walls of 20 px between them and of 30 px around, a table, a window and a door."""
    drawn = np.full((800, 1000, 3), paper, np.uint8)
    drawn[90:710, 90:910] = walls
    for (left, top, right, bottom), colour in ROOMS:
        drawn[top:bottom, left:right] = colour
    drawn[200:260, 469:491] = ROOMS[0][1]  # a door in the wall between both upper rooms
    drawn[92:118, 600:700] = (168, 206, 234)
    cv2.rectangle(drawn, (600, 480), (700, 560), (250, 250, 250), cv2.FILLED)
    cv2.rectangle(drawn, (600, 480), (700, 560), (140, 140, 140), 2)
    cv2.putText(drawn, "Bath", (200, 560), cv2.FONT_HERSHEY_SIMPLEX, 1.0, (60, 60, 66), 2)
    return drawn


def test_light_bands_between_colours_are_drawn_as_walls() -> None:
    drawn = with_black_walls(sheet())
    assert drawn is not None
    dark = drawn[..., 0] < 60
    assert dark[100, 150:550].all()  # the wall outdoors,
    assert dark[300:640, 480].all()  # one indoors,
    assert dark[380, 130:870].all()
    assert not dark[205:255, 480].any()  # its door,
    assert not dark[105, 610:690].any()  # a window, with a line at either face,
    assert dark[86:95, 650].any()
    assert dark[115:124, 650].any()
    assert not dark[500:540, 620:680].any()  # a table that is as light as they are,
    assert not dark[20, 20]  # and the page.
    assert drawn[540:560, 200:260].min() < 120  # What is written stays.


def test_rooms_with_walls_in_ink_are_left_as_they_are() -> None:
    assert with_black_walls(sheet(255, walls=40)) is None
    lined = np.full((800, 1000, 3), 255, np.uint8)
    for (left, top, right, bottom), colour in ROOMS:
        cv2.rectangle(lined, (left - 10, top - 10), (right + 9, bottom + 9), colour, cv2.FILLED)
        cv2.rectangle(lined, (left - 10, top - 10), (right + 9, bottom + 9), (30, 30, 30), 3)
    assert with_black_walls(lined) is None
    assert with_black_walls(np.full((800, 1000, 3), 255, np.uint8)) is None


def test_words_on_colours_stand_on_white() -> None:
    seen = on_white(sheet())
    assert (seen[600, 150:450] > 250).all()
    assert seen[540:560, 200:260].min() < 120
    plain = np.full((800, 1000, 3), 255, np.uint8)
    assert on_white(plain) is plain


def test_a_page_of_a_flat_finder_has_ink_where_its_walls_are() -> None:
    picture, (truth,) = coloured_page(3)
    cleaned = clean_sheet(picture)
    assert any("flat colours" in note for note in cleaned.notes)
    ink = []
    for wall in truth.storey.walls:
        middle = np.append((np.array(wall.start_m) + np.array(wall.end_m)) / 2.0, 1.0)
        at = cleaned.clean_from_scan @ np.append((truth.px_from_m @ middle)[:2], 1.0)
        ink.append(cleaned.ink[round(at[1]), round(at[0])] > 0.5)
    # The middles of some have a door or a window.
    assert np.mean(ink) > 0.5
