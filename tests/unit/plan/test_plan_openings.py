"""What is drawn in a wall's opening, told from drawings with known geometry."""

from __future__ import annotations

import math

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from shapely.geometry import box

from veduta.plan.document import OpeningType
from veduta.plan.openings.along import changed_stretches, profile, usual_profile, with_unbroken
from veduta.plan.openings.av3d import search_wall, side_edges
from veduta.plan.openings.classify import Judged, judge
from veduta.plan.openings.evidence import look_at
from veduta.plan.openings.gaps import Gap
from veduta.plan.openings.leaf_pieces import leaf_pieces
from veduta.plan.openings.leaves import find_arcs
from veduta.plan.openings.sky import leads_out, open_sky
from veduta.plan.openings.strip import Sheet, cut_strip
from veduta.plan.reading import read_storey
from veduta.plan.walls.axes import Axis
from veduta.plan.walls.pieces import Piece

START, END, Y, HALF = 100, 200, 150, 10
"""The opening in a wall of 20 px along y = 150, in a sheet of 300 x 300."""


def wall() -> NDArray[np.uint8]:
    sheet = np.zeros((300, 300), np.uint8)
    cv2.rectangle(sheet, (20, Y - HALF), (START - 1, Y + HALF - 1), 255, -1)
    cv2.rectangle(sheet, (END, Y - HALF), (279, Y + HALF - 1), 255, -1)
    return sheet


def as_sheet(drawn: NDArray[np.uint8]) -> Sheet:
    ink = (drawn / 255).astype(np.float32)
    return Sheet(ink, ink > 0.3)


def gap(start: float = START, end: float = END, thickness: float = 2 * HALF) -> Gap:
    ends = np.array([start, float(Y)]), np.array([end, float(Y)])
    return Gap(0, True, 1, False, *ends, thickness, ends[1])


def judged(drawn: NDArray[np.uint8], outer: bool | None = True, thin_px: float = 20.0) -> Judged:
    found = judge(gap(), look_at(gap(), as_sheet(drawn)), thin_px, outer)
    assert found is not None
    return found


def along_lines(drawn: NDArray[np.uint8], *rows: int) -> NDArray[np.uint8]:
    for row in rows:
        cv2.line(drawn, (START, row), (END, row), 255, 2)
    return drawn


@pytest.mark.parametrize(
    ("rows", "kind"),
    [
        ((Y,), "single-line"),
        ((Y - HALF, Y + HALF), "double-line"),
        ((Y - HALF, Y, Y + HALF), "triple-line"),
    ],
)
def test_windows_are_told_by_their_lines(rows: tuple[int, ...], kind: OpeningType) -> None:
    found = judged(along_lines(wall(), *rows))
    assert (found.kind, found.type) == ("window", kind)


def test_a_shaded_window_is_filled() -> None:
    drawn = wall()
    cv2.rectangle(drawn, (START, Y - HALF), (END, Y + HALF - 1), 80, -1)
    found = judged(along_lines(drawn, Y - HALF, Y + HALF))
    assert (found.kind, found.type) == ("window", "filled")


@pytest.mark.parametrize("first_above", [True, False])
def test_panels_side_by_side_slide(first_above: bool) -> None:
    drawn, side = wall(), -5 if first_above else 5
    cv2.rectangle(drawn, (START, min(Y, Y + side)), (START + 55, max(Y, Y + side)), 255, 1)
    cv2.rectangle(drawn, (START + 45, min(Y, Y - side)), (END, max(Y, Y - side)), 255, 1)
    found = judged(drawn)
    assert (found.kind, found.type) == ("door", "sliding")


def test_a_pocket_is_the_way_beside_the_leaf() -> None:
    drawn = wall()
    cv2.rectangle(drawn, (START, Y - 5), (START + 30, Y + 5), 255, 1)
    for low in range(START + 30, END, 16):
        cv2.line(drawn, (low, Y), (min(low + 9, END), Y), 255, 1)
    found = judged(drawn, outer=False)
    assert (found.kind, found.type, found.hinge) == ("door", "pocket", "start")
    # The leaf's part of the interruption is wall.
    assert found.gap.start[0] == pytest.approx(START + 30, abs=4)
    assert found.gap.end[0] == pytest.approx(END, abs=4)


