"""White dots in ink: rows of them in walls of concrete are filled, rooms and gaps are not."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from veduta.plan.clean.ink import marks, without_pinholes


def dotted(dot_px: int) -> NDArray[np.float32]:
    """A wall of 11 px with a row of dots in it, above a room drawn by lines of 4 px."""
    ink = np.zeros((160, 200), np.float32)
    ink[20:31, 20:180] = 1
    for x in range(24, 170, 8):
        ink[25 : 25 + dot_px, x : x + dot_px] = 0
    for rows, columns in (((60, 64), (40, 120)), ((110, 114), (40, 120))):
        ink[slice(*rows), slice(*columns)] = 1
    ink[60:114, 40:44] = 1
    ink[60:114, 116:120] = 1
    ink[130:134, 20:180] = 1
    return ink


def test_dots_in_a_wall_are_filled_with_their_pale_edges() -> None:
    ink = dotted(3)
    ink[24, 20:180] = 0.6
    filled = without_pinholes(ink, marks(ink, 4.0))
    assert (filled[25:28, 22:178] == 1).all()
    # Half of the dots' surroundings were pale; beside the dots they are no more.
    assert (filled[24, 22:172] == 1).mean() > 0.7


def test_rooms_and_paper_stay() -> None:
    ink = dotted(3)
    filled = without_pinholes(ink, marks(ink, 4.0))
    outside = np.ones_like(ink, dtype=bool)
    outside[20:31] = False
    assert (filled[outside] == ink[outside]).all()


def test_holes_larger_than_the_pen_stay() -> None:
    ink = dotted(6)
    assert (without_pinholes(ink, marks(ink, 4.0)) == ink).all()


def test_a_sheet_without_holes_is_the_same() -> None:
    ink = np.zeros((50, 50), np.float32)
    ink[10:14, 5:45] = 1
    assert without_pinholes(ink, marks(ink, 4.0)) is ink
