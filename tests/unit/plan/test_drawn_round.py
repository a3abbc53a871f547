"""Walls that are found along the lines that are drawn around a named room."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from shapely.geometry import Point, Polygon

from veduta.plan.openings.strip import Sheet
from veduta.plan.rooms.close import closed_spaces, wall_bodies
from veduta.plan.rooms.drawn_round import drawn_walls
from veduta.plan.walls.axes import Axis
from veduta.plan.walls.find import Found
from veduta.plan.walls.graph import wall_graph
from veduta.plan.walls.pieces import Piece
from veduta.plan.walls.solid import Thickness

THICK = 20.0
LABEL = np.array([300.0, 250.0])
OPEN = (500.0, 400.0)  # the lower right corner of a room from (100, 100)


def house(missing: list[tuple[float, float]], closed: bool = True) -> tuple[list[Axis], Sheet]:
    """Three walls of a room, and two lines as faces of a fourth through the missing points."""
    lines = [((100, 400), (100, 100)), ((100, 100), (500, 100)), ((100, 400), (500, 400))]
    axes = [Axis(Piece(np.array(a, float), np.array(b, float), THICK), ()) for a, b in lines]
    picture = np.zeros((520, 720), np.uint8)
    for a, b in lines:
        cv2.line(picture, a, b, 1, int(THICK))
    points = np.array([(500.0, 100.0), *missing, OPEN])
    for half in (-THICK / 2, THICK / 2):
        # Faces of a wall that bows out to the right, seen from above to below.
        away = points + np.array([half, 0.0])
        cv2.polylines(picture, [away.astype(np.int32)], False, 1, 2)
    if not closed:
        picture[230:270, 480:] = 0
    return axes, Sheet(picture.astype(np.float32), picture.astype(np.bool_))


def found_of(axes: list[Axis], sheet: Sheet) -> Found:
    pieces = [axis.line for axis in axes]
    return Found(pieces, sheet.faint, Thickness(0.8 * THICK, THICK), THICK)


BOW = [(500 + 90 * np.sin(t), 250 - 150 * np.cos(t)) for t in np.linspace(0.1, np.pi - 0.1, 25)]


@pytest.mark.parametrize("missing", [[], [(580.0, 180.0), (580.0, 320.0)], BOW])
def test_a_missing_wall_is_taken_from_its_faces(missing: list[tuple[float, float]]) -> None:
    axes, sheet = house(missing)
    whole = [*axes, *drawn_walls(axes, found_of(axes, sheet), sheet, LABEL)]
    spaces = closed_spaces(wall_bodies(wall_graph(whole), whole), THICK)
    rooms = [space.polygon() for space in spaces if space.polygon().contains(Point(*LABEL))]
    assert len(rooms) == 1
    centre = Polygon([(100.0, 100.0), (500.0, 100.0), *missing, OPEN, (100.0, 400.0)])
    inner = centre.buffer(-THICK / 2, join_style="mitre")
    shared = rooms[0].intersection(inner).area / rooms[0].union(inner).area
    assert shared > 0.97


def test_a_room_that_is_open_stays_so() -> None:
    axes, sheet = house([], closed=False)
    assert drawn_walls(axes, found_of(axes, sheet), sheet, LABEL) == []


def test_furniture_against_the_missing_wall_is_of_the_room() -> None:
    axes, sheet = house([])
    picture = sheet.faint.astype(np.uint8)
    cv2.rectangle(picture, (440, 150), (490, 260), 1, 2)
    cv2.line(picture, (440, 150), (490, 260), 1, 2)
    sheet = Sheet(picture.astype(np.float32), picture.astype(np.bool_))
    walls = drawn_walls(axes, found_of(axes, sheet), sheet, LABEL)
    assert len(walls) == 1
    ends = np.array([walls[0].line.start, walls[0].line.end])
    assert np.abs(ends[:, 0] - 500.0).max() < 3.0


def test_a_name_outdoors_has_no_walls() -> None:
    axes, sheet = house([])
    assert drawn_walls(axes, found_of(axes, sheet), sheet, np.array([650.0, 480.0])) == []
