"""What strangers' sheets have beside walls: letterheads, sizes of windows, bars, scribble."""

from __future__ import annotations

import cv2
import numpy as np
import pytest

from veduta.plan.clean.letterhead import without_letterhead
from veduta.plan.document import Text
from veduta.plan.drawn import Cleaned, Drawn, DrawnJunction, DrawnRoom, DrawnWall
from veduta.plan.reading import cleaned_sheet
from veduta.plan.rooms.apart import NOTE, without_apart
from veduta.plan.rooms.labels import WINDOWS_NOTE, room_labels, window_notes
from veduta.plan.scale.bars import bar_voters
from veduta.plan.walls.scribbled import scribbled_walls


def text(words: str, x: float, y: float, wide: float = 60.0, high: float = 12.0) -> Text:
    """Words about a point."""
    low, top = (x - wide / 2.0, y - high / 2.0), (x + wide / 2.0, y + high / 2.0)
    box = [low, (top[0], low[1]), top, (low[0], top[1])]
    return Text(text=words, box_px=box, score=1.0)


def squares(*corners: tuple[float, float, float, float]) -> Drawn:
    """Rooms of four walls each, that share none: left, upper, right and lower side in pixels."""
    junctions, walls, rooms = [], [], []
    for number, (left, high, right, low) in enumerate(corners):
        at = [(left, high), (left, low), (right, low), (right, high)]
        names = [f"j{number}{place}" for place in range(4)]
        junctions += [DrawnJunction(name, one, "L") for name, one in zip(names, at, strict=True)]
        own = [
            DrawnWall(f"w{number}{place}", names[place], names[(place + 1) % 4], 8.0, "filled",
                      True, 0.9)
            for place in range(4)
        ]  # fmt: skip
        walls += own
        rooms.append(DrawnRoom(f"r{number}", np.array(at), (), tuple(one.id for one in own), (),
                               False, 0.9))  # fmt: skip
    blank = np.zeros((400, 400), np.float32)
    cleaned = Cleaned(np.zeros((400, 400, 3), np.uint8), blank, np.eye(3), False, 0.0, 1.0)
    return Drawn(cleaned, tuple(junctions), tuple(walls), (), tuple(rooms))


HOUSE = (50.0, 150.0, 350.0, 350.0)
FOUR = [np.array([x, 250.0]) for x in (80.0, 150.0, 220.0, 290.0)]


@pytest.mark.parametrize("turn", range(4))
def test_a_band_along_an_edge_is_painted_as_paper_with_all_that_is_in_it(turn: int) -> None:
    sheet = np.full((400, 600, 3), 250, np.uint8)
    sheet[:70] = (196, 30, 58)
    sheet[20:50, 480:560] = (90, 120, 160)  # a picture in it
    sheet[150:300, 100:104] = 20  # a wall
    turned = np.rot90(sheet, turn)
    bare = np.rot90(without_letterhead(turned), -turn)
    assert (bare[:70] == 250).all()
    assert np.array_equal(bare[75:], sheet[75:])


def test_coloured_paper_and_walls_at_an_edge_are_no_letterhead() -> None:
    sheet = np.full((400, 600, 3), 250, np.uint8)
    sheet[40:60, 30:570] = 20  # a thick wall near the edge
    assert without_letterhead(sheet) is sheet
    blueprint = np.full((400, 600, 3), (28, 66, 128), np.uint8)
    blueprint[100:300, 100:500] = 250
    assert without_letterhead(blueprint) is blueprint


def test_outer_walls_at_which_a_picture_ends_are_no_letterhead() -> None:
    sheet = np.full((1000, 1000, 3), 250, np.uint8)
    sheet[:32] = sheet[:, :32] = 20
    sheet[400:432, 200:800] = 20
    assert without_letterhead(sheet) is sheet
    sheet[:, :32] = 250
    sheet[:432, 600:616] = 20  # a thinner wall meets the one that is left
    assert without_letterhead(sheet) is sheet
    sheet[:60, 600:616] = sheet[500:, 600:616] = 250
    sheet[:32] = 20  # met by nothing, it is the scanner's or a letterhead
    assert (without_letterhead(sheet)[:32] == 250).all()


def test_a_band_on_a_blueprint_becomes_its_paper() -> None:
    blueprint = np.full((400, 600, 3), (28, 66, 128), np.uint8)
    blueprint[200:206, 100:500] = 250
    paper = blueprint.copy()
    blueprint[:70] = (196, 30, 58)
    assert np.array_equal(without_letterhead(blueprint), paper)


