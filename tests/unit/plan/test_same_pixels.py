"""Storeys in files of their own whose pixels are as large vote for one scale together."""

from __future__ import annotations

import numpy as np
import pytest

from veduta.plan.scale.estimate import DrawnSizes, estimate_scale, together
from veduta.plan.scale.same_pixels import of_same_pixels


def storey(wide: float, deep: float, door: float = 80.0, height: int = 700) -> DrawnSizes:
    """Two rooms side by side, and three doors."""
    half = wide / 2.0
    rooms = [
        np.array([(x, 50.0), (x + half - 8.0, 50.0), (x + half - 8.0, 50.0 + deep), (x, 50 + deep)])
        for x in (50.0, 50.0 + half)
    ]
    ink = np.zeros((height, 900), np.float32)
    return DrawnSizes(rooms, [door, door, door], [12.0, 12.0, 25.0], ink)


def test_storeys_as_wide_as_each_other_are_of_one_size() -> None:
    ground, upper = storey(600.0, 400.0), storey(601.0, 340.0, height=640)
    other = storey(480.0, 300.0)
    larger = storey(600.0, 400.0, door=110.0)
    sizes = [ground, upper, other, larger]
    assert of_same_pixels(0, sizes) == [upper]
    assert of_same_pixels(2, sizes) == []
    assert of_same_pixels(3, sizes) == []
    assert together([ground, upper]).ink.shape == (700, 900)
    both = estimate_scale(ground, beside=[upper])
    assert both.metres_per_px == pytest.approx(estimate_scale(upper, beside=[ground]).metres_per_px)
