"""Walls of `house.ifc` cut at openings that lie beside and on each other."""

from __future__ import annotations

import numpy as np
import pytest
from sample_plan import sample_storey
from shapely.geometry import box
from shapely.ops import unary_union

from veduta.plan.house.hole import Hole
from veduta.plan.house.lines import WallLine
from veduta.plan.outputs.ifc_cut import cut_pieces

HEIGHT_M = 3.0
WALL = box(0.0, 0.0, 5.0, 0.3)


def _hole(start: float, end: float, low: float, high: float) -> Hole:
    storey = sample_storey()
    wall = storey.walls[0].model_copy(update={"thickness_m": 0.3})
    line = WallLine(wall, np.array([[0.0, 0.15], [5.0, 0.15]]))
    return Hole(storey.openings[0], line, start, end, low, high)


def _volume(holes: list[Hole]) -> float:
    return sum(
        region.area * (high - low) for region, low, high in cut_pieces(WALL, holes, HEIGHT_M)
    )


def test_a_light_over_a_door_leaves_both_open() -> None:
    holes = [_hole(1.0, 2.0, 0.0, 2.0), _hole(1.0, 2.0, 2.2, 2.6)]
    assert _volume(holes) == pytest.approx((5.0 * 3.0 - 1.0 * 2.0 - 1.0 * 0.4) * 0.3)
    for at in (1.0, 2.4):
        solid = unary_union(
            [region for region, low, high in cut_pieces(WALL, holes, HEIGHT_M) if low < at < high]
        )
        assert solid.intersection(box(1.0, 0.0, 2.0, 0.3)).area == pytest.approx(0.0, abs=1e-9)


def test_a_wide_light_over_a_narrow_door_and_a_window_beside() -> None:
    holes = [_hole(1.0, 2.0, 0.0, 2.0), _hole(0.8, 2.2, 2.1, 2.5), _hole(3.0, 4.0, 0.9, 2.1)]
    expected = 5.0 * 3.0 - 2.0 - 1.4 * 0.4 - 1.2
    assert _volume(holes) == pytest.approx(expected * 0.3)


def test_a_wall_without_openings_is_one_piece() -> None:
    assert [(one.area, *ends) for one, *ends in cut_pieces(WALL, [], HEIGHT_M)] == [
        (pytest.approx(1.5), 0.0, HEIGHT_M)
    ]