@pytest.mark.parametrize("leaves", [2, 4])
@pytest.mark.parametrize("at_start", [True, False])
@pytest.mark.parametrize("side", [1, -1])
def test_leaves_that_fold(leaves: int, at_start: bool, side: int) -> None:
    drawn, leaf = wall(), (END - START) / leaves
    run, points = 0.45 * leaf, []
    rise = math.sqrt(leaf**2 - run**2)
    for index in range(leaves + 1):
        x = START + index * run if at_start else END - index * run
        points.append((round(x), round(Y + side * rise * (index % 2))))
    cv2.polylines(drawn, [np.array(points)], False, 255, 2, cv2.LINE_AA)
    found = judged(drawn, outer=False)
    assert (found.kind, found.type) == ("door", "folding")
    assert found.hinge == ("start" if at_start else "end")
    # Rows run down the page: who goes right has its lower part on the right.
    assert found.swing == ("right" if side > 0 else "left")


def test_a_chord_is_the_trace_of_a_leaf_too() -> None:
    drawn = wall()
    tip = (START, Y - (END - START))
    cv2.line(drawn, (START, Y), tip, 255, 2)
    cv2.line(drawn, tip, (END, Y), 255, 2)
    found = judged(drawn, outer=False)
    assert (found.type, found.hinge, found.swing) == ("swing", "start", "left")


def test_nothing_drawn_between_rooms_is_a_gap() -> None:
    found = judged(wall(), outer=False)
    assert (found.kind, found.type) == ("gap", "plain")


def test_a_leaf_as_thick_as_a_wall_is_no_wall() -> None:
    drawn = wall()
    cv2.ellipse(drawn, (START, Y), (100, 100), 0, 0, 90, 255, 2)
    door = judged(drawn)
    leaf = Piece(np.array([START + 2.0, Y + 12]), np.array([START + 2.0, Y + 98]), 6.0)
    beside = Piece(np.array([START - 50.0, Y + 12]), np.array([START - 50.0, Y + 98]), 6.0)
    longer = Piece(np.array([START + 2.0, Y + 12]), np.array([START + 2.0, Y + 148]), 6.0)
    assert leaf_pieces([leaf, beside, longer], [door]) == {0}


def hollow(window: tuple[int, int] | None, shade: int = 0) -> NDArray[np.uint8]:
    """A wall of two lines without an interruption, with a window between two jambs in it."""
    sheet = np.zeros((300, 400), np.uint8)
    cv2.rectangle(sheet, (20, Y - HALF), (380, Y + HALF), 255, 2)
    if window is not None:
        cv2.rectangle(sheet, (window[0], Y - HALF), (window[1], Y + HALF), shade, -1)
        cv2.rectangle(sheet, (window[0], Y - HALF), (window[1], Y + HALF), 255, 2)
    return sheet


def ends() -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    return np.array([40.0, Y]), np.array([360.0, Y])


def test_a_window_in_a_wall_without_a_gap_differs_from_the_wall() -> None:
    strips = [
        cut_strip(*ends(), 2 * HALF, as_sheet(hollow(window, 70))) for window in (None, (140, 240))
    ]
    usual = usual_profile([profile(one) for one in strips])
    assert changed_stretches(profile(strips[0]), usual, 30) == []
    ((low, high),) = changed_stretches(profile(strips[1]), usual, 30)
    assert (low + 40, high + 40) == pytest.approx((140, 240), abs=4)


