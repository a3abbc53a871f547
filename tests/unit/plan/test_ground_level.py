"""Basements: which storey lies at ground level, and what begins there."""

from __future__ import annotations

import pytest
from sample_plan import sample_storey

from veduta.plan.house.ground_level import ground_storey


@pytest.mark.parametrize(
    ("storeys", "row"),
    [
        ([("ground floor", 0.0), ("first floor", 2.8)], 0),
        ([("lower", -2.8), ("upper", 0.0)], 1),
        ([("lowest", -5.6), ("lower", -2.8), ("upper", 0.0), ("top", 2.8)], 2),
        ([("a little low", -0.4), ("upper", 2.4)], 0),
        ([("half under", -1.5), ("upper", 1.2)], 1),
        ([("Basement", 0.0), ("ground floor", 2.8)], 1),
        ([("2. UG", -6.0), ("1. UG", -3.0), ("EG", 0.0)], 2),
        ([("Sous-sol", 0.0), ("Rez-de-chaussée", 2.5)], 1),
        ([("above the sea", 412.0), ("upper", 415.0)], 0),
        ([("keller", 0.0)], 0),
        ([("Cellar", -3.0), ("Basement", 0.0)], 1),
        ([("ground floor", 0.0), ("Basement flat", 2.8)], 0),
        ([("Hugo's floor", 0.0), ("upper", 2.8)], 0),
    ],
)
def test_the_storey_at_ground_level(storeys: list[tuple[str, float]], row: int) -> None:
    built = [sample_storey(name=name, elevation_m=up) for name, up in storeys]
    assert ground_storey(built) == row
