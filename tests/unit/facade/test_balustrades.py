"""Balustrades: long rails along the eaves that nothing leads out to."""

from __future__ import annotations

import pytest

from veduta.facade.balustrades import with_balustrades
from veduta.facade.boxes import Box

EAVES = 100.0
RAIL = Box("balcony", 10, 70, 280, 30, None, None, 0.7)
WINDOWS = [Box("window", x, 120, 30, 60, 1, k, 0.9) for k, x in enumerate((30, 130, 230))]


def _told(*boxes: Box) -> list[bool]:
    return [box.is_balustrade for box in with_balustrades(boxes, EAVES) if box.kind == "balcony"]


def test_a_long_rail_on_the_eaves_over_the_windows_is_one() -> None:
    assert _told(RAIL, *WINDOWS) == [True]


def test_one_before_dormers_is_a_balcony() -> None:
    assert _told(RAIL, Box("window", 130, 30, 30, 60, None, 0, 0.9)) == [False]


@pytest.mark.parametrize(
    "box",
    [
        Box("balcony", 10, 70, 100, 30, None, None, 0.7),  # short
        Box("balcony", 10, 200, 280, 30, 1, None, 0.7),  # far below the eaves
        Box("balcony", 10, 10, 280, 30, None, None, 0.7),  # far above
    ],
)
def test_others_are_balconies(box: Box) -> None:
    assert _told(box, *WINDOWS) == [False]
