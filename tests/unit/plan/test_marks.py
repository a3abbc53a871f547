"""Marks of doors and windows are no sizes, on plans in feet alone."""

from __future__ import annotations

import pytest

from veduta.plan.document import Text
from veduta.plan.scale.marks import without_marks

FEET = ["10' x 12'", "8'1 x 3'4", "21’2 x 20’10"]
MARKS = ["3068", "2668", "1660", "21068", "(5040)"]


def left(*lines: str) -> list[str]:
    box = [(0, 0), (50, 0), (50, 9), (0, 9)]
    return [one.text for one in without_marks([Text(text=t, box_px=box, score=1) for t in lines])]


def test_marks_go_on_a_sheet_in_feet() -> None:
    assert left(*FEET, *MARKS, "KITCHEN", "103") == [*FEET, "KITCHEN", "103"]


@pytest.mark.parametrize("others", [["3.45", "4.20 m"], ["3.45 x 2.80", "12,5 m2"]])
def test_numbers_stay_where_there_are_metres_as_well(others: list[str]) -> None:
    lines = [*FEET, *others, "3068"]
    assert left(*lines) == lines


def test_numbers_stay_where_little_is_in_feet() -> None:
    assert left(*FEET[:2], "3068", "4500") == [*FEET[:2], "3068", "4500"]
    assert left("3450", "4500", "2068") == ["3450", "4500", "2068"]
