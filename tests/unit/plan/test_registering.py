"""Storeys onto each other: what was moved is moved back."""

from __future__ import annotations

import numpy as np
import pytest
from sample_plan import sample_storey

from veduta.plan.document import Storey
from veduta.plan.outputs.overlay import pixels_of
from veduta.plan.registering import moved, registered


def corner(storey: Storey) -> tuple[float, float]:
    return next(one.at_m for one in storey.junctions if one.id == "a")


@pytest.mark.parametrize("by", [(3.0, -2.0), (0.0, 0.0), (-11.0, 0.4)])
def test_a_storey_like_the_one_below_comes_to_lie_on_it(by: tuple[float, float]) -> None:
    upper = moved(sample_storey(name="upper"), by)
    lower, found = registered([sample_storey(), upper])
    assert corner(lower) == (0.0, 0.0)
    assert corner(found) == pytest.approx((0.0, 0.0), abs=1e-4)
    assert found.rooms[0].outline_m[0] == pytest.approx(lower.rooms[0].outline_m[0], abs=1e-4)


def test_a_smaller_storey_keeps_within_the_one_below() -> None:
    lower = sample_storey()
    kept = [one for one in lower.junctions if one.id in {"b", "c", "d", "e"}]
    walls = [one for one in lower.walls if one.id in {"south-2", "east", "north-2", "middle"}]
    upper = sample_storey(
        name="upper", junctions=kept, walls=walls, rooms=lower.rooms[1:], openings=[]
    )
    found = registered([lower, moved(upper, (-6.0, 2.0))])[1]
    xs = [one.at_m[0] for one in found.junctions]
    assert min(xs) >= -0.2
    assert max(xs) <= 8.2
    assert {one.at_m[1] for one in found.junctions} == {0.0, 5.0}


def test_the_drawing_stays_under_its_storey() -> None:
    storey = sample_storey()
    there = moved(storey, (3.0, -2.0))
    before = pixels_of(storey.sheet, np.array([corner(storey)]))
    assert pixels_of(there.sheet, np.array([corner(there)])) == pytest.approx(before)
