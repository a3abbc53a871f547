"""Doors whose leaf is drawn alone, without the way that its tip goes."""

from __future__ import annotations

import math

import cv2
import numpy as np
import pytest

from veduta.plan.openings.classify import Judged, is_bare, judge
from veduta.plan.openings.evidence import look_at
from veduta.plan.openings.gaps import Gap
from veduta.plan.openings.settle import usual_door
from veduta.plan.openings.strip import Sheet

START, END, Y, HALF = 150, 240, 250, 10


def judged(*lines: tuple[tuple[int, int], tuple[int, int]], pen: int = 3) -> Judged:
    """The way of 90 px in a wall of 20 px, with lines beside it."""
    drawn = np.zeros((500, 500), np.uint8)
    cv2.rectangle(drawn, (40, Y - HALF), (START - 1, Y + HALF - 1), 255, -1)
    cv2.rectangle(drawn, (END, Y - HALF), (420, Y + HALF - 1), 255, -1)
    for start, end in lines:
        cv2.line(drawn, start, end, 255, pen)
    ink = (drawn / 255).astype(np.float32)
    ends = np.array([START, float(Y)]), np.array([END, float(Y)])
    gap = Gap(0, True, 1, False, *ends, 2.0 * HALF, ends[1])
    found = judge(gap, look_at(gap, Sheet(ink, ink > 0.3)), 20.0, None)
    assert found is not None
    return found


@pytest.mark.parametrize("degrees", [45, 75, 90])
def test_a_line_from_a_jamb_as_long_as_the_way_is_wide_is_a_leaf(degrees: int) -> None:
    turn = math.radians(degrees)
    tip = (round(START + 86 * math.cos(turn)), round(Y - HALF - 86 * math.sin(turn)))
    found = judged(((START, Y - HALF), tip))
    assert (found.kind, found.type, found.hinge, found.swing) == ("door", "swing", "start", "left")
    assert is_bare(found)
    # How wide the doors of a sheet are is said by those with their traces alone.
    assert usual_door([found, found, found]) is None


def test_what_goes_on_or_is_as_thick_as_a_wall_is_no_leaf() -> None:
    assert judged(((START, Y - HALF), (START, 40))).kind == "gap"
    assert judged(((START, Y - HALF), (START, Y - HALF - 86)), pen=19).kind == "gap"
    assert judged(((START, Y - HALF), (START, Y - HALF - 40))).kind == "gap"
    assert judged().kind == "gap"
