"""Rows, sides and railings of floors that the test draws as log-odds."""

from __future__ import annotations

import itertools

import numpy as np
from numpy.typing import NDArray

from veduta.facade.appearance import Scores
from veduta.facade.columns import Columns
from veduta.facade.evidence import Evidence
from veduta.facade.floors import Floors
from veduta.facade.opening_rows import FloorRows, read_floors, window_rows
from veduta.facade.openings import find_openings, score
from veduta.facade.railings import find_railings
from veduta.facade.window_sides import refine_sides

STOREY, WIDTH, FLOORS = 60, 200, 3
STRIPES = [(20, 24), (80, 24), (140, 24)]
TOP, BREAK, FOOT = 12, 36, 52

Field = NDArray[np.float32]


def field(level: float = -1.0, height: int = STOREY * FLOORS) -> Field:
    return np.full((height, WIDTH), level, np.float32)


def evidence_of(height: int) -> Evidence:
    flat = np.zeros((height, WIDTH), np.float32)
    return Evidence(1.0, np.zeros((height, WIDTH, 3), np.float32), flat, flat, flat == 0)


def floors_of() -> Floors:
    return Floors([STOREY * i for i in range(FLOORS + 1)], float(STOREY), 0.0, {}, 0)


def grid(blank: tuple[int, int] | None = None, railings: bool = True) -> Scores:
    """Windows in every cell but `blank` (floor, column), each above a railing."""
    window, railing = field(), field()
    for floor, (column, (x, w)) in itertools.product(range(FLOORS), enumerate(STRIPES)):
        if (floor, column) == blank:
            continue
        y = STOREY * floor
        foot = BREAK if railings else FOOT
        window[y + TOP : y + foot, x : x + w] = 1
        if railings:
            railing[y + BREAK : y + FOOT, x : x + w] = 1
    return Scores(window, railing, window)


def floor_of(railing: Field, cells: list[tuple[int, int, int]]) -> FloorRows:
    return FloorRows(0, cells[0], cells, field(height=STOREY), railing)


def test_rows_are_where_windows_and_railings_begin_and_end() -> None:
    read = read_floors(evidence_of(STOREY * FLOORS), floors_of(), STRIPES, grid())
    assert [f.top for f in read] == [0, STOREY, 2 * STOREY]
    for floor in read:
        assert floor.cells == [(TOP, BREAK, FOOT)] * len(STRIPES)


def test_without_railings_windows_reach_their_sills() -> None:
    read = read_floors(evidence_of(STOREY * FLOORS), floors_of(), STRIPES, grid(railings=False))
    assert all(f.cells == [(TOP, FOOT, FOOT)] * len(STRIPES) for f in read)


def test_one_cell_may_differ_from_its_floor() -> None:
    scores = grid()
    x, w = STRIPES[1]
    scores.railing[BREAK:FOOT, x : x + w] = -1
    scores.window[BREAK:FOOT, x : x + w] = 1
    first = read_floors(evidence_of(STOREY * FLOORS), floors_of(), STRIPES, scores)[0]
    assert first.cells == [(TOP, BREAK, FOOT), (TOP, FOOT, FOOT), (TOP, BREAK, FOOT)]


def test_window_rows_agree_with_trying_all() -> None:
    rng = np.random.default_rng(3)
    window = rng.normal(size=(40, 30)).astype(np.float32)
    inside = np.zeros(30, bool)
    inside[5:12] = True
    t, b = window_rows(window, np.zeros_like(window), inside, 40.0, (0.2, 0.75))
    sums = {
        (i, j): float(window[i:j, inside].sum())
        for i, j in itertools.combinations(range(41), 2)
        if 8 <= j - i <= 30
    }
    assert (t, b) == max(sums, key=lambda rows: sums[rows])


def test_sides_move_to_the_window() -> None:
    window = field(height=40)
    window[:, 33:51] = 1
    rows = [np.ones(40, bool)]
    assert refine_sides([(28, 27)], window, np.zeros_like(window), rows, 60.0) == [(33, 18)]


def test_sides_do_not_reach_into_the_neighbour() -> None:
    window = field(1.0, height=40)
    stripes = [(20, 20), (43, 20)]
    moved = refine_sides(stripes, window, np.zeros_like(window), [np.ones(40, bool)] * 2, 60.0)
    assert moved == stripes


def test_a_railing_ends_where_it_ends() -> None:
    railing = field(height=STOREY)
    railing[BREAK:FOOT, 16:47] = 1
    cells = [(TOP, BREAK, FOOT), (TOP, FOOT, FOOT), (TOP, FOOT, FOOT)]
    assert find_railings(floor_of(railing, cells), STRIPES, STOREY) == [(16, 47, BREAK, FOOT)]


def test_a_railing_runs_on_through_gaps() -> None:
    railing = field(height=STOREY)
    railing[BREAK:FOOT, 74:170] = 1
    railing[BREAK:FOOT, 18:46] = 1
    found = find_railings(floor_of(railing, [(TOP, BREAK, FOOT)] * 3), STRIPES, STOREY)
    assert found == [(18, 46, BREAK, FOOT), (74, 170, BREAK, FOOT)]


def test_railings_at_different_rows_part_in_the_gap() -> None:
    railing = field(1.0, height=STOREY)
    cells = [(TOP, BREAK, FOOT), (TOP, BREAK - 10, FOOT - 10), (TOP, FOOT, FOOT)]
    found = find_railings(floor_of(railing, cells), STRIPES, STOREY)
    assert found == [(0, 62, BREAK, FOOT), (62, 140, BREAK - 10, FOOT - 10)]


def test_blank_cells_hold_no_window() -> None:
    columns = Columns(STRIPES, 0.0, {}, 0)
    scores = grid(blank=(1, 2))
    boxes = find_openings(evidence_of(STOREY * FLOORS), floors_of(), columns, scores, scores)
    windows = {(b.floor, b.column) for b in boxes if b.kind == "window"}
    every = {(f, c) for f in (1, 2, 3) for c in range(3)}
    assert windows == every - {(2, 2)}
    assert all(0.8 < b.score < 1 for b in boxes)


def test_no_stripes_no_openings() -> None:
    columns = Columns([], 0.0, {}, 0)
    evidence = evidence_of(STOREY * FLOORS)
    assert find_openings(evidence, floors_of(), columns, grid(), grid()) == []


def test_score_is_even_where_the_evidence_is() -> None:
    assert score(0.0) == 0.5
    assert score(-1.0) < 0.2 < 0.8 < score(1.0)
