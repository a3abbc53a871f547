"""Windows that are told by words: which words, beside which ways, between which strokes."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from shapely.geometry import box

from veduta.plan.document import Text
from veduta.plan.openings.gaps import Gap
from veduta.plan.openings.labelled import (
    Labels,
    said_window,
    ticks_across,
    window_labels,
    with_said,
)
from veduta.plan.openings.strip import Sheet
from veduta.plan.walls.axes import Axis
from veduta.plan.walls.pieces import Piece

DOOR_PX = 60.0


def text(words: str, x: float, y: float) -> Text:
    """A line of 40 by 12 px about a place."""
    corners = [(x - 20, y - 6), (x + 20, y - 6), (x + 20, y + 6), (x - 20, y + 6)]
    return Text(text=words, box_px=corners, score=0.9)


@pytest.mark.parametrize(
    "words", ["Fenster", "window", "FENSTER 1,58", "Fenêtre", "Window 1.20 x 1.35", "窓"]
)
def test_the_word_says_it_in_many_languages(words: str) -> None:
    (middle,) = window_labels([text(words, 50, 80)])
    assert middle.tolist() == [50.0, 80.0]


@pytest.mark.parametrize("words", ["Wohnen", "Windfang", "Kitchen", "3,40", "W 12 m"])
def test_other_words_do_not(words: str) -> None:
    assert window_labels([text(words, 50, 80)]) == []


def test_numbers_say_it_where_they_are_a_schedule() -> None:
    row = [text(f"W{number}", 100.0 * number, 50) for number in (1, 2, 3)]
    assert len(window_labels(row)) == 3
    assert window_labels(row[:2]) == []
    assert window_labels([row[0], text("W1", 400, 50), text("F1", 500, 50)]) == []


def test_a_number_of_a_schedule_says_it_at_every_window_of_its_type() -> None:
    marks = ("W1", "W1", "W1", "W2", "W3")
    row = [text(mark, 100.0 * place, 50) for place, mark in enumerate(marks)]
    assert sorted(one[0] for one in window_labels(row)) == [0.0, 100.0, 200.0, 300.0, 400.0]
    # Two numbers are no schedule, however often they stand there ...
    assert window_labels(row[:4]) == []
    # ... and those with a letter are others.
    assert len(window_labels([*row[:4], text("W1a", 500, 50)])) == 5
    assert len(window_labels([text(f"W1{one}", 50, 50) for one in "abc"])) == 3


def test_a_way_beside_a_label_is_a_window_and_one_farther_off_is_not() -> None:
    ends = np.array([100.0, 200.0]), np.array([220.0, 200.0])
    gap = Gap(0, True, 1, False, *ends, 20.0, ends[1])

    def said(x: float, y: float) -> bool:
        return said_window(gap, Labels([np.array([x, y])], DOOR_PX, 2.0)) is not None

    assert said(160, 170)
    assert said(110, 260)
    assert not said(160, 300)
    assert not said(320, 170)


@pytest.mark.parametrize(
    ("width", "is_one"),
    [(20.0, False), (28.0, True), (264.0, True), (276.0, False), (450.0, False)],
)
def test_beside_a_label_only_ways_as_wide_as_windows_are_some(width: float, is_one: bool) -> None:
    # Of 0.4 to 4.5 doors: 24 to 270 px. The widest is 60 thicknesses of its wall.
    ends = np.array([100.0, 200.0]), np.array([100.0 + width, 200.0])
    gap = Gap(0, True, 1, False, *ends, 7.5, ends[1])
    labels = Labels([np.array([100.0 + width / 2.0, 180.0])], DOOR_PX, 2.0)
    assert (said_window(gap, labels) is not None) == is_one


def outline() -> tuple[Axis, Sheet]:
    """A wall that is a line of 3 px with short strokes across at 150 and 250, a wall at 330."""
    drawn = np.zeros((300, 500), np.uint8)
    cv2.line(drawn, (50, 150), (450, 150), 255, 3)
    for x in (150, 250):
        cv2.line(drawn, (x, 142), (x, 158), 255, 3)
    cv2.line(drawn, (330, 150), (330, 290), 255, 3)
    ink = (drawn / 255).astype(np.float32)
    line = Piece(np.array([50.0, 150.5]), np.array([450.0, 150.5]), 3.0)
    return Axis(line, ()), Sheet(ink, ink > 0.3)


def test_short_strokes_across_a_line_are_seen_and_walls_that_end_at_it_are_none() -> None:
    axis, sheet = outline()
    ticks = ticks_across(axis.line, sheet, DOOR_PX)
    assert np.abs(np.array(ticks) - [100.0, 200.0]).max() < 1.5


@pytest.mark.parametrize(("label", "count"), [((200.0, 120.0), 1), ((290.0, 120.0), 0)])
def test_between_two_of_them_and_beside_a_label_is_a_window(
    label: tuple[float, float], count: int
) -> None:
    axis, sheet = outline()
    labels = Labels([np.array(label)], DOOR_PX, 3.0)
    (done,) = with_said([axis], labels, sheet, box(0, 0, 500, 148))
    assert len(done.openings) == count
    if count:
        one = done.openings[0]
        assert one.judged.kind == "window"
        assert (one.first, one.last) == pytest.approx((100.0, 200.0), abs=1.5)
    # Indoors there are none.
    assert with_said([axis], labels, sheet, box(0, 0, 1, 1))[0].openings == ()
