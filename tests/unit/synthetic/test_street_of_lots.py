"""The lots of a synthetic street: on both sides, wall to wall, fronts at the street."""

from __future__ import annotations

import numpy as np
import pytest

from veduta.synthetic.lots import STREET_M, street_of_lots


@pytest.mark.parametrize("seed", range(4))
def test_lots_line_the_street_and_do_not_overlap(seed: int) -> None:
    street = street_of_lots(9, seed)
    assert len(set(street.names)) == 9
    ends: dict[float, list[tuple[float, float]]] = {0.0: [], STREET_M: []}
    for outline in street.outlines_m:
        x, y = outline.T
        assert 0.5 * (x @ np.roll(y, -1) - y @ np.roll(x, -1)) > 100.0
        front = float(y[0])
        assert y[0] == y[1]
        away = y[2:] - front
        assert (away > 0).all() if front == STREET_M else (away < 0).all()
        ends[front].append((float(x.min()), float(x.max())))
    for row in ends.values():
        for (_, right), (left, _) in zip(row, row[1:], strict=False):
            assert left == pytest.approx(right)


def test_a_seed_gives_one_street() -> None:
    first, again, other = (street_of_lots(5, seed).outlines_m for seed in (1, 1, 2))
    assert np.array_equal(np.concatenate(first), np.concatenate(again))
    assert not np.array_equal(np.concatenate(first), np.concatenate(other))
