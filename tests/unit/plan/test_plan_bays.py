"""Bays of windows before a broken wall: drawn ones against what was drawn."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from shapely.geometry import Polygon

from veduta.plan.drawn import Drawn
from veduta.plan.reading import read_storey

Image = NDArray[np.uint8]
BLACK, WHITE = (0, 0, 0), (255, 255, 255)
HALF = 8
DEPTH = 110


def house(inset: int, drawn: bool = True) -> tuple[Image, Polygon]:
    """A room with a bay below, and the bay's corners on the walls' centre lines.

    The outer walls' centre lines go from (108, 108) to (1092, 592); the bay begins at x = 400 and
    x = 800 and lies 110 px before the wall. Each of its sides is a window but for its ends.
    """
    image = np.full((800, 1200, 3), 255, np.uint8)
    cv2.rectangle(image, (100, 100), (1099, 599), BLACK, -1)
    cv2.rectangle(image, (116, 116), (1083, 583), WHITE, -1)
    cv2.rectangle(image, (596, 116), (603, 300), BLACK, -1)
    cv2.rectangle(image, (400, 584), (799, 599), WHITE, -1)
    corners = [(400, 592), (400 + inset, 592 + DEPTH), (800 - inset, 592 + DEPTH), (800, 592)]
    if drawn:
        for first, second in zip(corners, corners[1:], strict=False):
            _side(image, np.array(first, float), np.array(second, float))
    for left in (140, 700, 900):  # furniture: thin lines
        cv2.rectangle(image, (left, 200), (left + 80, 260), BLACK, 2)
    return image, Polygon(corners)


def _side(image: Image, first: NDArray[np.float64], second: NDArray[np.float64]) -> None:
    """Wall at both ends, and between these a window: lines on the faces and in the middle."""
    way = (second - first) / np.hypot(*(second - first))
    right = np.array([-way[1], way[0]])
    size = float(np.hypot(*(second - first)))

    def across(low: float, high: float) -> NDArray[np.int32]:
        ends = [(low, -HALF), (high, -HALF), (high, HALF), (low, HALF)]
        return np.round([first + a * way + b * right for a, b in ends]).astype(np.int32)

    for low, high in ((-HALF / 2, 16.0), (size - 16.0, size + HALF / 2)):
        cv2.fillPoly(image, [across(low, high)], BLACK)
    cv2.polylines(image, [across(16.0, size - 16.0)], True, BLACK, 2, cv2.LINE_AA)
    middle = np.round([first + 16 * way, second - 16 * way]).astype(np.int32)
    cv2.line(image, middle[0].tolist(), middle[1].tolist(), BLACK, 2, cv2.LINE_AA)


def _finer(drawn: Drawn) -> float:
    return float(np.sqrt(abs(np.linalg.det(drawn.cleaned.clean_from_scan[:2, :2]))))


@pytest.mark.parametrize("inset", [40, 64])
def test_a_bay_is_a_part_of_its_room(inset: int) -> None:
    image, bay = house(inset)
    drawn = read_storey(image, [])
    (room,) = drawn.rooms
    within = bay.buffer(-HALF, join_style="mitre").area + (400 - 2 * HALF) * 2 * HALF
    free = (1083 - 116 + 1) * (583 - 116 + 1) - 8 * 185 + within
    assert Polygon(room.outline_px).area / _finer(drawn) ** 2 == pytest.approx(free, rel=0.01)
    windows = [one for one in drawn.openings if one.kind == "window"]
    assert len(windows) == 3
    side = float(np.hypot(inset, DEPTH))
    want = sorted([side - 32, side - 32, 400 - 2 * inset - 32])
    found = sorted(one.width_px / _finer(drawn) for one in windows)
    assert found == pytest.approx(want, abs=10)


def test_a_broken_wall_without_a_bay_has_none() -> None:
    drawn = read_storey(house(64, drawn=False)[0], [])
    low = max(y for one in drawn.junctions for y in [one.at_px[1]]) / _finer(drawn)
    assert low < 600


def test_a_small_bay_of_thick_walls_is_part_of_its_room() -> None:
    """Its slanted sides are hardly longer than thick."""
    corners = [(400, 582), (452, 659), (548, 659), (600, 582), (1082, 582), (1082, 118), (118, 118)]
    around = Polygon([(118, 582), *corners]).exterior.buffer(20.0, join_style="mitre")
    image = np.full((800, 1200, 3), 255, np.uint8)
    cv2.fillPoly(image, [np.round(around.exterior.coords).astype(np.int32)], BLACK)
    cv2.fillPoly(image, [np.round(around.interiors[0].coords).astype(np.int32)], WHITE)
    for left in (160, 700, 900):  # furniture: thin lines
        cv2.rectangle(image, (left, 200), (left + 80, 260), BLACK, 2)
    drawn = read_storey(image)
    inside = Polygon(np.array(around.interiors[0].coords) * _finer(drawn))
    (room,) = drawn.rooms
    shape = Polygon(room.outline_px)
    assert shape.symmetric_difference(inside).area < 0.02 * inside.area