@pytest.mark.parametrize("pierced", [False, True])
def test_a_filled_wall_is_pierced_by_a_window_and_not_by_a_bench_beside_it(pierced: bool) -> None:
    sheet = np.zeros((300, 400), np.uint8)
    cv2.rectangle(sheet, (20, Y - HALF), (380, Y + HALF), 255, -1)
    bare = profile(cut_strip(*ends(), 2 * HALF, as_sheet(sheet)))
    for y in range(Y + HALF, Y + 3 * HALF, 3):
        cv2.line(sheet, (140, y), (240, y), 255, 1)
    if pierced:
        cv2.rectangle(sheet, (140, Y - HALF + 2), (240, Y + HALF - 2), 0, -1)
    found = changed_stretches(
        profile(cut_strip(*ends(), 2 * HALF, as_sheet(sheet))), usual_profile([bare]), 30
    )
    if pierced:
        ((low, high),) = found
        assert (low + 40, high + 40) == pytest.approx((140, 240), abs=4)
    else:
        assert found == []


@pytest.mark.parametrize("above", [0, 2])
@pytest.mark.parametrize("below", [0, 2])
def test_a_bar_over_a_wall_of_one_line_is_a_window(above: int, below: int) -> None:
    sheet = np.zeros((300, 400), np.uint8)
    cv2.rectangle(sheet, (20, Y - 3), (380, Y + 3), 255, -1)
    bare = profile(cut_strip(*ends(), 6.0, as_sheet(sheet)))
    cv2.rectangle(sheet, (140, Y - 3 - above), (240, Y + 3 + below), 255, -1)
    own = profile(cut_strip(*ends(), 6.0, as_sheet(sheet)))
    assert changed_stretches(own, usual_profile([bare]), 30) == []
    found = changed_stretches(own, usual_profile([bare]), 30, bars=True)
    if above and below:
        ((low, high),) = found
        assert (low + 40, high + 40) == pytest.approx((140, 240), abs=4)
    else:
        assert found == []


