"""Writing that the network does not know never turns a sheet or mirrors it."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from veduta.plan.text import orientation
from veduta.plan.text.engine import Line
from veduta.plan.text.orientation import find_position, is_well_read

SHEET = np.full((200, 300, 3), 255, dtype=np.uint8)
REGIONS = np.array([[[10, y], [90, y], [90, y + 15], [10, y + 15]] for y in (10, 50, 90)], float)


def _says(monkeypatch: pytest.MonkeyPatch, upright: str, mirror: str, score: float) -> None:
    """What all regions say: one thing as the sheet lies, another in a mirror."""

    def read(
        pixels: NDArray[np.uint8], quad: NDArray[np.float64], mirrored: bool, turns: int
    ) -> Line:
        return Line("" if turns else mirror if mirrored else upright, score)

    monkeypatch.setattr(orientation, "_read_at", read)


@pytest.mark.parametrize(("upright", "mirror"), [("Tx 305", "GOEMICL"), ("TIR", "euENct")])
def test_letters_of_an_unread_script_leave_the_sheet_as_it_lies(
    monkeypatch: pytest.MonkeyPatch, upright: str, mirror: str
) -> None:
    _says(monkeypatch, upright, mirror, 0.62)
    assert find_position(SHEET, REGIONS).is_upright


def test_words_that_read_well_in_a_mirror_do_mirror_it(monkeypatch: pytest.MonkeyPatch) -> None:
    _says(monkeypatch, "nehctiK", "Kitchen", 0.97)
    assert find_position(SHEET, REGIONS).mirrored


def test_what_is_well_read_is_a_word_a_size_or_sure_letters() -> None:
    assert is_well_read(Line("Kitchen", 0.7))
    assert is_well_read(Line("4.94 x 3.06", 0.7))
    assert is_well_read(Line("Przedpokój", 0.95))
    assert not is_well_read(Line("Przedpokój", 0.6))
    assert not is_well_read(Line("HOHO", 0.99))
    assert not is_well_read(Line("mr", 0.99))
