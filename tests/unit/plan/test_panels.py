"""Doors of panels: pairs that meet in a tick, one before its wall, two that fold to each jamb."""

from __future__ import annotations

import math

import cv2
import numpy as np
import pytest
from shapely.geometry import box

from veduta.plan.openings.classify import Judged, judge
from veduta.plan.openings.evidence import Views, look_at
from veduta.plan.openings.gaps import Gap
from veduta.plan.openings.jambs import with_jambed
from veduta.plan.openings.panels import find_panel
from veduta.plan.openings.strip import Sheet
from veduta.plan.openings.ticks import panels_beyond, tick_pieces
from veduta.plan.walls.axes import Axis
from veduta.plan.walls.find import Found
from veduta.plan.walls.pieces import Piece
from veduta.plan.walls.solid import Thickness

START, END, Y, HALF = 150, 330, 250, 10
Line = tuple[tuple[int, int], tuple[int, int]]
FACES: tuple[Line, ...] = tuple(
    ((START, Y + side), (END, Y + side)) for side in (-HALF + 1, HALF - 2)
)  # fmt: skip
ALONG: Line = ((START, Y), (END, Y))
TICK: Line = ((240, Y - 16), (240, Y + 16))


def drawn_sheet(*lines: Line) -> Sheet:
    """A wall of 20 px with a way of 180 px, and lines of 2 px in it and beside it."""
    drawn = np.zeros((500, 500), np.uint8)
    cv2.rectangle(drawn, (40, Y - HALF), (START - 1, Y + HALF - 1), 255, -1)
    cv2.rectangle(drawn, (END, Y - HALF), (460, Y + HALF - 1), 255, -1)
    for start, end in lines:
        cv2.line(drawn, start, end, 255, 2)
    ink = (drawn / 255).astype(np.float32)
    return Sheet(ink, ink > 0.3)


def judged(*lines: Line, outer: bool | None = False) -> Judged | None:
    """What the way is taken for."""
    ends = np.array([START, float(Y)]), np.array([END, float(Y)])
    gap = Gap(0, True, 1, False, *ends, 2.0 * HALF, ends[1])
    return judge(gap, look_at(gap, drawn_sheet(*lines)), 14.0, outer)


def test_a_stroke_across_the_middle_of_a_way_between_rooms_is_where_panels_meet() -> None:
    found = judged(*FACES, ALONG, TICK)
    assert found is not None
    assert (found.kind, found.type) == ("door", "sliding")
    # Wide ways with lines alone, or with a stroke elsewhere, say no such thing ...
    aside: Line = ((185, Y - 16), (185, Y + 16))
    for lines in ((*FACES, ALONG), (*FACES, ALONG, aside), (*FACES, ALONG, aside, TICK)):
        other = judged(*lines)
        assert other is None or other.type != "sliding"
    # ... and towards the outdoors it is a window of two wings.
    window = judged(*FACES, ALONG, TICK, outer=True)
    assert window is not None
    assert window.kind == "window"


@pytest.mark.parametrize("shift", [-90, -40, 40])
@pytest.mark.parametrize("side", [-1, 1])
def test_a_line_before_the_way_and_its_wall_is_a_panel(shift: int, side: int) -> None:
    level = Y + side * (HALF + 6)
    found = judged(((START + shift, level), (END + shift, level)))
    assert found is not None
    assert (found.kind, found.type) == ("door", "sliding")


@pytest.mark.parametrize(
    "line",
    [
        ((START, Y + 16), (END, Y + 16)),  # a sill
        ((60, Y + 16), (450, Y + 16)),  # a counter along the whole wall
        ((START - 60, Y + 60), (END - 60, Y + 60)),  # far before it
        ((START - 40, Y + 16), (START + 60, Y + 16)),  # short
    ],
)
def test_other_lines_beside_a_way_are_no_panels(line: Line) -> None:
    found = judged(line)
    assert found is None or found.type != "sliding"


def test_two_zigzags_from_both_jambs_are_leaves_that_fold_to_both() -> None:
    leaf = (END - START) / 4
    run, rise = 0.45 * leaf, math.sqrt(1 - 0.45**2) * leaf
    base = Y - HALF
    lines: list[Line] = []
    for jamb, towards in ((START, 1), (END, -1)):
        spots = [
            (round(jamb + towards * step * run), round(base - rise * (step % 2)))
            for step in range(3)
        ]
        lines += [(spots[0], spots[1]), (spots[1], spots[2])]
    found = judged(*lines)
    assert found is not None
    assert (found.type, found.hinge, found.swing) == ("folding", "both", "left")
    alone = judged(*lines[:2])
    assert alone is None or alone.type != "folding"


