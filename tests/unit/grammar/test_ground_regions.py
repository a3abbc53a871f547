"""The ground of a town in regions: that of the town at once, wherever triangles have no choice."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from numpy.typing import NDArray

from veduta.grammar import ground_regions
from veduta.grammar.ground import Ground, height_at
from veduta.grammar.ground_regions import grounds_of
from veduta.grammar.lot import Lot
from veduta.grammar.squares import Squares, squares_of


def town(side: int) -> Squares:
    """Lots on a slope, none of their corners on one circle."""
    rng = np.random.default_rng(5)
    lots = []
    for number in range(side * side):
        x, y = number % side * 20.0, number // side * 20.0
        corners = np.array([[0, 0], [12, 0], [12, 11], [0, 11]]) + rng.uniform(-2, 2, (4, 2))
        lots.append(Lot(str(number), str(number), (corners,), (x, y, 0.1 * x + rng.uniform(0, 1))))
    return squares_of(lots, ask_beside=False, most=30)


def triangles(grounds: dict[str, Ground]) -> dict[tuple[tuple[float, ...], ...], str]:
    """The block of each triangle within the town, by its corners."""
    found = {}
    for name, ground in grounds.items():
        for corners in ground.points_m[ground.triangles].round(6).tolist():
            found[tuple(sorted(tuple(corner) for corner in corners))] = name
    return found


def area(grounds: dict[str, Ground]) -> float:
    """Of all triangles, seen from above."""

    def of(points: NDArray[np.float64]) -> float:
        (ux, uy), (vx, vy) = (points[:, 1] - points[:, 0]).T, (points[:, 2] - points[:, 0]).T
        return float(np.abs(ux * vy - uy * vx).sum() / 2)

    return sum(of(ground.points_m[ground.triangles][:, :, :2]) for ground in grounds.values())


def test_regions_have_the_triangles_of_all_at_once() -> None:
    squares = town(16)
    whole, parts = grounds_of(squares), grounds_of(squares, most=60)
    assert set(parts) == set(whole) == {square.name for square in squares.every}
    one, other = triangles(whole), triangles(parts)
    inner = {
        corners for corners in one if all(20 < x < 290 and 20 < y < 290 for x, y, _ in corners)
    }
    assert len(inner) > 1200
    assert all(other.get(corners) == one[corners] for corners in inner)
    assert abs(area(parts) - area(whole)) < 0.03 * area(whole)
    steps = np.arange(-100.0, 430.0, 23.0).tolist()
    for x, y in itertools.product(steps, steps):
        if height_at(whole.values(), x, y) is not None:
            assert height_at(parts.values(), x, y) is not None, (x, y)


def test_a_region_looks_at_few_others(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ground_regions, "AROUND_M", 25.0)
    squares = town(16)
    whole = ground_regions._town(squares)
    for region in ground_regions._regions(squares.every, 60):
        own = sum(len(square.rows) for square in region)
        every = ground_regions._with_others(whole, region)
        assert own <= 60
        assert own < sum(len(square.rows) for square in every) <= 4 * own


def test_a_level_town_needs_none() -> None:
    flat = [Lot(str(k), str(k), (np.eye(3, 2) * 9,), (20.0 * k, 0.0, 3.0)) for k in range(5)]
    assert grounds_of(squares_of(flat, ask_beside=False)) == {}
