"""Flights found on drawn sheets: treads, size, which way they rise, and what is none."""

from __future__ import annotations

import re

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

from veduta.plan.document import Text
from veduta.plan.drawn import DrawnStairs
from veduta.plan.reading import read_storey
from veduta.plan.remarks import false_flights
from veduta.plan.stairs.find import find_flights, true_flights, without_flights

Ink = NDArray[np.bool_]
LINE = 2
TREADS, STEP, LEFT, TOP, WIDTH = 11, 27, 240, 250, 110


def sheet() -> NDArray[np.uint8]:
    """Solid walls around a house of 10 x 8 m at 100 px a metre."""
    grey = np.zeros((1000, 1200), np.uint8)
    cv2.rectangle(grey, (100, 100), (1100, 900), 255, -1)
    cv2.rectangle(grey, (125, 125), (1075, 875), 0, -1)
    return grey


def treads(grey: NDArray[np.uint8], *, hidden: int | None = None) -> None:
    for number in range(TREADS + 1):
        if number != hidden:
            y = TOP + number * STEP
            cv2.line(grey, (LEFT, y), (LEFT + WIDTH, y), 255, LINE)
    for x in (LEFT, LEFT + WIDTH):
        cv2.line(grey, (x, TOP), (x, TOP + TREADS * STEP), 255, LINE)


def arrow(grey: NDArray[np.uint8], *, upwards: bool) -> None:
    x = LEFT + WIDTH // 2
    tip, tail = TOP + 15, TOP + TREADS * STEP - 15
    if not upwards:
        tip, tail = tail, tip
    back = 18 if upwards else -18
    cv2.line(grey, (x, tail), (x, tip), 255, LINE)
    for side in (-11, 11):
        cv2.line(grey, (x + side, tip + back), (x, tip), 255, LINE)


def found(grey: NDArray[np.uint8], texts: tuple[Text, ...] = ()) -> tuple[DrawnStairs, ...]:
    return find_flights(grey > 0, LINE, texts)


@pytest.mark.parametrize("turned", [False, True])
@pytest.mark.parametrize("upwards", [False, True])
def test_a_flight_has_its_treads_and_rises_along_its_arrow(turned: bool, upwards: bool) -> None:
    grey = sheet()
    treads(grey)
    arrow(grey, upwards=upwards)
    (one,) = found(np.ascontiguousarray(grey.T) if turned else grey)
    low = np.array([LEFT, TOP])
    high = low + np.array([WIDTH, TREADS * STEP])
    order = [1, 0] if turned else [0, 1]
    assert one.treads == TREADS
    assert one.outline_px.min(axis=0) == pytest.approx(low[order], abs=3)
    assert one.outline_px.max(axis=0) == pytest.approx(high[order], abs=3)
    up = np.array([0.0, -1.0 if upwards else 1.0])
    assert one.up_px == tuple(up[order])


def test_a_hidden_tread_is_put_in() -> None:
    grey = sheet()
    treads(grey, hidden=9)
    (one,) = found(grey)
    assert one.treads == TREADS
    assert one.up_px == (0.0, 0.0)


@pytest.mark.parametrize(("word", "rises"), [("UP", -1.0), ("auf", -1.0), ("DN", 1.0)])
def test_the_word_at_an_end_goes_before_the_arrow(word: str, rises: float) -> None:
    grey = sheet()
    treads(grey)
    arrow(grey, upwards=False)
    y = TOP + TREADS * STEP + 10.0
    box = [(250.0, y), (280.0, y), (280.0, y + 15), (250.0, y + 15)]
    (one,) = found(grey, (Text(text=word, box_px=box, score=1.0),))
    assert one.up_px == (0.0, rises)


@pytest.mark.parametrize(("words", "up"), [("H=2.60", 0.0), ("b 1.20", 0.0), ("h", -1.0)])
def test_a_height_is_no_word_for_up(words: str, up: float) -> None:
    grey = sheet()
    treads(grey)
    y = TOP + TREADS * STEP + 10.0
    box = [(250.0, y), (280.0, y), (280.0, y + 15), (250.0, y + 15)]
    (one,) = found(grey, (Text(text=words, box_px=box, score=1.0),))
    assert one.up_px == (0.0, up)


def test_treads_may_end_at_solid_walls() -> None:
    grey = sheet()
    cv2.rectangle(grey, (LEFT - 20, 125), (LEFT, 600), 255, -1)
    cv2.rectangle(grey, (LEFT + WIDTH, 125), (LEFT + WIDTH + 20, 600), 255, -1)
    for number in range(1, TREADS + 1):
        y = 125 + number * STEP
        cv2.line(grey, (LEFT, y), (LEFT + WIDTH, y), 255, LINE)
    (one,) = found(grey)
    assert one.treads == TREADS  # the wall's face above is the last line
    assert one.outline_px[:, 1].min() == pytest.approx(125, abs=2)


def test_tiles_windows_and_uneven_lines_are_no_stairs() -> None:
    tiles = sheet()
    for x in range(300, 800, 30):
        cv2.line(tiles, (x, 200), (x, 700), 255, LINE)
    for y in range(200, 700, 30):
        cv2.line(tiles, (300, y), (800, y), 255, LINE)
    uneven = sheet()
    for y in (200, 231, 249, 290, 302, 350, 371, 402, 425):
        cv2.line(uneven, (300, y), (420, y), 255, LINE)
    panes = sheet()
    for y in (200, 226, 252, 278):
        cv2.line(panes, (300, y), (420, y), 255, LINE)
    for grey in (sheet(), tiles, uneven, panes):
        assert found(grey) == ()


def test_what_lies_in_a_flight_is_taken_out_but_not_its_rim() -> None:
    grey = sheet()
    treads(grey)
    ink: Ink = grey > 0
    cleared = without_flights(ink, found(grey), LINE)
    assert not cleared[TOP + 20 : TOP + TREADS * STEP - 20, LEFT + 10 : LEFT + WIDTH - 10].any()
    assert cleared[TOP : TOP + TREADS * STEP, LEFT].all()
    outside = np.ones(ink.shape, bool)
    outside[TOP - 5 : TOP + TREADS * STEP + 5, LEFT - 5 : LEFT + WIDTH + 5] = False
    assert (cleared == ink)[outside].all()


def test_stairs_have_the_size_of_stairs_and_lie_in_the_house() -> None:
    grey = sheet()
    treads(grey)
    pixels = np.repeat(255 - grey[..., None], 3, axis=2)
    drawn = read_storey(pixels)
    scale = drawn.cleaned.clean_from_scan[0, 0]
    kept = true_flights(drawn, 0.01 / scale)
    assert [one.treads for one in kept] == [TREADS]
    assert true_flights(drawn, 0.05 / scale) == ()
    assert false_flights(drawn.stairs, kept) == []
    (said,) = false_flights(drawn.stairs, ())
    x, y = np.array([LEFT + WIDTH / 2, TOP + TREADS * STEP / 2]) * scale
    told = [float(one) for one in re.findall(r"\d+", said)[:2]]
    assert told == pytest.approx([x, y], abs=5)
    assert "not taken for stairs" in said
    assert true_flights(drawn, 0.004 / scale) == ()
