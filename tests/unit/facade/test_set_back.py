"""A storey behind a long balcony at the eaves, told from dormers that stand on them."""

from __future__ import annotations

import pytest

from veduta.facade.eyes import SeenElement
from veduta.facade.floors import Floors
from veduta.facade.seen_rows import WindowRow
from veduta.facade.set_back import with_set_back

WIDTH = 300
FLOORS = Floors([200, 300, 400], 100.0, 0.0, {}, 0)
BALCONY = SeenElement("balcony", 10, 160, 290, 205, 0.9)


def rows_with(*sills: float) -> list[WindowRow]:
    """Rows of four windows at these heights, above two below the eaves."""
    above = [WindowRow((0, 1, 2, 3), sill - 40, sill) for sill in sills]
    return [*above, *(WindowRow((4, 5, 6, 7), y, y + 50) for y in (220, 320))]


def test_a_row_far_above_a_long_balcony_has_a_storey_below_it() -> None:
    found = with_set_back(FLOORS, rows_with(120), [BALCONY], WIDTH)
    assert found.boundaries == [120, 200, 300, 400]
    partly_hidden = with_set_back(FLOORS, rows_with(110, 170), [BALCONY], WIDTH)
    assert partly_hidden.boundaries == [110, 200, 300, 400]


@pytest.mark.parametrize("sills", [(192,), (100, 192), (40,), ()])
def test_dormers_at_the_eaves_are_in_the_roof(sills: tuple[float, ...]) -> None:
    assert with_set_back(FLOORS, rows_with(*sills), [BALCONY], WIDTH) is FLOORS


def test_without_a_balcony_along_the_eaves_there_is_no_such_storey() -> None:
    short = SeenElement("balcony", 10, 160, 90, 205, 0.9)
    low = SeenElement("balcony", 10, 250, 290, 300, 0.9)
    for balconies in ([], [short], [low]):
        assert with_set_back(FLOORS, rows_with(120), balconies, WIDTH) is FLOORS
