"""Hollow, hatched, grey and single-line walls against what was drawn."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

from veduta.plan.clean.sheet import clean_sheet
from veduta.plan.walls.cells import common_values, find_cells
from veduta.plan.walls.hatching import hatch_strokes, hatched_areas
from veduta.plan.walls.outlined import wall_cells
from veduta.plan.walls.outlines import without_half_outline
from veduta.plan.walls.pieces import Piece
from veduta.plan.walls.solid import two_pens, wall_thickness
from veduta.plan.walls.tone import toned_areas
from veduta.plan.walls.ways import connected, outlined_walls, ways_drawn, ways_of_ink
from veduta.synthetic.plans.sets import sheets_of

Mask = np.ndarray
LINE = 2


def _blurred(ink: np.ndarray, sigma: float) -> NDArray[np.float32]:
    return np.asarray(cv2.GaussianBlur(ink, (0, 0), sigma), np.float32)


def _box(mask: Mask, left: int, top: int, right: int, bottom: int) -> None:
    """Lines of two pixels around a box; the second pixel is inside."""
    mask[top : top + LINE, left:right] = True
    mask[bottom - LINE : bottom, left:right] = True
    mask[top:bottom, left : left + LINE] = True
    mask[top:bottom, right - LINE : right] = True


def _house() -> tuple[Mask, Mask]:
    """Two rooms in hollow walls of 24 and 14 px with a window, a bed's head; and the insides."""
    ink = np.zeros((700, 1000), np.bool_)
    _box(ink, 50, 50, 950, 650)
    inside = np.zeros_like(ink)
    inside[52:648, 52:948] = True
    for left, right in ((74, 500), (514, 926)):
        _box(ink, left, 74, right, 626)
        inside[74:626, left:right] = False
    # Where the inner wall meets the outer ones there is no line.
    # A window of the wall's whole breadth in the upper wall, one with a middle line in the lower.
    for x in (200, 320):
        ink[50:76, x : x + LINE] = True
        ink[624:650, x : x + LINE] = True
    ink[636:638, 200:322] = True
    inside[52:74, 200:322] = inside[626:648, 200:322] = False
    # A bed with its head at the left wall.
    _box(ink, 74, 300, 90, 420)
    _box(ink, 88, 300, 250, 420)
    return ink, inside


def test_breadth_and_length_of_a_cell_are_those_of_its_rectangle() -> None:
    ink = np.zeros((300, 900), np.bool_)
    _box(ink, 40, 100, 840, 130)
    _box(ink, 838, 100, 870, 130)
    cells = find_cells(ink, LINE)
    wall = int(cells.labels[115, 400])
    end = int(cells.labels[115, 850])
    assert cells.narrow[wall]
    assert cells.breadth[wall] == pytest.approx(26, abs=1)
    assert cells.length[wall] == pytest.approx(796, rel=0.05)
    lengths = dict(cells.beside[wall])
    assert lengths[end] == pytest.approx(26, abs=4)
    outdoors = int(cells.labels[10, 10])
    assert cells.room[outdoors]
    assert lengths[outdoors] == pytest.approx(2 * 800, rel=0.05)


