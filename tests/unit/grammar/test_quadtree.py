"""Lots in squares: all of them, once, so many at most, neighbours together."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from veduta.grammar.quadtree import squares

Points = st.lists(st.tuples(st.floats(-1e4, 1e4), st.floats(-1e4, 1e4)), min_size=1, max_size=200)


@given(Points, st.integers(1, 20))
def test_every_lot_is_in_one_square(points: list[tuple[float, float]], most: int) -> None:
    found = squares(np.array(points), most)
    assert all(1 <= len(rows) <= most for rows in found)
    assert sorted(np.concatenate(found).tolist()) == list(range(len(points)))


def test_lots_on_each_other_end() -> None:
    assert [len(rows) for rows in squares(np.zeros((10, 2)), 4)] == [4, 4, 2]


def test_squares_do_not_overlap() -> None:
    points = np.random.default_rng(5).uniform(0, 100, (500, 2))
    boxes = [(points[rows].min(axis=0), points[rows].max(axis=0)) for rows in squares(points, 16)]
    for number, (low, high) in enumerate(boxes):
        for other_low, other_high in boxes[number + 1 :]:
            assert (high < other_low).any() or (other_high < low).any()
