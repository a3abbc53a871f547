"""Whether wall parts the windows that stand one above another."""

from __future__ import annotations

import numpy as np
import pytest

from veduta.facade.appearance import Wall
from veduta.facade.between import Between, are_floors, doubt_unparted, look_between
from veduta.facade.boxes import Box
from veduta.facade.floors import Floors

FLOORS = Floors([20, 60, 100, 140], 40.0, -0.3, {}, 100)
WIDTH = 120
TOPS = {3: 26, 2: 66, 1: 106}


def windows(railing: int = 0) -> list[Box]:
    """A window in each of two columns of three floors, 20 px high, a railing under each."""
    found = []
    for floor, top in TOPS.items():
        for column, x in enumerate((20, 70)):
            found.append(Box("window", x, top, 20, 20, floor, column, 0.9))
            if railing:
                found.append(Box("balcony", x - 4, top + 20, 28, railing, floor, None, 0.8))
    return found


def wall(boxes: list[Box], between: float) -> Wall:
    """Windows and railings 40 from the wall's colour, and what is between them `between`."""
    unlike = np.full((FLOORS.ground_top - FLOORS.eaves, WIDTH), between, np.float32)
    for box in boxes:
        unlike[box.part(FLOORS.eaves)] = 40.0
    return Wall(unlike, np.zeros((*unlike.shape, 3), np.float32))


@pytest.mark.parametrize(("between", "parted"), [(0.0, True), (31.0, True), (33.0, False)])
@pytest.mark.parametrize("railing", [0, 12])
def test_wall_between_windows(between: float, parted: bool, railing: int) -> None:
    boxes = windows(railing)
    pairs = look_between(boxes, wall(boxes, between), FLOORS)
    names = sorted((p.upper.floor, p.lower.floor, p.upper.column) for p in pairs)
    assert names == [(2, 1, 0), (2, 1, 1), (3, 2, 0), (3, 2, 1)]
    assert all(p.upper.column == p.lower.column for p in pairs)
    assert [p.unlike for p in pairs] == pytest.approx([between / 40] * 4)
    assert are_floors(pairs, FLOORS) == parted
    doubted = doubt_unparted(boxes, pairs, FLOORS)
    if parted:
        assert doubted == boxes
    else:
        assert all(box.score < 0.5 for box in doubted)


def test_floors_that_are_very_alike_are_floors_whatever_is_between() -> None:
    alike = Floors(FLOORS.boundaries, 40.0, -0.5, {}, 100)
    pairs = look_between(windows(), wall(windows(), 40.0), alike)
    assert not are_floors(pairs, FLOORS)
    assert are_floors(pairs, alike)
    # The windows still are no better parted for that.
    doubted = doubt_unparted([pair.upper for pair in pairs], pairs, alike)
    assert all(box.score < 0.5 for box in doubted)


def test_windows_that_touch_have_no_wall_between() -> None:
    boxes = [Box("window", 20, 20, 20, 40, 3, 0, 0.9), Box("window", 20, 60, 20, 40, 2, 0, 0.9)]
    assert [p.unlike for p in look_between(boxes, wall(boxes, 0.0), FLOORS)] == [1.0]


def test_only_windows_that_nothing_parts_are_in_doubt() -> None:
    boxes = windows()
    high, middle, low = (box for box in boxes if box.column == 0)
    other = [box for box in boxes if box.column == 1]
    pairs = [Between(high, middle, 0.1), Between(middle, low, 0.9)]
    pairs += [Between(a, b, 0.2) for a, b in zip(other, other[1:], strict=False)]
    doubted = {(b.column, b.floor): b.score for b in doubt_unparted(boxes, pairs, FLOORS)}
    assert doubted[0, 1] < 0.5
    del doubted[0, 1]
    assert set(doubted.values()) == {0.9}


def test_a_single_row_of_windows_is_not_doubted_for_this() -> None:
    boxes = [box for box in windows() if box.floor == 1]
    pairs = look_between(boxes, wall(boxes, 40.0), FLOORS)
    assert pairs == []
    assert are_floors(pairs, FLOORS)
    assert doubt_unparted(boxes, pairs, FLOORS) == boxes
