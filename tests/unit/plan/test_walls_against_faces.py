"""Hollow inner walls that stand against the faces of others, which run on behind them."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

from veduta.plan.walls.cells import find_cells
from veduta.plan.walls.outlined import wall_cells

WALL = 12


def _lines(*inner: tuple[int, int, int, int]) -> NDArray[np.bool_]:
    """The outline of a house whose outer walls are WALL px broad, and of rectangles within."""
    page = np.zeros((700, 900), np.uint8)
    cv2.rectangle(page, (100, 100), (800, 600), 1, 2)
    cv2.rectangle(page, (100 + WALL, 100 + WALL), (800 - WALL, 600 - WALL), 1, 2)
    for left, top, right, bottom in inner:
        cv2.rectangle(page, (left, top), (right, bottom), 1, 2)
    return page.astype(np.bool_)


def _is_wall(lines: NDArray[np.bool_], x: int, y: int) -> bool:
    cells = find_cells(lines, 2.0)
    return bool(wall_cells(cells)[cells.labels[y, x]])


def test_a_wall_stands_against_the_faces_of_two() -> None:
    lines = _lines((400, 100 + WALL, 400 + WALL, 600 - WALL))
    assert _is_wall(lines, 400 + WALL // 2, 350)
    assert not _is_wall(lines, 250, 350)


def test_a_wall_stands_against_one_that_does() -> None:
    """The second parts the right half: it is one once the first is."""
    lines = _lines(
        (400, 100 + WALL, 400 + WALL, 600 - WALL), (400 + WALL, 300, 800 - WALL, 300 + WALL)
    )
    assert _is_wall(lines, 550, 300 + WALL // 2)


@pytest.mark.parametrize(
    "strip",
    [
        (400, 250, 400 + WALL, 450),  # stands free: a board
        (400, 100 + WALL, 400 + 3 * WALL, 600 - WALL),  # a long table
        (400, 100 + WALL, 400 + WALL, 180),  # a short piece: a radiator
        (100 + WALL, 100 + WALL, 100 + 2 * WALL, 600 - WALL),  # shelves along a wall
    ],
)
def test_other_strips_are_no_walls(strip: tuple[int, int, int, int]) -> None:
    middle = ((strip[0] + strip[2]) // 2, (strip[1] + strip[3]) // 2)
    assert not _is_wall(_lines(strip), *middle)
