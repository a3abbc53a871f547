"""Text on pictures: each letter of the languages of plans is drawn, where it is asked for."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from veduta.imaging.lettering import text_width, write


def written(text: str, **how: object) -> NDArray[np.bool_]:
    """(80, 300) where dark letters are, about the middle or from (100, 20) on."""
    image = Image.new("RGB", (300, 80), "white")
    at = (150.0, 40.0) if how.get("anchor", "middle") == "middle" else (100.0, 20.0)
    write(ImageDraw.Draw(image), at, text, 24, (0, 0, 0), **how)  # type: ignore[arg-type]
    return np.asarray(image.convert("L")) < 128


@pytest.mark.parametrize("letter", "éèêàçãõáíóúâñäöüßåÄÖÜÉ²±°")
def test_letters_with_accents_are_none_of_the_box_for_what_is_missing(letter: str) -> None:
    shape = written(letter)
    assert shape.any()
    assert (shape != written("\ue000")).any()  # a private letter, which no font has


def test_it_stands_about_its_place() -> None:
    rows, columns = np.nonzero(written("HHH"))
    assert abs((columns.min() + columns.max()) / 2 - 150) < 2
    assert abs((rows.min() + rows.max()) / 2 - 40) < 3
    assert np.ptp(columns) == pytest.approx(text_width("HHH", 24), abs=6)


def test_it_begins_at_its_place() -> None:
    rows, columns = np.nonzero(written("HHH", anchor="left"))
    assert 98 <= columns.min() <= 105
    assert 20 <= rows.min() <= 30


def test_a_rim_covers_what_is_below() -> None:
    image = Image.new("RGB", (300, 80), (0, 0, 0))
    write(ImageDraw.Draw(image), (150.0, 40.0), "I", 24, (0, 0, 0), halo=(255, 255, 255))
    assert (np.asarray(image) > 200).any()


def test_no_text_is_nothing() -> None:
    assert not written("").any()