def lines_of_two_pens(bar: bool, off_px: float) -> tuple[Sheet, list[Axis]]:
    """A house of lines of 7 px with inner walls of 4 px; a window of two lines in the upper wall.

    The axes lie `off_px` beside the middles of the lines.
    """
    sheet = np.zeros((400, 600), np.uint8)
    outer = [(50, 50, 550, 50), (550, 50, 550, 350), (50, 350, 550, 350), (50, 50, 50, 350)]
    inner = [(x, 50, x, 350) for x in (130, 210, 290, 370, 450)]
    inner += [(50, y, 550, y) for y in (150, 250)]
    axes = []
    for lines, thick in ((outer, 7), (inner, 4)):
        for x, y, right, bottom in lines:
            sheet[y - thick // 2 : bottom + (thick + 1) // 2,
                  x - thick // 2 : right + (thick + 1) // 2] = 255  # fmt: skip
            middle = (thick % 2) / 2 + off_px
            start, end = np.array([x, y]) + middle, np.array([right, bottom]) + middle
            axes.append(Axis(Piece(start, end, float(thick), "single-line"), ()))
    if bar:
        sheet[45:57, 220:280] = 255
    return as_sheet(sheet), axes


@pytest.mark.parametrize("off_px", [0.0, 0.6])
@pytest.mark.parametrize("bar", [False, True])
def test_outer_walls_of_a_broader_pen_are_no_windows(bar: bool, off_px: float) -> None:
    sheet, axes = lines_of_two_pens(bar, off_px)
    sky = box(-100, -100, 700, 500).difference(box(46, 46, 554, 354))
    found = with_unbroken(axes, sheet, 10.0, sky)
    spans = [(one.first + 50, one.last + 50) for axis in found for one in axis.openings]
    if bar:
        assert spans == [pytest.approx((220, 280), abs=4)]
    else:
        assert spans == []


def test_av3d_pairs_the_edges_of_a_window() -> None:
    sheet = as_sheet(hollow((140, 240)))
    edges = [one.at + 40 for one in side_edges(cut_strip(*ends(), 2 * HALF, sheet))]
    for jamb in (140, 240):
        assert min(abs(at - jamb) for at in edges) <= 2
    assert all(min(abs(at - 140), abs(at - 240)) <= 2 for at in edges)
    (found,) = search_wall(*ends(), 2 * HALF, sheet, (60.0, 160.0))
    assert (found.first_px + 40, found.last_px + 40) == pytest.approx((140, 240), abs=3)
    assert found.type == "double-line"


def test_av3d_finds_nothing_in_a_bare_wall() -> None:
    assert search_wall(*ends(), 2 * HALF, as_sheet(hollow(None)), (60.0, 160.0)) == []


def four_rooms() -> NDArray[np.uint8]:
    """Rooms side by side; doors between them are two lines on the wall's faces, without a leaf.

    Windows have a third line; the opening at x = 860 to 960 in the lower wall is drawn as doors.
    """
    image = np.full((700, 1500, 3), 255, np.uint8)
    cv2.rectangle(image, (100, 100), (1399, 599), (0, 0, 0), -1)
    for left in (120, 441, 762, 1083):
        cv2.rectangle(image, (left, 120), (left + 297, 579), (255, 255, 255), -1)

    def opening(x: int, y: int, size: tuple[int, int], middle: bool) -> None:
        cv2.rectangle(image, (x, y), (x + size[0] - 1, y + size[1] - 1), (255, 255, 255), -1)
        if size[0] > size[1]:
            rows = (y + 1, y + size[1] - 2, *((y + size[1] // 2,) if middle else ()))
            for row in rows:
                cv2.line(image, (x, row), (x + size[0] - 1, row), (0, 0, 0), 2)
        else:
            for column in (x + 1, x + size[0] - 2):
                cv2.line(image, (column, y), (column, y + size[1] - 1), (0, 0, 0), 2)

    for x in (418, 739, 1060):
        opening(x, 300, (23, 100), False)
    for x in (200, 520, 860, 1180):
        opening(x, 100, (120, 20), True)
    opening(860, 580, (100, 20), False)
    return image


def test_an_outer_door_is_told_by_the_drawing_of_inner_ones() -> None:
    drawn = read_storey(four_rooms())
    assert len(drawn.rooms) == 4
    outer = {wall.id for wall in drawn.walls if wall.outer}
    found = sorted((one.wall in outer, one.kind) for one in drawn.openings)
    assert found == [(False, "door")] * 3 + [(True, "door")] + [(True, "window")] * 4


def test_between_a_house_and_a_scale_bar_it_is_outdoors() -> None:
    corners = [(100, 100), (700, 100), (700, 500), (100, 500)]
    sides = zip(corners, [*corners[1:], corners[0]], strict=True)
    walls = [Piece(np.array(a, float), np.array(b, float), 10.0) for a, b in sides]
    bar = Piece(np.array([250.0, 60.0]), np.array([550.0, 60.0]), 10.0)
    sky = open_sky([Axis(one, ()) for one in (*walls, bar)], 10.0, [])
    assert leads_out(walls[0], (250.0, 350.0), sky)
    inner = Piece(np.array([400.0, 100.0]), np.array([400.0, 500.0]), 10.0)
    assert not leads_out(inner, (150.0, 250.0), sky)


@pytest.mark.parametrize("radius_px", range(118, 136, 3))
def test_the_thin_pen_of_a_large_sheet_is_seen_at_any_radius(radius_px: int) -> None:
    faint = np.zeros((260, 320), np.uint8)
    cv2.ellipse(faint, (80, 200), (radius_px, radius_px), 0.0, -90.0, 0.0, 1, 2)
    cv2.line(faint, (80, 200), (80, 200 - radius_px), 1, 1)
    drawn = faint.astype(np.bool_)
    ends = np.array([80.0, 209.5]), np.array([80.0 + 128.0, 209.5])
    gap = Gap(0, True, 1, False, *ends, 19.0, ends[1])
    best = find_arcs(gap, Sheet(drawn.astype(np.float32), drawn))[0]
    assert best.score > 0.8
    assert best.hinge_at_start
