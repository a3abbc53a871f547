"""Junctions that come to lie at one place are one: no wall has no length."""

from __future__ import annotations

import numpy as np

from veduta.plan.walls.graph import _at_one_place


def test_points_of_junctions_at_one_place_get_the_number_of_the_first() -> None:
    nodes = np.array([[0.0, 0.0], [50.0, 0.0], [50.2, 0.1], [50.0, 30.0], [0.1, 0.2]])
    assert _at_one_place(nodes, [0, 1, 2, 3, 4, 2]) == [0, 1, 1, 3, 0, 1]


def test_without_junctions_there_is_nothing_to_join() -> None:
    assert _at_one_place(np.zeros((0, 2)), []) == []