def test_a_stroke_that_was_taken_for_a_wall_is_told_from_a_pillar() -> None:
    def pieces(middle: float) -> list[Piece]:
        return [
            Piece(np.array([40.0, Y]), np.array([float(START), Y]), 20.0),
            Piece(np.array([float(END), Y]), np.array([460.0, Y]), 20.0),
            Piece(np.array([middle, Y - 12.0]), np.array([middle, Y + 12.0]), 4.0),
        ]

    def told(middle: float, sheet: Sheet) -> set[int]:
        solid = sheet.ink > 0.5
        solid[:, START:END] = False
        return tick_pieces(Found(pieces(middle), solid, Thickness(20.0, 20.0), 20.0), Views(sheet))

    assert told(240.0, drawn_sheet(*FACES, ALONG, TICK)) == {2}
    assert told(170.0, drawn_sheet(*FACES, ALONG, TICK)) == set()
    assert told(240.0, drawn_sheet()) == set()


def hollow(*lines: Line, arc: tuple[int, int, int] | None = None) -> Sheet:
    """A wall of two lines 20 px apart from 40 to 460, closed at both ends, with lines in it."""
    drawn = np.zeros((500, 500), np.uint8)
    cv2.rectangle(drawn, (40, Y - HALF), (460, Y + HALF), 255, 2)
    for start, end in lines:
        cv2.line(drawn, start, end, 255, 2)
    if arc is not None:
        x, y, radius = arc
        cv2.ellipse(drawn, (x, y), (radius, radius), 0, 270, 360, 255, 2)
        cv2.line(drawn, (x, y), (x, y - radius), 255, 2)
    ink = (drawn / 255).astype(np.float32)
    return Sheet(ink, ink > 0.3)


def doors_between(sheet: Sheet) -> list[tuple[str, int, int]]:
    """Type and ends of the doors in a wall of two lines that is not interrupted."""
    line = Piece(np.array([40.0, Y]), np.array([460.0, Y]), 20.0, "hollow")
    (axis,) = with_jambed([Axis(line, ())], sheet, 12.0, box(0, 0, 1, 1))
    return [(one.judged.type, round(one.first), round(one.last)) for one in axis.openings]


JAMBS: tuple[Line, ...] = (((160, Y - HALF), (160, Y + HALF)), ((250, Y - HALF), (250, Y + HALF)))


def test_a_trace_between_two_jambs_is_a_door_though_the_wall_runs_on() -> None:
    ((kind, first, last),) = doors_between(hollow(*JAMBS, arc=(161, Y - HALF, 88)))
    assert kind == "swing"
    assert abs(first - 121) <= 4
    assert abs(last - 209) <= 8
    assert doors_between(hollow(*JAMBS)) == []
    assert doors_between(hollow()) == []


def test_beside_one_jamb_it_is_as_wide_as_its_trace() -> None:
    ((kind, first, last),) = doors_between(hollow(JAMBS[0], arc=(161, Y - HALF, 100)))
    assert kind == "swing"
    assert abs(first - 121) <= 5
    assert abs(last - first - 100) <= 8


def test_panels_from_a_corner_on_to_the_next_wall_are_a_door() -> None:
    lines = ((40, Y - 9), (240, Y - 9)), ((40, Y + 9), (240, Y + 9)), ((40, Y), (240, Y))
    tick = ((140, Y - 16), (140, Y + 16))

    def told(*drawn: Line) -> list[tuple[str, float]]:
        ink = np.zeros((500, 500), np.uint8)
        for start, end in drawn:
            cv2.line(ink, start, end, 255, 2)
        sheet = Sheet((ink / 255).astype(np.float32), ink > 0)
        pieces = [
            Piece(np.array([262.0, Y]), np.array([460.0, Y]), 20.0),
            Piece(np.array([250.0, Y - 10.0]), np.array([250.0, 400.0]), 20.0),
            Piece(np.array([30.0, 100.0]), np.array([30.0, 400.0]), 20.0),
        ]
        found = Found(pieces, np.zeros((500, 500), np.bool_), Thickness(16.0, 20.0), 16.0)
        doors = panels_beyond(found, Views(sheet))
        return [(one.type, round(one.gap.width_px)) for one in doors]

    assert told(*lines, tick) == [("sliding", 200)]
    assert told(*lines) == []
    assert told(*lines[:2], tick) == []
    assert told(tick) == []


def test_a_narrow_way_in_a_thick_wall_has_no_room_for_a_panel() -> None:
    ends = np.array([START, float(Y)]), np.array([START + 20.0, float(Y)])
    gap = Gap(0, True, 1, False, *ends, 60.0, ends[1])
    assert find_panel(gap, drawn_sheet()) == 0.0
