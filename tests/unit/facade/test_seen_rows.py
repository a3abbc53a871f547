"""Rows and floors from windows that stand at known places."""

from __future__ import annotations

import numpy as np
import pytest

from veduta.facade.eyes import SeenElement
from veduta.facade.floors import Floors
from veduta.facade.seen_boxes import boxes_of, columns_of, floor_at, in_crop, on_their_floors
from veduta.facade.seen_foot import is_too_deep, without_strip
from veduta.facade.seen_rows import (
    RowParameters,
    agrees,
    are_sure,
    floors_of_rows,
    is_even,
    odd_row,
    window_rows,
    without_cellar,
    without_roof,
)

PARAMETERS = RowParameters()


def grid(
    tops: list[float], lefts: list[float], width: float = 20, height: float = 40
) -> np.ndarray:
    """Boxes (n, 4) of windows in rows and columns, mixed up."""
    boxes = [(x, y, x + width, y + height) for y in tops for x in lefts]
    return np.random.default_rng(1).permutation(np.array(boxes, np.float64))


def test_rows_are_those_that_were_built() -> None:
    rows = window_rows(grid([50, 150, 250], [10, 60, 110, 160]), PARAMETERS)
    assert [(r.top, r.bottom, len(r.members)) for r in rows] == [
        (50, 90, 4),
        (150, 190, 4),
        (250, 290, 4),
    ]
    assert is_even(rows, None, PARAMETERS)


def test_a_lone_window_between_rows_is_no_row() -> None:
    boxes = np.vstack([grid([50, 150], [10, 40, 70, 100, 130, 160]), [[30, 105, 45, 125]]])
    assert len(window_rows(boxes, PARAMETERS)) == 2


def test_floors_part_the_rows_and_the_lowest_row_may_be_the_ground_floor() -> None:
    rows = window_rows(grid([50, 150, 250], [10, 60, 110]), PARAMETERS)
    shops_below = floors_of_rows(rows, None, 0.0, 400, PARAMETERS)
    assert shops_below is not None
    assert len(shops_below.boundaries) == 4
    assert agrees(shops_below, rows, PARAMETERS)
    own = floors_of_rows(rows, None, 0.0, 330, PARAMETERS)
    assert own is not None
    assert len(own.boundaries) == 3
    assert 190 < own.boundaries[-1] < 250


def test_one_row_gives_no_floors_and_uneven_rows_are_told() -> None:
    assert (
        floors_of_rows(window_rows(grid([50], [10, 60]), PARAMETERS), None, 0, 300, PARAMETERS)
        is None
    )
    rows = window_rows(grid([50, 100, 250], [10, 60]), PARAMETERS)
    assert not is_even(rows, None, PARAMETERS)
    assert is_even(rows, 95.0, PARAMETERS), "what is in the roof says nothing of the storeys"


def test_low_windows_close_below_a_row_are_those_of_a_cellar() -> None:
    above = grid([50, 150, 250], [10, 60, 110])
    cellar = grid([318], [10, 60, 110], height=15)
    every = window_rows(np.vstack([above, cellar]), PARAMETERS)
    rows = without_cellar(every, PARAMETERS)
    assert [r.top for r in rows] == [50, 150, 250]
    floors = floors_of_rows(rows, None, 0.0, 375, PARAMETERS, has_cellar=True)
    assert floors is not None
    assert len(floors.boundaries) == 3, "the row above the cellar is the ground floor's"
    whole = window_rows(grid([50, 150, 250, 350], [10, 60, 110]), PARAMETERS)
    assert without_cellar(whole, PARAMETERS) == whole, "as high as the others"
    far = window_rows(np.vstack([above, grid([370], [10, 60, 110], height=15)]), PARAMETERS)
    assert without_cellar(far, PARAMETERS) == far, "a storey below the others"


def test_floors_agree_with_no_row_that_a_border_runs_through() -> None:
    rows = window_rows(grid([50, 150, 250], [10, 60, 110]), PARAMETERS)
    assert agrees(Floors([30, 130, 230], 100.0, 0.0, {}, 0), rows, PARAMETERS)
    assert not agrees(Floors([30, 130, 268], 100.0, 0.0, {}, 0), rows, PARAMETERS)


def test_a_ground_floor_has_no_two_rows_a_storey_apart() -> None:
    rows = window_rows(grid([50, 150, 250, 350], [10, 60, 110]), PARAMETERS)
    assert not agrees(Floors([30, 130, 230], 100.0, 0.0, {}, 0), rows, PARAMETERS)
    assert agrees(Floors([30, 130, 230, 330], 100.0, 0.0, {}, 0), rows, PARAMETERS)


