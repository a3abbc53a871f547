"""Walls around a plot are a fence; what is outlined thin beside thick party walls is a room."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from shapely.geometry import Point

from veduta.plan.document import Text
from veduta.plan.drawn import Drawn
from veduta.plan.reading import PLOT_NOTE, read_storey

Pixels = NDArray[np.uint8]


def _house(page: Pixels, left: int, upper: int) -> None:
    """Two rooms of 300 x 300 px with a door between, a door out and two windows."""
    right, lower, middle = left + 620, upper + 320, left + 310
    cv2.rectangle(page, (left, upper), (right, lower), (0, 0, 0), 14)
    cv2.line(page, (middle, upper), (middle, lower), (0, 0, 0), 10)
    white = (255, 255, 255)
    cv2.rectangle(page, (middle - 6, upper + 120), (middle + 6, upper + 190), white, -1)
    cv2.ellipse(page, (middle, upper + 120), (70, 70), 0, 0, 90, (0, 0, 0), 2)
    cv2.line(page, (middle, upper + 120), (middle + 70, upper + 120), (0, 0, 0), 2)
    cv2.rectangle(page, (left + 60, lower - 8), (left + 140, lower + 8), white, -1)
    cv2.ellipse(page, (left + 60, lower), (80, 80), 0, 270, 360, (0, 0, 0), 2)
    cv2.line(page, (left + 60, lower), (left + 60, lower - 80), (0, 0, 0), 2)
    for start in (left + 80, middle + 90):
        cv2.rectangle(page, (start, upper - 8), (start + 110, upper + 8), white, -1)
        for y in (upper - 6, upper, upper + 6):
            cv2.line(page, (start, y), (start + 110, y), (0, 0, 0), 2)


def written(text: str, x: float, y: float) -> Text:
    box = [(x - 50, y - 10), (x + 50, y - 10), (x + 50, y + 10), (x - 50, y + 10)]
    return Text(text=text, box_px=[(float(a), float(b)) for a, b in box], score=0.99)


def _sized(drawn: Drawn) -> list[float]:
    return sorted(room.area_px2 for room in drawn.rooms)


def test_a_ring_of_walls_around_the_house_is_no_room() -> None:
    page = np.full((800, 1100, 3), 255, np.uint8)
    _house(page, 240, 240)
    alone = read_storey(page)
    cv2.rectangle(page, (60, 60), (1040, 740), (0, 0, 0), 10)
    cv2.rectangle(page, (1030, 500), (1050, 650), (255, 255, 255), -1)  # the gate
    walled = read_storey(page)
    assert PLOT_NOTE in walled.notes
    assert len(walled.rooms) == len(alone.rooms) == 2
    assert _sized(walled) == pytest.approx(_sized(alone), rel=0.02)
    kinds = [sorted(one.kind for one in drawn.openings) for drawn in (walled, alone)]
    assert kinds[0] == kinds[1]


def test_a_car_beside_the_fence_is_no_part_of_house_or_fence() -> None:
    page = np.full((800, 1100, 3), 255, np.uint8)
    _house(page, 240, 240)
    alone = read_storey(page)
    cv2.rectangle(page, (60, 60), (1040, 740), (0, 0, 0), 10)
    cv2.rectangle(page, (1030, 500), (1050, 650), (255, 255, 255), -1)
    for y in (300, 380):  # its two panes, dark
        cv2.rectangle(page, (90, y), (165, y + 12), (0, 0, 0), -1)
    walled = read_storey(page)
    assert PLOT_NOTE in walled.notes
    assert _sized(walled) == pytest.approx(_sized(alone), rel=0.02)


def test_a_house_that_is_drawn_otherwise_than_the_ring_around_it_is_found_within() -> None:
    """A hatched house in a ring of solid grey: by the ring alone the plot would be one room."""
    solid = np.full((900, 1200, 3), 255, np.uint8)
    _house(solid, 300, 280)
    dark = (solid[..., 0] < 128).astype(np.uint8)
    walls = cv2.morphologyEx(dark, cv2.MORPH_OPEN, np.ones((6, 6), np.uint8))
    rim = cv2.dilate(walls, np.ones((3, 3), np.uint8)) - cv2.erode(walls, np.ones((3, 3), np.uint8))
    stripes = np.add.outer(np.arange(900), np.arange(1200)) % 9 < 2
    page = np.full_like(solid, 255)
    page[(rim > 0) | ((walls > 0) & stripes) | ((dark > 0) & (walls == 0))] = 0
    cv2.rectangle(page, (60, 60), (1140, 840), (150, 150, 150), 20)
    names = {"Zimmer": (440, 380), "Flur": (440, 480), "Bad": (780, 380), "Abst.": (780, 480)}
    drawn = read_storey(page, [written(name, *at) for name, at in names.items()])
    assert PLOT_NOTE in drawn.notes
    assert _sized(drawn) == pytest.approx([300.0 * 306.0] * 2, rel=0.1)


def test_a_room_that_is_outlined_by_a_thin_line_is_closed_by_it() -> None:
    """Three sides are a line of 2 px, the fourth is a wall: its room is known by its name."""
    page = np.full((1000, 1000, 3), 255, np.uint8)
    _house(page, 150, 500)
    cv2.line(page, (160, 500), (160, 200), (0, 0, 0), 2)
    cv2.line(page, (160, 200), (600, 200), (0, 0, 0), 2)
    cv2.line(page, (600, 200), (600, 500), (0, 0, 0), 2)
    texts = [written("Wohnen", 350, 340), written("Zimmer", 280, 700), written("Bad", 600, 650)]
    drawn = read_storey(page, texts)
    to_clean = drawn.cleaned.clean_from_scan
    place = Point(*(to_clean[:2, :2] @ (350, 340) + to_clean[:2, 2]))
    (room,) = [one for one in drawn.rooms if one.polygon().contains(place)]
    size = abs(float(np.linalg.det(to_clean[:2, :2])))
    assert room.area_px2 / size == pytest.approx(438 * 292, rel=0.05)
    origins = {wall.id: wall.origin for wall in drawn.walls}
    assert "inferred" in {origins[name] for name in room.walls}


def test_a_room_behind_panes_that_slide_past_each_other_is_closed_by_them() -> None:
    """Two hair lines, a little over half of the side each, with a slit between where they pass."""
    page = np.full((1000, 1000, 3), 255, np.uint8)
    _house(page, 150, 500)
    for x in (157, 613):  # walls up to the panes, with a stub beyond the corner
        cv2.line(page, (x, 500), (x, 200), (0, 0, 0), 14)
    for start, end in (((150, 200), (190, 200)), ((580, 200), (620, 200))):
        cv2.line(page, start, end, (0, 0, 0), 14)
    cv2.line(page, (190, 202), (400, 202), (0, 0, 0), 2)
    cv2.line(page, (370, 197), (580, 197), (0, 0, 0), 2)
    texts = [written("Wohnen", 380, 350), written("Zimmer", 280, 700), written("Bad", 600, 650)]
    drawn = read_storey(page, texts)
    to_clean = drawn.cleaned.clean_from_scan
    place = Point(*(to_clean[:2, :2] @ (380, 350) + to_clean[:2, 2]))
    (room,) = [one for one in drawn.rooms if one.polygon().contains(place)]
    size = abs(float(np.linalg.det(to_clean[:2, :2])))
    assert room.area_px2 / size == pytest.approx(442 * 293, rel=0.05)
