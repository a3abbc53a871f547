"""Windows behind a tree are as those beside them; where nothing hides, nothing is added."""

from __future__ import annotations

import numpy as np
import pytest

from veduta.facade.boxes import Box
from veduta.facade.columns import Columns
from veduta.facade.hidden_windows import HiddenParameters, hidden_windows

FLOORS, STRIPES = 4, [(20, 20), (70, 20), (120, 20)]
COLUMNS = Columns(STRIPES, 0.0, {}, 0)


def _grid(missing: set[tuple[int, int]]) -> list[Box]:
    """Floors of three windows each, without some of them (floor, column)."""
    return [
        Box("window", x, 200 - 40 * floor, wide, 25, floor, column, 0.9)
        for floor in range(1, FLOORS + 1)
        for column, (x, wide) in enumerate(STRIPES)
        if (floor, column) not in missing
    ]


def _tree(*places: tuple[int, int]) -> np.ndarray:
    hidden = np.zeros((240, 160))
    for floor, column in places:
        x, wide = STRIPES[column]
        hidden[195 - 40 * floor : 230 - 40 * floor, x - 5 : x + wide + 5] = 0.9
    return hidden


def test_a_hidden_window_is_as_those_of_its_row_and_column() -> None:
    (found,) = hidden_windows(_grid({(1, 2)}), COLUMNS, FLOORS, _tree((1, 2)))
    assert (found.x, found.y, found.width, found.height) == (120, 160, 20, 25)
    assert (found.floor, found.column, found.is_inferred) == (1, 2, True)
    assert found.score == 1.0


@pytest.mark.parametrize(
    ("missing", "tree"),
    [
        ({(1, 2)}, []),  # a blind part of the wall
        ({(1, 2)}, [(2, 2)]),  # something else is hidden
        ({(1, 2), (2, 2), (3, 2)}, [(1, 2)]),  # a column that is hardly one
        ({(1, 1), (1, 2)}, [(1, 2)]),  # a row that is none
        (set(), [(1, 2)]),
    ],
)
def test_nothing_is_added_without_a_row_a_column_and_a_tree(
    missing: set[tuple[int, int]], tree: list[tuple[int, int]]
) -> None:
    assert hidden_windows(_grid(missing), COLUMNS, FLOORS, _tree(*tree)) == []


def test_what_is_there_already_stays_alone() -> None:
    """A door of the first floor stands where the window would be."""
    door = Box("door", 118, 150, 24, 40, 1, None, 0.9)
    boxes = [*_grid({(1, 2)}), door]
    assert hidden_windows(boxes, COLUMNS, FLOORS, _tree((1, 2))) == []


def test_the_score_is_how_often_the_column_has_one() -> None:
    own = HiddenParameters(share=0.5)
    (found,) = hidden_windows(_grid({(1, 2), (3, 2)}), COLUMNS, FLOORS, _tree((1, 2)), own)
    assert found.score == pytest.approx(2 / 3)
