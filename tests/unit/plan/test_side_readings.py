"""What sizes in rooms say, against rooms drawn at a scale that is known."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from veduta.plan.document import Text
from veduta.plan.scale.free_runs import wall_masks
from veduta.plan.scale.sharpen import Reading
from veduta.plan.scale.side_readings import side_readings

MPP = 0.01
WALL = 12


def _read(
    texts: list[Text], rooms: list[NDArray[np.float64]], ink: NDArray[np.float32]
) -> list[Reading]:
    return side_readings(texts, rooms, [WALL], wall_masks(ink, [WALL]), ink, MPP)


def _text(words: str, x: float, y: float) -> Text:
    box = [(x - 40, y - 6), (x + 40, y - 6), (x + 40, y + 6), (x - 40, y + 6)]
    return Text(text=words, box_px=box, score=0.95)


def _sheet(*rooms: tuple[int, int, int, int]) -> NDArray[np.float32]:
    """Ink of walls around rooms (left, top, right, bottom), whole pixels."""
    ink = np.zeros((700, 1100), np.float32)
    for left, top, right, bottom in rooms:
        ink[top - WALL : bottom + WALL, left - WALL : right + WALL] = 1.0
    for left, top, right, bottom in rooms:
        ink[top:bottom, left:right] = 0.0
    return ink


def _box(left: float, top: float, right: float, bottom: float) -> NDArray[np.float64]:
    return np.array([(left, top), (right, top), (right, bottom), (left, bottom)])


def _scales(found: list[Reading]) -> list[float]:
    return [math.exp(one.log_mpp) for one in found]


def test_sides_are_measured_between_faces_and_not_by_the_outline() -> None:
    """The outline is 2 px too short; which side is which does not matter."""
    ink = _sheet((50, 50, 450, 350))
    for words in ("4.00 x 3.00", "3,00 x 4,00"):
        found = _read([_text(words, 250, 200)], [_box(50, 50, 448, 349)], ink)
        assert _scales(found) == pytest.approx([MPP, MPP], rel=5e-4)
        assert sorted(one.per_px for one in found) == pytest.approx([1 / 400, 1 / 300], rel=5e-4)


def test_a_side_counts_by_its_pixels_and_by_its_last_digit() -> None:
    ink = _sheet((50, 50, 450, 350))
    texts = [_text("4.0 x 3.0", 250, 200)]
    filled = _read(texts, [_box(50, 50, 450, 350)], ink)
    outlined = _read(texts, [_box(50, 50, 450, 350)], 0.0 * ink)
    for found, error in ((filled, 0.4), (outlined, 1.5)):
        expected = [
            math.sqrt((error / side) ** 2 + (0.1 / (side * MPP)) ** 2 / 12.0 + 0.002**2)
            for side in (400, 300)
        ]
        assert [one.sigma for one in found] == pytest.approx(expected, rel=1e-3)


def test_an_area_is_that_of_the_room_between_its_faces() -> None:
    ink = _sheet((50, 50, 450, 350))
    outline = _box(50, 50, 448, 349)
    (one,) = _read([_text("12.0 m²", 250, 200)], [outline], ink)
    assert math.exp(one.log_mpp) == pytest.approx(MPP, rel=5e-4)
    parts = [_text("6.0 m²", 150, 200), _text("6.0 m²", 350, 200)]
    assert _read(parts, [outline], ink) == []


def test_rooms_that_run_together_are_measured_by_the_paper_around_their_texts() -> None:
    """The wall between two rooms was missed: there is one outline of both."""
    ink = _sheet((50, 50, 450, 350), (462, 50, 712, 350))
    texts = [_text("4.00 x 3.00", 250, 200), _text("2.50 x 3.00", 587, 200)]
    found = _read(texts, [_box(50, 50, 712, 350)], ink)
    assert _scales(found) == pytest.approx([MPP] * 4, rel=2e-3)
    assert _read(texts, [], ink) == found


def test_what_does_not_fit_the_scale_says_nothing() -> None:
    ink = _sheet((50, 50, 450, 350))
    texts = [_text("8.00 x 6.00", 250, 200), _text("hall", 250, 250)]
    assert _read(texts, [_box(50, 50, 450, 350)], ink) == []
