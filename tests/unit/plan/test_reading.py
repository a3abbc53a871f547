"""Reading against what was drawn: small plans with known walls, doors and windows."""

from __future__ import annotations

from dataclasses import replace

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

from veduta.plan.compose import compose_storey
from veduta.plan.document import Scale
from veduta.plan.drawn import Drawn
from veduta.plan.openings.classify import Judged
from veduta.plan.openings.gaps import Gap
from veduta.plan.reading import read_storey, sized_by_doors
from veduta.plan.rooms import mend
from veduta.plan.walls.find import Found
from veduta.plan.walls.pieces import Piece
from veduta.plan.walls.solid import Thickness
from veduta.run.errors import NotFoundError

Image = NDArray[np.uint8]


def two_rooms(paper: tuple[int, int, int] = (255, 255, 255), wall: int = 0) -> Image:
    """Walls of 24 and 12 px around 1000 x 600; a door in the middle wall, a window above.

    Outer faces from (200, 200) to (1200, 800); the middle wall's axis is x = 700; its door spans
    y = 420 to 500, hangs at the upper end and opens to the right; the window spans x = 350 to 500.
    """
    image = np.full((1000, 1400, 3), paper, np.uint8)
    ink = (wall, wall, wall)
    cv2.rectangle(image, (200, 200), (1199, 799), ink, -1)
    cv2.rectangle(image, (224, 224), (1175, 775), paper, -1)
    cv2.rectangle(image, (694, 224), (705, 775), ink, -1)
    cv2.rectangle(image, (694, 420), (705, 499), paper, -1)
    cv2.line(image, (706, 420), (786, 420), ink, 2, cv2.LINE_AA)
    cv2.ellipse(image, (706, 420), (80, 80), 0, 0, 90, ink, 2, cv2.LINE_AA)
    cv2.rectangle(image, (350, 200), (499, 223), paper, -1)
    for y in (201, 212, 222):
        cv2.line(image, (350, y), (499, y), ink, 2)
    return image


@pytest.fixture(scope="module")
def drawn() -> Drawn:
    return read_storey(two_rooms())


def test_walls_lie_where_they_were_drawn(drawn: Drawn) -> None:
    upright = [wall for wall in drawn.walls if abs(_run(drawn, wall.id)[0]) < 1]
    middle = [wall for wall in upright if abs(drawn.wall_ends(wall)[0][0] - 700) < 1]
    assert len(middle) == 1
    assert middle[0].thickness_px == pytest.approx(12, abs=0.7)
    assert not middle[0].outer
    assert sum(wall.outer for wall in drawn.walls) == 6  # above and below are parted in two
    thickness = [wall.thickness_px for wall in drawn.walls if wall.outer]
    assert thickness == pytest.approx([24] * 6, abs=0.7)


def test_junctions_are_typed(drawn: Drawn) -> None:
    kinds = sorted(one.type for one in drawn.junctions)
    assert kinds == ["L", "L", "L", "L", "T", "T"]


def test_a_door_has_its_hinge_and_its_side(drawn: Drawn) -> None:
    (door,) = [one for one in drawn.openings if one.kind == "door"]
    wall = next(one for one in drawn.walls if one.id == door.wall)
    start, end = drawn.wall_ends(wall)
    down = end[1] > start[1]
    along = [door.along_px, door.along_px + door.width_px]
    low, high = sorted(start[1] + value * (1 if down else -1) for value in along)
    assert (low, high) == pytest.approx((420, 500), abs=2)
    assert door.type == "swing"
    assert door.hinge == ("start" if down else "end")
    # Who walks down the page has the right-hand side of the page on the left.
    assert door.swing == ("left" if down else "right")


def test_a_window_is_told_from_a_door(drawn: Drawn) -> None:
    (window,) = [one for one in drawn.openings if one.kind == "window"]
    assert window.width_px == pytest.approx(150, abs=3)
    assert window.type == "triple-line"  # one line between those on the faces


def test_rooms_are_the_free_floor(drawn: Drawn) -> None:
    areas = sorted(room.area_px2 for room in drawn.rooms)
    assert areas == pytest.approx([470 * 552, 470 * 552], rel=0.01)
    for room in drawn.rooms:
        x, y = room.outline_px.T
        seen = np.dot(x, np.roll(-y, -1)) - np.dot(-y, np.roll(x, -1))
        assert seen > 0  # counter-clockwise as one sees it


def test_yellowed_uneven_paper_reads_the_same(drawn: Drawn) -> None:
    image = two_rooms((244, 226, 178), 40).astype(float)
    image *= np.linspace(0.6, 1.0, image.shape[1])[None, :, None]
    read = read_storey(np.round(image).astype(np.uint8))
    assert len(read.rooms) == 2
    assert len(read.walls) == len(drawn.walls)
    assert sorted(one.kind for one in read.openings) == ["door", "window"]


