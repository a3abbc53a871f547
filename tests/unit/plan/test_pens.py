"""Strokes of a broader pen are told from lines by their ink, however these look."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

from veduta.plan.clean.ink import marks
from veduta.plan.walls.pens import broader_pens

FINE = 8
"""Drawn so many times as large, and averaged: lines have exactly the ink that they are told."""

Image = NDArray[np.uint8]
Line = tuple[tuple[float, float], tuple[float, float]]

HOUSE: tuple[Line, ...] = (
    ((60, 60), (540, 60)), ((540, 60), (540, 420)), ((540, 420), (60, 420)), ((60, 420), (60, 60)),
    ((60, 240), (540, 240)), ((300, 60), (300, 240)), ((200, 240), (280, 420)),
)  # fmt: skip
"""Outer walls, two inner ones and a slanted one."""

LINES: tuple[Line, ...] = (
    ((300, 120), (370, 120)), ((120, 300), (120, 380)), ((120, 380), (180, 380)),
    ((400, 300), (500, 300)), ((400, 300), (400, 360)), ((440, 150), (520, 90)),
)  # fmt: skip
"""Leaves of doors and furniture, one of it slanted."""

BARS: tuple[Line, ...] = (
    ((120, 60), (220, 60)),
    ((350, 420), (450, 420)),
    ((540, 120), (540, 200)),
)
"""Windows whose lines run into one."""


def sheet() -> Image:
    return np.zeros((480 * FINE, 600 * FINE), np.uint8)


def draw(image: Image, lines: tuple[Line, ...], width: float) -> None:
    for start, end in lines:
        a, b = np.array(start) * FINE, np.array(end) * FINE
        along = (b - a) / np.hypot(*(b - a)) * width * FINE / 2
        side = np.array([-along[1], along[0]])
        corners = np.array([a - along + side, b + along + side, b + along - side, a - along - side])
        cv2.fillConvexPoly(image, np.round(corners).astype(np.int32), 255)


def arc(image: Image, width: float) -> None:
    """The way of a door's leaf."""
    middle, reach = (100 * FINE, 240 * FINE), (50 * FINE, 50 * FINE)
    cv2.ellipse(image, middle, reach, 0, 270, 360, 255, round(width * FINE))


def seen(image: Image, blur: float) -> NDArray[np.float32]:
    small = cv2.resize(image, None, fx=1 / FINE, fy=1 / FINE, interpolation=cv2.INTER_AREA)
    ink = small.astype(np.float32) / 255
    return cv2.GaussianBlur(ink, (0, 0), blur) if blur else ink


def drawn(
    wall: float, line: float, bar: float | None, blur: float
) -> tuple[NDArray[np.float32], Image]:
    """The ink of a house, and where its walls are."""
    image, walls = sheet(), sheet()
    draw(walls, HOUSE, wall)
    draw(image, HOUSE, wall)
    draw(image, LINES, line)
    arc(image, line)
    if bar is not None:
        draw(image, BARS, bar)
    return seen(image, blur), walls


@pytest.mark.parametrize("blur", [0.0, 1.0, 1.6])
@pytest.mark.parametrize("bar", [None, 8.0])
@pytest.mark.parametrize(("wall", "line"), [(4.5, 2.5), (5.0, 3.6), (3.0, 1.2)])
def test_walls_are_what_the_broader_pen_drew(
    wall: float, line: float, bar: float | None, blur: float
) -> None:
    ink, walls = drawn(wall, line, bar, blur)
    mask = marks(ink, line)
    pens = broader_pens(ink, mask)
    assert pens
    found = pens[0]
    assert line < found.thickness.least_px < wall
    at = cv2.resize(walls, None, fx=1 / FINE, fy=1 / FINE, interpolation=cv2.INTER_AREA) > 127
    assert found.mask[at & mask].mean() > 0.95
    near = cv2.dilate(at.astype(np.uint8), np.ones((15, 15), np.uint8)) > 0
    far = mask & ~near
    assert far.sum() > 300
    assert found.mask[far].mean() < 0.03


def test_strokes_that_never_meet_are_no_walls() -> None:
    """Windows are the broadest strokes here, and rows of them are no house."""
    ink, _ = drawn(3.0, 3.0, 8.0, 0.5)
    assert broader_pens(ink, ink > 0.4) == []


def test_one_pen_draws_no_walls() -> None:
    ink, _ = drawn(3.0, 3.0, None, 0.5)
    assert broader_pens(ink, ink > 0.4) == []


def test_a_blank_sheet_has_no_pens() -> None:
    ink = np.zeros((100, 100), np.float32)
    assert broader_pens(ink, ink > 0.4) == []


@pytest.mark.parametrize("frame", [4.0, 4.5])
def test_the_border_of_a_sheet_is_no_house(frame: float) -> None:
    image = sheet()
    draw(image, HOUSE, 3.0)
    draw(image, LINES, 3.0)
    corners = [(20, 20), (580, 20), (580, 460), (20, 460)]
    draw(image, tuple(zip(corners, corners[1:] + corners[:1], strict=True)), frame)
    ink = seen(image, 0.5)
    assert broader_pens(ink, marks(ink, 3.0)) == []
