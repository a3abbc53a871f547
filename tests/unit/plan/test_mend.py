"""Broken walls are closed where something speaks for it: drawn plans with known rooms."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from shapely.geometry import Point, Polygon

from veduta.plan.document import Text
from veduta.plan.drawn import Drawn
from veduta.plan.openings.gaps import Gap, parted
from veduta.plan.reading import read_storey
from veduta.plan.rooms import looker, mend
from veduta.plan.rooms.labels import room_labels

Image = NDArray[np.uint8]
BLACK, WHITE = (0, 0, 0), (255, 255, 255)


def house() -> Image:
    """Outer faces from (100, 100) to (700, 500), 16 px; an inner wall of 8 px at x = 396 to 404.

    The inner wall begins at the upper wall and ends at y = 400, 84 px before the lower wall's face.
    """
    image = np.full((600, 800, 3), 255, np.uint8)
    cv2.rectangle(image, (100, 100), (699, 499), BLACK, -1)
    cv2.rectangle(image, (116, 116), (683, 483), WHITE, -1)
    cv2.rectangle(image, (396, 116), (403, 399), BLACK, -1)
    for left in (140, 520, 600):  # furniture: thin lines
        cv2.rectangle(image, (left, 130), (left + 50, 190), BLACK, 2)
    return image


def corner_door() -> Image:
    """As `house`, but the inner wall turns left at y = 392: the door stands beside a corner.

    The door spans y = 400 to 484 at x = 396 to 404, hangs below and opens to the right.
    """
    image = house()
    cv2.rectangle(image, (116, 392), (403, 399), BLACK, -1)
    cv2.line(image, (404, 482), (488, 482), BLACK, 2, cv2.LINE_AA)
    cv2.ellipse(image, (404, 484), (84, 84), 0, 270, 360, BLACK, 2, cv2.LINE_AA)
    return image


def text(words: str, x: float, y: float) -> Text:
    box = [(x - 40, y - 8), (x + 40, y - 8), (x + 40, y + 8), (x - 40, y + 8)]
    return Text(text=words, box_px=box, score=1.0)


def finer(drawn: Drawn) -> float:
    """Small sheets are enlarged to be read."""
    return float(np.sqrt(abs(np.linalg.det(drawn.cleaned.clean_from_scan[:2, :2]))))


def areas(drawn: Drawn) -> list[float]:
    return sorted(room.area_px2 / finer(drawn) ** 2 for room in drawn.rooms)


@pytest.fixture(scope="module")
def drawn() -> Drawn:
    return read_storey(corner_door(), [])


def test_a_door_beside_a_corner_closes_the_room(drawn: Drawn) -> None:
    # 280 x 276, the strip under it 280 x 84, and the room to the right 280 x 368.
    assert areas(drawn) == pytest.approx([280 * 84, 280 * 276, 280 * 368], rel=0.03)
    door = next(one for one in drawn.openings if one.kind == "door")
    assert door.width_px / finer(drawn) == pytest.approx(84, abs=4)
    assert door.origin == "measured"
    assert not any(room.mended for room in drawn.rooms)
    assert any("a door is drawn there" in note for note in drawn.notes)


def without_arc() -> Image:
    """As `corner_door`, and nothing is drawn in the way through."""
    image = house()
    cv2.rectangle(image, (116, 392), (403, 399), BLACK, -1)
    return image


def test_noise_is_not_looked_at_for_ever(monkeypatch: pytest.MonkeyPatch) -> None:
    """The bound counts breaks of all rounds: beyond it nothing more is closed."""
    whole = read_storey(corner_door())
    monkeypatch.setattr(mend, "MOST_LOOKED_AT", -1)
    assert len(read_storey(corner_door()).rooms) < len(whole.rooms)


def test_a_way_without_a_drawing_stays_open_in_one_room() -> None:
    drawn = read_storey(without_arc(), [text("Bedroom", 250, 250)])
    assert len(drawn.rooms) == 2
    assert not drawn.notes


def test_a_way_to_a_stub_is_one_between_ends() -> None:
    image = house()
    cv2.rectangle(image, (396, 476), (403, 483), BLACK, -1)
    assert areas(read_storey(image, [])) == pytest.approx([280 * 368, 280 * 368], rel=0.03)


def corridor() -> Image:
    """As `house`, with a corridor of 70 px across it, and the inner wall above and below it."""
    image = house()
    for top in (257, 335):
        cv2.rectangle(image, (116, top), (683, top + 7), BLACK, -1)
    cv2.rectangle(image, (396, 265), (403, 334), WHITE, -1)
    cv2.rectangle(image, (396, 343), (403, 483), BLACK, -1)
    return image


def test_a_corridor_is_one_room_where_walls_meet_it_from_both_sides(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    assert len(read_storey(corridor(), []).rooms) == 5
    monkeypatch.setattr(looker, "ROOM", 0.0)
    assert len(read_storey(corridor(), []).rooms) == 6


def test_two_names_in_one_space_close_it_and_that_is_said() -> None:
    texts = [text("Bedroom", 250, 250), text("Hall", 250, 445), text("Living room", 550, 250)]
    drawn = read_storey(without_arc(), texts)
    assert areas(drawn) == pytest.approx([280 * 84, 280 * 276, 280 * 368], rel=0.03)
    gap = next(one for one in drawn.openings if one.kind == "gap")
    assert gap.width_px / finer(drawn) == pytest.approx(84, abs=4)
    assert gap.origin == "inferred"
    wall = next(one for one in drawn.walls if one.id == gap.wall)
    assert wall.origin == "inferred"
    assert wall.score < 0.5
    shapes = {room.id: (Polygon(room.outline_px), room) for room in drawn.rooms}
    for shape, room in shapes.values():
        assert room.mended == (not shape.contains(Point(250 * finer(drawn), 250 * finer(drawn))))
        assert (gap.id in room.openings) == room.mended
    assert len(drawn.notes) == 1
    assert "two rooms are named in one space" in drawn.notes[0]


def leafless(both: bool) -> Image:
    """As `without_arc`, with lines over the way on both faces of the inner wall, or on one."""
    image = without_arc()
    for x in (396, 403) if both else (396,):
        cv2.line(image, (x, 400), (x, 484), BLACK, 1)
    return image


def test_faces_drawn_on_beside_a_corner_are_a_door() -> None:
    drawn = read_storey(leafless(True), [])
    assert areas(drawn) == pytest.approx([280 * 84, 280 * 276, 280 * 368], rel=0.03)
    (door,) = [one for one in drawn.openings if one.kind == "door"]
    assert door.width_px / finer(drawn) == pytest.approx(84, abs=4)
    assert door.origin == "measured"
    assert any("both faces are drawn on there" in note for note in drawn.notes)


def test_one_line_over_a_way_is_a_counter() -> None:
    assert len(read_storey(leafless(False), []).rooms) == 2


def test_a_room_that_is_open_to_the_outdoors_is_closed() -> None:
    image = house()
    cv2.rectangle(image, (396, 400), (403, 484), BLACK, -1)
    cv2.rectangle(image, (684, 400), (699, 483), WHITE, -1)  # beside the lower right corner
    drawn = read_storey(image, [text("Kitchen", 550, 250)])
    assert areas(drawn) == pytest.approx([280 * 368, 280 * 368], rel=0.03)


def facing() -> Image:
    """As `house`, but the inner wall is parted by 270 px: 17 times as wide as walls."""
    image = house()
    cv2.rectangle(image, (396, 116), (403, 483), BLACK, -1)
    cv2.rectangle(image, (396, 165), (403, 434), WHITE, -1)
    return image


def test_a_wide_way_between_walls_in_one_line_parts_two_names() -> None:
    assert len(read_storey(facing(), []).rooms) == 1
    texts = [text("Kitchen", 250, 250), text("Living room", 550, 250)]
    drawn = read_storey(facing(), texts)
    assert areas(drawn) == pytest.approx([280 * 368, 280 * 368], rel=0.03)


def chamfered(window: bool) -> Image:
    """One room whose lower right corner is cut off: short stubs, and lines between them or none."""
    image = np.full((600, 800, 3), 255, np.uint8)
    outer = np.array([(100, 100), (700, 100), (700, 380), (580, 500), (100, 500)])
    inner = np.array([(130, 130), (670, 130), (670, 368), (568, 470), (130, 470)])
    cv2.fillPoly(image, [outer], BLACK)
    cv2.fillPoly(image, [inner], WHITE)
    hole = np.array([(688, 347), (724, 383), (583, 524), (547, 488)])
    cv2.fillPoly(image, [hole], WHITE)
    cv2.rectangle(image, (671, 130), (699, 380), BLACK, -1)
    cv2.rectangle(image, (130, 471), (580, 499), BLACK, -1)
    cv2.rectangle(image, (300, 130), (313, 470), BLACK, -1)
    cv2.rectangle(image, (313, 290), (670, 303), BLACK, -1)
    for top in (150, 220, 320):  # furniture: thin lines
        cv2.rectangle(image, (330, top), (390, top + 50), BLACK, 2)
    if window:
        cv2.line(image, (686, 374), (574, 486), BLACK, 2, cv2.LINE_AA)
    return image


def test_a_slanted_corner_that_is_window_closes_its_room() -> None:
    drawn = read_storey(chamfered(True), [])
    assert len(drawn.rooms) == 3
    assert any("a window is drawn there" in note for note in drawn.notes)
    assert len(read_storey(chamfered(False), []).rooms) == 2


def test_openings_of_a_room_lie_on_its_outline(drawn: Drawn) -> None:
    walls = {wall.id: wall for wall in drawn.walls}
    for room in drawn.rooms:
        shape = Polygon(room.outline_px)
        for one in drawn.openings:
            start, end = drawn.wall_ends(walls[one.wall])
            way = (end - start) / np.hypot(*(end - start))
            middle = Point(*(start + (one.along_px + one.width_px / 2) * way))
            touches = shape.distance(middle) <= walls[one.wall].thickness_px / 2 + 2
            assert (one.id in room.openings) == touches


def test_a_gap_is_parted_at_its_pillars() -> None:
    solid = np.zeros((20, 100), np.bool_)
    solid[5:15, 0:10] = solid[5:15, 40:52] = solid[5:15, 90:100] = True
    solid[5:15, 70:72] = True  # a flaw of two pixels parts nothing
    ends = np.array([0.0, 10.0]), np.array([100.0, 10.0])
    gap = Gap(0, True, 1, False, *ends, 10.0, ends[1])
    found = [(one.start[0], one.end[0]) for one in parted(gap, solid)]
    assert found == [(10.0, 40.0), (52.0, 90.0)]


def test_lines_over_each_other_are_one_label_and_other_words_none() -> None:
    texts = [
        text("Bedroom", 100, 100),
        text("3.72 x 3.00", 100, 118),
        text("Kitchen", 300, 100),
        text("www.example.org", 200, 300),
    ]
    found = sorted(tuple(np.round(one)) for one in room_labels(texts))
    assert found == [(100.0, 109.0), (300.0, 100.0)]