@pytest.mark.parametrize("degrees", [-4.0, 2.5])
def test_a_skewed_scan_is_laid_straight(degrees: float) -> None:
    turn = cv2.getRotationMatrix2D((700, 500), degrees, 1.0)
    image = cv2.warpAffine(two_rooms(), turn, (1400, 1000), borderValue=(255, 255, 255))
    read = read_storey(np.asarray(image, np.uint8))
    # OpenCV turns counter-clockwise by positive angles; it has to be turned back.
    assert np.degrees(read.cleaned.rotation_rad) == pytest.approx(-degrees, abs=0.1)
    assert len(read.rooms) == 2
    # A corner of the house is found where the matrices say.
    corner = turn @ np.array([212.0, 212.0, 1.0])
    clean = read.cleaned.clean_from_scan @ np.array([*corner, 1.0])
    nearest = min(np.hypot(*(np.array(one.at_px) - clean[:2])) for one in read.junctions)
    assert nearest < 2.5


def test_hollow_walls_are_filled() -> None:
    image = np.full((1000, 1400, 3), 255, np.uint8)
    for low, high in (
        ((200, 200), (1200, 800)),
        ((224, 224), (690, 776)),
        ((710, 224), (1176, 776)),
    ):
        cv2.rectangle(image, low, high, (0, 0, 0), 3)
    read = read_storey(image)
    assert len(read.rooms) == 2
    assert all(wall.drawing == "hollow" for wall in read.walls)


def test_light_lines_on_black_read_the_same(drawn: Drawn) -> None:
    read = read_storey(255 - two_rooms())
    assert len(read.rooms) == 2
    assert len(read.walls) == len(drawn.walls)
    assert any("inverted" in note for note in read.notes)


def test_a_blank_sheet_is_no_plan() -> None:
    with pytest.raises(NotFoundError, match="blank"):
        read_storey(np.full((600, 800, 3), 250, np.uint8))


def test_thirty_pixels_are_too_few() -> None:
    with pytest.raises(NotFoundError, match="30 x 400 px"):
        read_storey(np.zeros((400, 30, 3), np.uint8))


def test_a_very_wide_sheet_is_reduced() -> None:
    wide = np.full((300, 20_000, 3), 255, np.uint8)
    cv2.rectangle(wide, (100, 30), (19_900, 270), (0, 0, 0), 24)
    assert max(read_storey(wide).size_px) <= 2600


def test_metres_keep_what_was_drawn(drawn: Drawn) -> None:
    scale = Scale(metres_per_px=0.01, sigma=0.01, basis="given")
    storey = compose_storey(drawn, scale, file="plan.png", sha256="0")
    assert sum(room.area_m2 for room in storey.rooms) == pytest.approx(2 * 4.7 * 5.52, rel=0.01)
    assert min(one.at_m[0] for one in storey.junctions) == 0
    assert min(one.at_m[1] for one in storey.junctions) == 0
    x, y = np.array(storey.rooms[0].outline_m).T
    assert np.dot(x, np.roll(y, -1)) > np.dot(y, np.roll(x, -1))  # counter-clockwise, y up


def _run(drawn: Drawn, name: str) -> NDArray[np.float64]:
    wall = next(one for one in drawn.walls if one.id == name)
    start, end = drawn.wall_ends(wall)
    return np.asarray(end - start)


def test_a_drawing_of_which_all_is_taken_for_walls_is_not_mended(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(mend, "MOST_WALLS", 3)
    notes = " ".join(read_storey(two_rooms()).notes)
    assert "pieces of wall were found" in notes
    assert "a cleaner or a sharper scan" in notes


def _door(width: float, score: float) -> Judged:
    gap = Gap(0, True, 1, False, np.zeros(2), np.array([width, 0.0]), 5.0, np.array([width, 0.0]))
    return Judged(gap, "door", "swing", "start", "left", score)


def test_one_sure_door_sizes_walls_that_are_lines_and_more_doors_say_it_better() -> None:
    wall = Piece(np.zeros(2), np.array([500.0, 0.0]), 5.0, "single-line")
    found = Found([wall], np.ones((2, 2), np.bool_), Thickness(4.0, 5.0), 5.0)
    assert sized_by_doors(found, [_door(160.0, 0.7)], 5.0) is found
    sized = sized_by_doors(found, [_door(160.0, 0.9)], 5.0)
    assert sized.sized
    assert sized.thin_px == pytest.approx(20.0)
    assert sized_by_doors(sized, [_door(160.0, 0.9)], 5.0) is sized
    again = sized_by_doors(sized, [_door(160.0, 0.9), _door(88.0, 0.7), _door(80.0, 0.7)], 5.0)
    assert again.thin_px == pytest.approx(11.0)
    filled = replace(found, pieces=[replace(wall, drawing="filled")])
    assert sized_by_doors(filled, [_door(160.0, 0.9)], 5.0) is filled