def test_names_in_a_letterhead_are_no_rooms_but_its_scale_counts() -> None:
    sheet = np.full((400, 600, 3), 250, np.uint8)
    sheet[:70] = (196, 30, 58)
    sheet[150:300, 100:104] = 20
    words = [("Kitchen & Bath Ltd", 30.0), ("120 m2", 30.0), ("1:100", 30.0), ("Bath", 200.0)]
    _, texts = cleaned_sheet(sheet, [text(said, 300.0, level) for said, level in words])
    assert [one.text for one in texts] == ["1:100", "Bath"]


def test_a_frame_above_the_house_without_a_name_is_left_out() -> None:
    found = without_apart(squares(HOUSE, (250.0, 10.0, 390.0, 90.0)), FOUR)
    assert [room.id for room in found.rooms] == ["r0"]
    assert len(found.walls) == len(found.junctions) == 4
    assert NOTE in found.notes


@pytest.mark.parametrize(
    ("other", "names"),
    [
        ((250.0, 10.0, 390.0, 90.0), [*FOUR, np.array([300.0, 50.0])]),  # a shed that is named
        ((100.0, 200.0, 130.0, 230.0), FOUR),  # a column in the house
        ((250.0, 10.0, 390.0, 90.0), FOUR[:3]),  # too few names to tell which is the house
    ],
)
def test_what_may_be_of_the_house_stays(
    other: tuple[float, float, float, float], names: list[np.ndarray]
) -> None:
    drawn = squares(HOUSE, other)
    assert without_apart(drawn, names) is drawn


def test_sizes_of_windows_that_are_all_as_high_are_no_rooms() -> None:
    rooms = [text(name, 100.0 * place, 200.0)
             for place, name in enumerate(("Kitchen", "Bath", "Bedroom", "Hall"), 1)]  # fmt: skip
    windows = [text(f"{feet}'8\" x 4'6\"", 100.0 * feet, 20.0) for feet in (2, 3, 4, 5)]
    assert len(room_labels([*rooms, *windows])) == 4
    # Three may be rooms as deep as each other, and without names all sizes are those of rooms.
    assert len(room_labels([*rooms, *windows[:3]])) == 7
    assert len(room_labels(windows)) == 4
    assert window_notes([*rooms, *windows]) == [WINDOWS_NOTE.format(4)]
    # Bedrooms of a hostel are as deep as each other, too.
    bedrooms = [text("3.20 x 4.50", 100.0 * place, 20.0) for place in range(1, 6)]
    assert len(room_labels([*rooms, *bedrooms])) == 9
    assert window_notes([*rooms, *bedrooms]) == []


def test_a_bar_whose_zero_was_not_read_says_the_scale_where_it_is_drawn() -> None:
    numbers = [text("1", 150.0, 50.0, 8.0), text("5 m", 350.0 + 6.6, 50.0, 24.0)]
    ink = np.zeros((120, 500), dtype=np.bool_)
    assert bar_voters(numbers, ink) == []
    ink[64:68, 100:351] = True
    (voter,) = bar_voters(numbers, ink)
    assert np.exp(voter.hypotheses[0].log_mpp) == pytest.approx(5.0 / 251.0, rel=1e-3)
    # With a 0 that was read, too, the ends of the bar count and not the middles of numbers.
    (voter,) = bar_voters([text("0", 105.0, 50.0, 8.0), *numbers], ink)
    assert np.exp(voter.hypotheses[0].log_mpp) == pytest.approx(5.0 / 251.0, rel=1e-3)
    # A line that goes on, as a wall or the edge of the sheet, is no bar.
    ink[64:68, 20:480] = True
    assert bar_voters(numbers, ink) == []


def test_a_zigzag_between_two_faces_is_wall_and_two_faces_alone_are_not() -> None:
    ink = np.zeros((300, 500), np.uint8)
    for level in (60, 200):
        along = np.arange(40, 460, 4)
        across = np.where(np.arange(len(along)) % 2, level - 9, level + 9)
        cv2.polylines(ink, [np.stack([along, across], 1).astype(np.int32)], False, 1, 2)
        for face in (level - 10, level + 10):
            cv2.line(ink, (40, face), (460, face), 1, 2)
    found = scribbled_walls(ink > 0, 2.0)
    assert found is not None
    mask, thickness = found
    assert mask[60, 60:440].mean() > 0.95
    assert 15.0 < thickness.most_px < 50.0
    bare = np.zeros_like(ink)
    for face in (50, 70, 190, 210):
        cv2.line(bare, (40, face), (460, face), 1, 2)
    assert scribbled_walls(bare > 0, 2.0) is None