def test_wall_above_the_eaves_belongs_to_the_upper_floor() -> None:
    rows = window_rows(grid([150, 250], [10, 60]), PARAMETERS)
    floors = Floors([140, 240, 320], 100.0, 0.0, {}, 0)
    raised = without_roof(floors, 90, rows)
    assert raised is not None
    assert raised.boundaries == [90, 240, 320]
    above = window_rows(grid([50, 150, 250], [10, 60]), PARAMETERS)
    assert without_roof(floors, 20, above) is None


def test_most_windows_must_be_sure() -> None:
    sure = [SeenElement("window", 0, 0, 9, 9, 0.9)] * 3
    assert are_sure(sure, PARAMETERS)
    assert not are_sure(sure[:2], PARAMETERS)
    assert not are_sure([*sure, *[SeenElement("window", 0, 0, 9, 9, 0.4)] * 4], PARAMETERS)


@pytest.mark.parametrize(("y", "floor"), [(10, None), (120, 2), (200, 1), (350, 0)])
def test_the_floor_at_a_height(y: float, floor: int | None) -> None:
    assert floor_at(y, [100, 180, 300]) == floor


def test_boxes_get_floors_and_columns() -> None:
    windows = [
        SeenElement("window", x, y, x + 20, y + 40, 0.9) for y in (110, 210) for x in (12, 61, 108)
    ]
    shop = SeenElement("shop", 5, 310, 130, 390, 0.7)
    columns = columns_of(windows)
    boxes = boxes_of([*windows, shop], [100, 200, 300], columns)
    assert next(b.kind for b in boxes) == "shop", "painted first"
    assert [(b.floor, b.column) for b in boxes[1:]] == [(f, c) for f in (2, 1) for c in (0, 1, 2)]


def test_what_lies_beside_the_crop_is_left_out() -> None:
    inside, outside = (SeenElement("window", x, 20, x + 40, 80, 0.9) for x in (200, 20))
    (kept,) = in_crop([inside, outside], 0.5, 50, (100, 100))
    assert (kept.x0, kept.y0, kept.x1, kept.y1) == (50, 10, 70, 40)


def test_a_row_of_reliefs_between_storeys_is_the_odd_one() -> None:
    rows = window_rows(grid([50, 150, 225, 250, 350], [10, 60, 110], height=20), PARAMETERS)
    assert not is_even(rows, None, PARAMETERS)
    doubtful = set(rows[2].members)
    scores = [0.4 if i in doubtful else 0.8 for i in range(15)]
    assert odd_row(rows, scores, None, PARAMETERS) == rows[2]
    assert odd_row(rows, [0.8] * 15, None, PARAMETERS) is None, "sure windows are windows"
    even = [rows[0], rows[1], rows[3], rows[4]]
    assert odd_row(even, [0.4] * 15, None, PARAMETERS) is None, "even rows have none"


def test_a_strip_below_the_last_floor_is_no_storey_unless_it_has_a_door() -> None:
    floors = Floors([0, 100, 200, 300], 100.0, 0.0, {}, 0)
    sign = SeenElement("shop", 20, 310, 60, 330, 0.6)
    found, none = without_strip(floors, [sign], 350)
    assert (found.boundaries, none) == ([0, 100, 200], (sign,))
    door = SeenElement("door", 20, 305, 40, 350, 0.6)
    assert without_strip(floors, [sign, door], 350) == (floors, ())
    assert without_strip(floors, [sign], 390) == (floors, ()), "a low ground floor is one"
    lowest = Floors([0, 100], 100.0, 0.0, {}, 0)
    assert without_strip(lowest, [], 130) == (lowest, ()), "one floor is left at least"


def test_a_foot_of_many_storeys_is_too_deep() -> None:
    floors = Floors([0, 100, 200], 100.0, 0.0, {}, 0)
    assert is_too_deep(floors, 700)
    assert not is_too_deep(floors, 450)
    assert not is_too_deep(Floors([0], 100.0, 0.0, {}, 0), 700), "a plane has no foot"


def test_a_shop_above_windows_of_the_ground_floor_is_their_sign() -> None:
    sign = SeenElement("shop", 0, 203, 100, 225, 0.7)
    panes = [SeenElement("window", x, 228, x + 25, 280, 0.8) for x in (5, 40, 70)]
    shop = SeenElement("shop", 110, 215, 200, 295, 0.7)
    kept = on_their_floors([sign, *panes, shop], [0, 100, 200])
    assert kept == [*panes, shop]
    awning = SeenElement("shop", 0, 203, 100, 225, 0.7)
    assert awning in on_their_floors([awning, panes[0], shop], [0, 100, 200])
    low = SeenElement("shop", 0, 210, 100, 225, 0.7)
    assert low not in on_their_floors([low, panes[0], shop], [0, 100, 200])