@pytest.mark.parametrize("breadth", range(5, 15))
def test_odd_and_even_breadths_are_whole_pixels(breadth: int) -> None:
    ink = np.zeros((200, 700), np.bool_)
    _box(ink, 40, 80, 640, 80 + breadth + 2 * LINE)
    cells = find_cells(ink, LINE)
    assert cells.breadth[cells.labels[82 + breadth // 2, 300]] == breadth


def test_walls_are_even_where_their_breadth_is_between_two_whole_numbers() -> None:
    # A wall of 8.5 px: as 8 and as 9 px, by turns, as it comes to lie on the grid.
    ink = np.zeros((200, 700), np.bool_)
    _box(ink, 40, 80, 640, 80 + 9 + 2 * LINE)
    for left in range(60, 600, 80):
        ink[91, left : left + 40] = True
    cells = find_cells(ink, LINE)
    wall = int(cells.labels[85, 300])
    assert common_values(cells.ridges[wall], 1)[1] > 0.9


def test_common_values_are_the_heights_of_two_peaks() -> None:
    rng = np.random.default_rng(3)
    values = np.concatenate(
        [rng.normal(10, 0.2, 200), rng.normal(30, 0.2, 90), rng.uniform(0, 60, 20)]
    )
    found, share = common_values(values, 2)
    assert found == pytest.approx([10, 30], abs=1)
    assert share > 290 / 310 - 0.02


def test_hollow_walls_are_filled_and_windows_and_beds_are_not() -> None:
    ink, inside = _house()
    cells = find_cells(ink, LINE)
    found = wall_cells(cells)[cells.labels]
    paper = ~ink
    assert (found & inside & paper).sum() > 0.99 * (inside & paper).sum()
    assert (found & ~inside).sum() == 0


def test_a_short_corner_between_two_windows_is_wall() -> None:
    """Panes of one line part it from all other walls; each of its arms is in line with one."""
    ink, inside = _house()
    corner = np.zeros_like(ink)
    corner[50:76, 50:102] = corner[50:102, 50:76] = True
    gap = np.zeros_like(ink)
    gap[50:76, 102:190] = gap[102:290, 50:76] = True
    ink[gap] = False
    ink[62:64, 102:190] = ink[102:290, 62:64] = True
    for end in (100, 190):
        ink[50:76, end : end + LINE] = True
    for end in (100, 290):
        ink[end : end + LINE, 50:76] = True
    cells = find_cells(ink, LINE)
    found = wall_cells(cells)[cells.labels]
    assert not (corner & inside & ~ink & ~found).any()
    assert not (found & gap).any()


def test_without_long_cells_there_are_no_hollow_walls() -> None:
    ink = np.zeros((700, 1000), np.bool_)
    _box(ink, 50, 50, 950, 650)
    _box(ink, 300, 300, 316, 420)
    cells = find_cells(ink, LINE)
    assert not wall_cells(cells).any()


def _corridor(ends_drawn: bool) -> tuple[Mask, Mask]:
    """A comb of hollow walls of 10 px: a corridor's wall and partitions between eight small rooms.

    The rooms are open downwards; without `ends_drawn` so are the insides of the partitions.
    """
    ink, inside = np.zeros((500, 3000), np.bool_), np.zeros((500, 3000), np.bool_)
    xs = [100 + 140 * index for index in range(9)]
    inside[100:110, 100 : xs[-1] + 10] = True
    for x in xs:
        inside[100:220, x : x + 10] = True
    grown = cv2.dilate(inside.astype(np.uint8), np.ones((2 * LINE + 1, 2 * LINE + 1), np.uint8))
    ink[:] = (grown > 0) & ~inside
    if not ends_drawn:
        ink[220:222, [column for x in xs for column in range(x, x + 10)]] = False
    # Far walls make the sheet large beside the rooms; the frame is what is outdoors.
    _box(ink, 2900, 20, 2902 + LINE, 480)
    return ink, inside


@pytest.mark.parametrize("ends_drawn", [True, False])
def test_walls_between_many_small_rooms_are_walls(ends_drawn: bool) -> None:
    ink, inside = _corridor(ends_drawn)
    cells = find_cells(ink, LINE, cut_px=None if ends_drawn else 25.0)
    found = wall_cells(cells)[cells.labels]
    assert (found & inside).sum() > 0.95 * inside.sum()
    assert (found & ~inside).sum() < 0.05 * inside.sum()


def test_cut_cells_are_those_of_opening_the_paper() -> None:
    ink, inside = _corridor(False)
    cells = find_cells(ink, LINE, cut_px=25.0)
    numbers = np.unique(cells.labels[inside])
    assert len(numbers) == 1
    assert numbers[0] != 0
    assert (cells.labels == numbers[0]).sum() == pytest.approx(inside.sum(), rel=0.02)


def _hatched() -> tuple[Mask, Mask]:
    ink, inside = _house()
    y, x = np.indices(ink.shape)
    return ink | (inside & ((x + y) % 12 < 2)), inside


def test_strokes_of_hatching_are_found_and_long_slanted_lines_are_not() -> None:
    ink, inside = _hatched()
    grey = ink.astype(np.uint8)
    cv2.line(grey, (560, 120), (880, 480), 1, LINE)
    strokes = hatch_strokes(grey.astype(np.bool_), LINE)
    y, x = np.indices(ink.shape)
    drawn = inside & ((x + y) % 12 < 2)
    middle = cv2.erode(inside.astype(np.uint8), np.ones((9, 9), np.uint8)) > 0
    assert (strokes & drawn & middle).sum() > 0.9 * (drawn & middle).sum()
    assert strokes[110:490, 550:890].sum() == 0


def test_few_strokes_are_no_hatching() -> None:
    ink, _ = _house()
    for x in range(560, 860, 12):
        cv2.line(grey := ink.astype(np.uint8), (x, 200), (x + 20, 180), 1, LINE)
        ink = grey.astype(np.bool_)
    assert not hatch_strokes(ink, LINE).any()


def test_many_short_strokes_that_lie_apart_are_no_hatching() -> None:
    """Ticks of dimension lines, and the faces of slanted walls."""
    grey = np.hstack([_house()[0], np.zeros((700, 600), np.bool_)]).astype(np.uint8)
    for y in range(40, 680, 60):
        for x in range(1020, 1580, 60):
            cv2.line(grey, (x, y), (x + 14, y - 14), 1, LINE)
    assert not hatch_strokes(grey.astype(np.bool_), LINE).any()


def test_hatched_areas_cover_what_is_hatched() -> None:
    ink, inside = _hatched()
    areas = hatched_areas(hatch_strokes(ink, LINE))
    grown = cv2.dilate(inside.astype(np.uint8), np.ones((7, 7), np.uint8)) > 0
    assert (areas & inside).sum() > 0.85 * inside.sum()
    assert (areas & ~grown).sum() == 0


@pytest.mark.parametrize(("draw", "name"), [(_house, "hollow"), (_hatched, "hatched")])
def test_the_drawing_of_walls_is_told(draw: object, name: str) -> None:
    ink, inside = draw()  # type: ignore[operator]
    mask, drawing = outlined_walls(connected(ink), LINE)
    assert drawing == name
    assert (mask & inside).sum() > 0.97 * inside.sum()
    way = next(ways_of_ink(ink, LINE))
    assert way.drawing == name
    assert (way.mask == mask).all()
    # From outside to outside of the outlines.
    assert way.thickness.most_px == pytest.approx(26, abs=1)


def test_furniture_beside_solid_walls_does_not_make_them_hatched() -> None:
    """Filled in, desks and wardrobes are more than the thick walls of this sheet."""
    pixels, truth = next(iter(sheets_of(4064)))
    assert truth.walls_drawn == "filled"
    assert next(ways_drawn(clean_sheet(pixels), [], [])).drawing == "filled"


@pytest.mark.parametrize("tone", [0.35, 0.6])
def test_grey_walls_are_toned_areas_and_floors_and_lines_are_not(tone: float) -> None:
    lines, inside = _house()
    ink = np.where(lines, np.float32(1), np.float32(0))
    ink[inside & ~lines] = tone
    ink[76:300, 80:480] = np.maximum(ink[76:300, 80:480], 0.1)
    found = toned_areas(_blurred(ink, 0.7), LINE)
    paper = ~cv2.dilate(lines.astype(np.uint8), np.ones((5, 5), np.uint8)).astype(np.bool_)
    assert (found & inside & paper).sum() > 0.98 * (inside & paper).sum()
    assert (found & ~inside & paper).sum() == 0


def test_black_walls_are_no_tone() -> None:
    lines, inside = _house()
    assert not toned_areas((lines | inside).astype(np.float32), LINE).any()


def test_two_pens_are_parted_and_one_is_not() -> None:
    lengths = np.zeros(20)
    lengths[[2, 3, 6, 7]] = 900, 700, 1500, 900
    found = two_pens(lengths, 500.0)
    assert found is not None
    assert 3 < found.least_px < 6
    assert found.most_px == pytest.approx(6.4, abs=0.3)
    lengths[[2, 3]] = 0
    assert two_pens(lengths, 500.0) is None


def test_lines_of_a_broad_pen_are_walls() -> None:
    ink = np.zeros((700, 1000), np.bool_)
    for top in (100, 300, 600):
        ink[top : top + 6, 100:900] = True
    for row in (150, 160, 170, 400, 410):
        ink[row : row + 2, 300:800] = True
    found = wall_thickness(ink, 2.0)
    assert found is not None
    assert 2 < found.least_px < 6


@pytest.mark.parametrize("outlined", [True, False])
def test_outlined_walls_end_in_the_middle_of_their_lines(outlined: bool) -> None:
    ink = np.full((200, 600), 0.0, np.float32)
    ink[80:110, 50:550] = 0.4 if outlined else 1.0
    if outlined:
        ink[80:84, 50:550] = ink[106:110, 50:550] = 1.0
    piece = Piece(np.array([50.0, 95.0]), np.array([550.0, 95.0]), 30.0)
    found = without_half_outline([piece], _blurred(ink, 0.6), 4.0)[0]
    assert found.thickness_px == pytest.approx(26 if outlined else 30, abs=0.4)
    assert found.start[1] == pytest.approx(95, abs=0.2)


def _filled(thick: int, thin: int) -> Mask:
    """Walls of two thicknesses around two rooms, and furniture of lines of two pixels."""
    ink = np.zeros((700, 1000), np.bool_)
    ink[100:600, 100:900] = True
    ink[100 + thick : 600 - thick, 100 + thick : 900 - thick] = False
    ink[100:600, 500 : 500 + thin] = True
    ink[350 : 350 + thin, 100:900] = True
    for left in range(160, 800, 90):
        _box(ink, left, 180, left + 60, 260)
    return ink


def test_thin_walls_count_however_thick_others_are() -> None:
    found = wall_thickness(_filled(32, 8), 2.0)
    assert found is not None
    assert found.most_px == 32
    assert 2.0 * 1.6 < found.least_px < 8
    # Leaves of doors are far shorter than the walls on which they hang.
    leaves = _filled(40, 14)
    for left in (140, 300, 540, 700):
        leaves[560 - 110 : 560, left : left + 7] = True
    doors = wall_thickness(leaves, 2.0)
    assert doors is not None
    assert 7 < doors.least_px < 14
    # Thin walls that are as thick as the limit have pixels to lose.
    pale = wall_thickness(_filled(32, 10), 2.0)
    assert pale is not None
    assert 2.0 * 1.6 < pale.least_px < 8.5
    # Lines alone are no thin walls.
    lines = wall_thickness(_filled(32, 2), 2.0)
    assert lines is not None
    assert lines.least_px > 8


def test_no_thin_walls_are_as_thick_as_nothing_is() -> None:
    ink = np.zeros((220, 300), np.bool_)
    ink[20:200, 20:280] = True
    ink[29:191, 29:271] = False
    ink[20:200, 150:152] = ink[110:112, 20:280] = True
    for row in range(40, 100, 6):
        ink[row, 40:140] = True
    found = wall_thickness(ink, 1.26)
    assert found is not None
    assert found.most_px == 9
    # The broader lines are no walls: strokes of three pixels, as would be between, there are none.
    assert found.least_px == pytest.approx(0.3 * 9)


def test_a_frame_of_a_broad_pen_is_no_thin_wall() -> None:
    ink = _filled(32, 2)
    for inset in (20, 60):  # the sheet's frame, and another around the house
        _box(ink, inset, inset, 1000 - inset, 700 - inset)
        framed = ink[inset : 700 - inset, inset : 1000 - inset]
        framed[:6], framed[-6:], framed[:, :6], framed[:, -6:] = True, True, True, True
    found = wall_thickness(ink, 2.0)
    assert found is not None
    assert found.most_px == 32
    assert found.least_px > 8


@pytest.mark.parametrize("drain", [False, True])
def test_what_lies_around_the_basin_of_a_tub_is_no_wall(drain: bool) -> None:
    ink, _ = _house()
    # From wall to wall in a corner: its rim is as broad as the inner wall.
    _box(ink, 72, 546, 420, 628)
    _box(ink, 88, 560, 404, 614)
    if drain:
        _box(ink, 110, 580, 124, 594)
    cells = find_cells(ink, LINE)
    walls = wall_cells(cells)
    rim = int(cells.labels[553, 246])
    assert not walls[rim]
    assert walls[int(cells.labels[300, 62])]
