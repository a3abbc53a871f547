"""Walls that are found along the lines that are drawn around a named room."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from shapely.geometry import Point, Polygon

from veduta.plan.document import Text
from veduta.plan.openings.strip import Sheet
from veduta.plan.rooms.close import closed_spaces, wall_bodies
from veduta.plan.rooms.drawn_round import drawn_walls
from veduta.plan.rooms.mend import mended
from veduta.plan.rooms.paper import raster_of
from veduta.plan.walls.axes import Axis
from veduta.plan.walls.find import Found
from veduta.plan.walls.graph import wall_graph
from veduta.plan.walls.pieces import Piece
from veduta.plan.walls.solid import Thickness

THICK = 20.0
DOOR = 160.0
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


def walls_around(axes: list[Axis], sheet: Sheet, label: NDArray[np.float64] = LABEL) -> list[Axis]:
    bodies = wall_bodies(wall_graph(axes), axes)
    return drawn_walls(axes, found_of(axes, sheet), raster_of(bodies, sheet.faint), label, DOOR)


def text(words: str, x: float = 300.0, y: float = 250.0) -> Text:
    box = [(x - 30, y - 8), (x + 30, y - 8), (x + 30, y + 8), (x - 30, y + 8)]
    return Text(text=words, box_px=box, score=1.0)


BOW = [(500 + 90 * np.sin(t), 250 - 150 * np.cos(t)) for t in np.linspace(0.1, np.pi - 0.1, 25)]


@pytest.mark.parametrize("missing", [[], [(580.0, 180.0), (580.0, 320.0)], BOW])
def test_a_missing_wall_is_taken_from_its_faces(missing: list[tuple[float, float]]) -> None:
    axes, sheet = house(missing)
    whole = [*axes, *walls_around(axes, sheet)]
    spaces = closed_spaces(wall_bodies(wall_graph(whole), whole), THICK)
    rooms = [space.polygon() for space in spaces if space.polygon().contains(Point(*LABEL))]
    assert len(rooms) == 1
    centre = Polygon([(100.0, 100.0), (500.0, 100.0), *missing, OPEN, (100.0, 400.0)])
    inner = centre.buffer(-THICK / 2, join_style="mitre")
    shared = rooms[0].intersection(inner).area / rooms[0].union(inner).area
    assert shared > 0.97


def test_a_room_that_is_open_stays_so() -> None:
    axes, sheet = house([], closed=False)
    assert walls_around(axes, sheet) == []


def test_furniture_against_the_missing_wall_is_of_the_room() -> None:
    axes, sheet = house([])
    picture = sheet.faint.astype(np.uint8)
    cv2.rectangle(picture, (440, 150), (490, 260), 1, 2)
    cv2.line(picture, (440, 150), (490, 260), 1, 2)
    sheet = Sheet(picture.astype(np.float32), picture.astype(np.bool_))
    walls = walls_around(axes, sheet)
    assert len(walls) == 1
    ends = np.array([walls[0].line.start, walls[0].line.end])
    assert np.abs(ends[:, 0] - 500.0).max() < 3.0


def test_a_name_outdoors_has_no_walls() -> None:
    axes, sheet = house([])
    assert walls_around(axes, sheet, np.array([650.0, 480.0])) == []


def test_a_named_room_is_closed_and_that_is_said() -> None:
    axes, sheet = house(BOW)
    whole = mended(axes, found_of(axes, sheet), sheet, [text("Kitchen")])
    more = whole.axes[len(axes) :]
    assert [one.origin for one in more] == ["inferred"] * len(more)
    assert len(more) > 0
    assert any("closed along the lines" in note for note in whole.notes)


@pytest.mark.parametrize(
    ("texts", "by_lines"),
    [
        ([text("Kitchen")], False),
        ([text("Balcony"), text("5.2 m²", y=268.0)], True),
        ([], True),
    ],
)
def test_what_is_no_room_stays_open(texts: list[Text], by_lines: bool) -> None:
    """Of known walls all are known; a size below the name of a balcony is the balcony's."""
    axes, sheet = house(BOW)
    whole = mended(axes, found_of(axes, sheet), sheet, texts, by_lines=by_lines)
    assert whole.axes == axes


def test_a_railing_is_no_wall() -> None:
    axes, _ = house([])
    picture = np.zeros((520, 720), np.uint8)
    cv2.line(picture, (500, 90), (500, 410), 1, 2)
    assert walls_around(axes, Sheet(picture.astype(np.float32), picture.astype(np.bool_))) == []


def test_a_sheet_may_be_cropped_at_its_walls() -> None:
    axes, sheet = house([])
    moved = [Axis(Piece(axis.line.start - 98.0, axis.line.end - 98.0, THICK), ()) for axis in axes]
    cut = Sheet(sheet.ink[98:, 98:], sheet.faint[98:, 98:])
    assert len(walls_around(moved, cut, LABEL - 98.0)) == 1
