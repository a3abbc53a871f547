"""Several storeys on one sheet, told apart by strips of paper, named and ordered by titles."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.plan.document import Text
from veduta.plan.drawn import Cleaned
from veduta.plan.several_plans import order_note, plans_on, storeys_drawn


def house(ink: NDArray[np.float32], left: int, upper: int, wide: int, high: int) -> None:
    """An outline with a wall across it, and a gap for a door in each."""
    right, lower = left + wide, upper + high
    cv2.rectangle(ink, (left, upper), (right, lower), 1.0, 8)
    cv2.line(ink, (left + wide // 2, upper), (left + wide // 2, lower), 1.0, 6)
    ink[upper + 20 : upper + 50, left + wide // 2 - 8 : left + wide // 2 + 8] = 0.0
    ink[lower - 8 : lower + 8, left + 20 : left + 60] = 0.0


def sheet(*houses: tuple[int, int, int, int], framed: bool = False) -> Cleaned:
    ink = np.zeros((600, 1000), dtype=np.float32)
    for one in houses:
        house(ink, *one)
    if framed:
        cv2.rectangle(ink, (5, 5), (994, 594), 1.0, 2)
    pixels = np.repeat((255 * (1 - ink)).astype(np.uint8)[..., None], 3, axis=2)
    return Cleaned(pixels, ink, np.eye(3), False, 0.0, 2.0)


def written(text: str, x: float, y: float) -> Text:
    box = [(x - 50, y - 8), (x + 50, y - 8), (x + 50, y + 8), (x - 50, y + 8)]
    return Text(text=text, box_px=[(float(a), float(b)) for a, b in box], score=0.98)


TWO = ((60, 60, 400, 400), (490, 100, 380, 360))


def test_titles_make_storeys_of_plans_that_lie_close() -> None:
    texts = [
        written("First Floor", 250, 500),
        written("Bedroom", 150, 200),
        written("Ground Floor", 680, 500),
        written("Kitchen", 560, 200),
    ]
    found = storeys_drawn(sheet(*TWO, framed=True), texts)
    assert [one.title.name for one in found if one.title] == ["Ground Floor", "First Floor"]
    assert [text.text for text in found[0].texts] == ["Ground Floor", "Kitchen"]
    # Each has its own walls and no others.
    assert not found[0].cleaned.ink[20:580, 20:470].any()
    assert not found[1].cleaned.ink[20:580, 480:980].any()
    assert found[0].cleaned.ink[100:460, 490:870].any()
    assert "by their titles" in order_note(found)[0]


def test_plans_without_titles_are_storeys_where_they_are_alike() -> None:
    found = storeys_drawn(sheet(*TWO), [])
    assert len(found) == 2
    assert "order of reading" in order_note(found)[0]
    assert not found[0].cleaned.ink[:, 480:].any()


def test_a_shed_beside_a_house_is_no_storey() -> None:
    assert len(storeys_drawn(sheet(TWO[0], (600, 100, 200, 210)), [])) == 1


def test_a_house_alone_stays_one() -> None:
    whole = sheet(TWO[0])
    (only,) = storeys_drawn(whole, [written("Ground Floor", 250, 500)])
    assert only.cleaned is whole
    assert order_note([only]) == []


def test_a_blank_sheet_has_no_plans() -> None:
    assert plans_on(np.zeros((50, 80), dtype=bool)) == []
