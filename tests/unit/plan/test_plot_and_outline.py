"""Walls around a plot are a fence; what is outlined thin beside thick party walls is a room."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from shapely.geometry import Point, Polygon

from veduta.plan.document import Text
from veduta.plan.drawn import Drawn
from veduta.plan.reading import read_storey
from veduta.plan.remarks import PLOT_NOTE
from veduta.plan.walls.fence import fence_pieces
from veduta.plan.walls.pieces import Piece
from veduta.synthetic.plans.brochure import brochure_page

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
    """Two broad strokes nearer to the fence than to the house, which stands free for all that."""
    house = [
        ((300, 300), (700, 300)), ((700, 300), (700, 600)), ((300, 600), (450, 600)),
        ((550, 600), (700, 600)), ((300, 300), (300, 600)), ((500, 300), (500, 600)),
    ]  # fmt: skip
    ring = [
        ((60, 60), (940, 60)), ((940, 60), (940, 840)), ((60, 840), (400, 840)),
        ((600, 840), (940, 840)), ((60, 60), (60, 840)),
    ]  # fmt: skip
    car = [((100, 400), (180, 400)), ((100, 480), (180, 480))]
    pieces = [
        Piece(np.array(a, float), np.array(b, float), thick)
        for some, thick in ((house, 14.0), (ring, 12.0), (car, 20.0))
        for a, b in some
    ]
    assert fence_pieces(pieces, 12.0) == {6, 7, 8, 9, 10}
    assert fence_pieces(pieces[:6] + pieces[11:], 12.0) == set()


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
    """The kitchen of a terraced house: its back is two hair lines with a slit where they pass."""
    page, (truth, _) = brochure_page(41_002)
    (kitchen,) = [one for one in truth.storey.rooms if one.use == "kitchen"]
    names = {"kitchen": "Kitchen", "living": "Lounge", "dining": "Dining Room", "hall": "Hall"}
    to_px = truth.px_from_m
    ends = np.array([one.start_m for one in truth.storey.walls]) @ to_px[:2, :2].T + to_px[:2, 2]
    low, high = (ends.min(axis=0) - 40).astype(int), (ends.max(axis=0) + 40).astype(int)
    middles = {one.use: Polygon(one.outline_m).centroid for one in truth.storey.rooms}
    texts = [
        written(names[use], *(to_px[:2] @ (at.x, at.y, 1.0) - low)) for use, at in middles.items()
    ]
    drawn = read_storey(page[low[1] : high[1], low[0] : high[0]], texts)
    to_clean = drawn.cleaned.clean_from_scan
    x, y = to_px[:2] @ (middles["kitchen"].x, middles["kitchen"].y, 1.0) - low
    place = Point(*(to_clean[:2, :2] @ (x, y) + to_clean[:2, 2]))
    (room,) = [one for one in drawn.rooms if one.polygon().contains(place)]
    size = abs(float(np.linalg.det(to_clean[:2, :2]))) / truth.metres_per_px**2
    assert room.area_px2 / size == pytest.approx(kitchen.area_m2, rel=0.05)
