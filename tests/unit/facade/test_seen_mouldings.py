"""Cornices and courses, from pixels that a network would give."""

from __future__ import annotations

import numpy as np

from veduta.facade.document import FacadeBox
from veduta.facade.eyes import Seen
from veduta.facade.seen_mouldings import seen_mouldings

NAMES = ("window", "wall", "cornice")
BOX = FacadeBox(x_px=20, y_px=50, width_px=300, height_px=250, width_m=12.0, height_m=10.0)
SCALE = 0.04


def _seen(rows: list[tuple[int, int, float]]) -> Seen:
    """Rows of cornice over so much of the width, in a picture of 400 x 400 px."""
    classes = np.zeros((3, 200, 200), np.float32)
    classes[1] = 1.0
    for top, bottom, share in rows:
        end = 10 + round(150 * share)
        classes[2, top // 2 : bottom // 2, 10:end] = 0.9
        classes[1, top // 2 : bottom // 2, 10:end] = 0.1
    empty = np.zeros((1, 100, 100), np.float32)
    borders = np.zeros((4, 100, 100), np.float32)
    return Seen(NAMES, ("window",), classes, empty, borders, 1.0, 1.0, 400, 400)


def _teeth() -> np.ndarray:
    picture = np.full((400, 400, 3), 180, np.uint8)
    for x in range(20, 320, 14):
        picture[40:62, x : x + 6] = 90
    return picture


def test_rows_that_span_the_front_are_mouldings_from_above() -> None:
    pixels = np.full((400, 400, 3), 180, np.uint8)
    found = seen_mouldings(_seen([(44, 60, 1.0), (160, 168, 0.9)]), pixels, BOX, SCALE)
    assert [m.kind for m in found] == ["cornice", "string-course"]
    assert abs(found[0].y_px - 44) <= 2
    assert abs(found[0].height_px - 16) <= 3
    assert (found[0].x_px, found[0].width_px) == (BOX.x_px, BOX.width_px)


def test_a_cornice_over_teeth_stands_on_modillions() -> None:
    found = seen_mouldings(_seen([(40, 62, 1.0)]), _teeth(), BOX, SCALE)
    assert [m.kind for m in found] == ["modillions"]


def test_half_a_front_or_a_thin_line_is_none() -> None:
    pixels = np.full((400, 400, 3), 180, np.uint8)
    assert seen_mouldings(_seen([(160, 170, 0.4)]), pixels, BOX, SCALE) == []
    assert seen_mouldings(_seen([(160, 162, 1.0)]), pixels, BOX, SCALE) == []
    assert seen_mouldings(_seen([(160, 240, 1.0)]), pixels, BOX, SCALE) == []


def test_a_row_of_lintels_is_none() -> None:
    """Hoods over windows take most of a row, but in short stretches."""
    pixels = np.full((400, 400, 3), 180, np.uint8)
    seen = _seen([(160, 172, 1.0)])
    for x in range(10, 160, 25):
        seen.classes[2, :, x + 18 : x + 25] = 0.0
    assert seen_mouldings(seen, pixels, BOX, SCALE) == []
    whole = _seen([(160, 172, 1.0)])
    whole.classes[2, :, 60:61] = 0.0  # a wire before it
    assert len(seen_mouldings(whole, pixels, BOX, SCALE)) == 1
