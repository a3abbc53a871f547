"""The boxes of balconies end where the bars of their railings do."""

from __future__ import annotations

import numpy as np
import pytest

from veduta.facade.evidence import Evidence, gather
from veduta.facade.eyes import Seen, SeenElement
from veduta.facade.railing_boxes import on_railings

SIZE = (120, 200)
RAILING = slice(80, 110)
"""Its rows; below it lies a slab of 10."""


def evidence_of(pixels: np.ndarray) -> Evidence:
    return gather(pixels, np.ones(pixels.shape[:2], np.bool_))


def seen_where(kind: str, size: tuple[int, int], where: tuple[slice, slice]) -> Seen:
    """A picture that is of a kind there, and of wall elsewhere."""
    classes = np.zeros((2, *size), np.float32)
    classes[0][where] = 1.0
    classes[1] = 1.0 - classes[0]
    high, wide = size
    none = np.zeros((1, high // 4, wide // 4), np.float32)
    borders = np.ones((4, *none.shape[1:]), np.float32)
    return Seen((kind, "wall"), (kind,), classes, none, borders, 1.0, 1.0, wide, high)


def picture() -> np.ndarray:
    """Bars on a pale wall, and a plain slab below them."""
    pixels = np.full((*SIZE, 3), 200, np.uint8)
    pixels[RAILING, 20:180:4] = 30
    pixels[RAILING, 21:180:4] = 30
    pixels[110:120, 20:180] = 180
    return pixels


def railing(box: tuple[float, float], chance: slice) -> SeenElement:
    seen = seen_where("balcony", SIZE, (chance, slice(20, 180)))
    given = SeenElement("balcony", 20, box[0], 180, box[1], 0.9)
    window = SeenElement("window", 60, 30, 80, 80, 0.9)
    found = on_railings([given, window], seen, evidence_of(picture()))
    assert found[1] == window
    return found[0]


def test_a_box_that_has_the_slab_ends_with_the_bars() -> None:
    found = railing((78.0, 120.0), slice(78, 120))
    assert found.y0 == pytest.approx(78, abs=1)
    assert found.y1 == pytest.approx(110, abs=2)
    assert (found.x0, found.x1) == (20, 180)


def test_consoles_below_the_slab_are_no_bars_of_the_railing() -> None:
    """They have upright edges as strong as the bars', and more of them."""
    pixels = np.full((*SIZE, 3), 200, np.uint8)
    pixels[60:80, 20:180:4] = 30
    pixels[60:80, 21:180:4] = 30
    pixels[92:112, 20:180:3] = 20
    given = SeenElement("balcony", 20, 58, 180, 112, 0.9)
    seen = seen_where("balcony", SIZE, (slice(58, 112), slice(20, 180)))
    (found,) = on_railings([given], seen, evidence_of(pixels))
    assert found.y1 == pytest.approx(80, abs=3)


def test_a_box_that_begins_too_high_begins_with_its_pixels() -> None:
    found = railing((68.0, 110.0), slice(80, 110))
    assert found.y0 == pytest.approx(80, abs=1)
    assert found.y1 == pytest.approx(110, abs=2)


def test_a_box_without_pixels_of_a_balcony_keeps_its_top() -> None:
    found = railing((78.0, 110.0), slice(0, 1))
    assert found.y0 == 78
    assert found.y1 == pytest.approx(110, abs=2)


def test_a_plain_parapet_stays_as_it_was_seen() -> None:
    plain = evidence_of(np.full((*SIZE, 3), 200, np.uint8))
    seen = seen_where("balcony", SIZE, (slice(80, 112), slice(20, 180)))
    given = SeenElement("balcony", 20, 80, 180, 112, 0.9)
    assert on_railings([given], seen, plain) == [given]
