"""What operations come to on a lot of 10 x 8 m, by numbers worked out from the reference's text."""

from __future__ import annotations

import math

import pytest

from veduta import _core

LOT = [[(0.0, 0.0, 0.0), (10.0, 0.0, 0.0), (10.0, 8.0, 0.0), (0.0, 8.0, 0.0)]]
SLOPE = math.radians(30.0)
"""Overhangs lie on the roof: of 1 m so much is sideways, and so much down."""
ASIDE, DOWN, RISE = math.cos(SLOPE), math.sin(SLOPE), math.tan(SLOPE)

BOXES: dict[str, tuple[tuple[float, float, float], tuple[float, float, float]]] = {
    "roofGable(30)": ((0, 0, 0), (10, 8, 4 * RISE)),
    "roofGable(30, 1, 0.5)": ((-0.5, -ASIDE, -DOWN), (10.5, 8 + ASIDE, 4 * RISE)),
    # The second overhang is the first where it is not given.
    "roofGable(30, 1)": ((-1, -ASIDE, -DOWN), (11, 8 + ASIDE, 4 * RISE)),
    # Gables on the edge of that index.
    "roofGable(30, 0, 0, false, 0)": ((0, 0, 0), (10, 8, 5 * RISE)),
    "roofGable(30, 0, 0, false, 1)": ((0, 0, 0), (10, 8, 4 * RISE)),
    # A slope of 3 in 4.
    "roofGable(byHeight, 3, 1, 0.5)": ((-0.5, -0.8, -0.6), (10.5, 8.8, 3)),
    "roofHip(30, 1)": ((-ASIDE, -ASIDE, -DOWN), (10 + ASIDE, 8 + ASIDE, 4 * RISE)),
    "roofPyramid(45)": ((0, 0, 0), (10, 8, 4)),
    "roofShed(30)": ((0, 0, 0), (10, 8, 8 * RISE)),
    "taper(4)": ((0, 0, 0), (10, 8, 4)),
}
SUMS: dict[str, dict[str, float]] = {
    "shapeL(3, 2) { shape : A | remainder : B }": {"a": 3 * 10 + 2 * 5, "b": 8 * 5},
    "shapeU(3, 2, 1) { shape : A | remainder : B }": {"a": 3 * 10 + 3 * 5, "b": 7 * 5},
    "shapeO(3, 2, 1, 1.5) { shape : A | remainder : B }": {"a": 80 - 6.5 * 4, "b": 6.5 * 4},
    # The corner is shared by two edges at 45 degrees.
    "setback(2) { front : A | left : B | remainder : C }": {"a": 18, "b": 14, "c": 48},
    "setback(2) { all : A | remainder : B }": {"a": 80 - 6 * 4, "b": 6 * 4},
    "offset(-1) comp(f) { inside : A | border : B }": {"a": 8 * 6, "b": 80 - 8 * 6},
    "offset(1, border) A": {"a": 12 * 10 - 80},
    # 10 - 2 - 2.5 m are left for one part and three.
    "split(x) { 2 : A | ~1 : B | ~3 : C | '0.25 : D }": {
        "a": 16, "b": 8 * 5.5 / 4, "c": 8 * 5.5 * 3 / 4, "d": 20,
    },
    "split(x) { { ~3 : N A }* }": {"n": 3, "a": 80},
    "scatter(surface, 50, uniform) { N }": {"n": 50},
    "extrude(3) comp(f) { top : A | front : B | left : C | bottom : D | all : N }": {
        "a": 80, "b": 30, "c": 24, "d": 80, "n": 2,
    },
}  # fmt: skip
RULES = "\n".join(
    [*(f'{name} --> report("{name.lower()}", geometry.area)' for name in "ABCD"),
     'N --> report("n", 1)']
)  # fmt: skip


def derived(operations: str) -> _core.Derivation:
    rules = _core.GrammarRules([("test.cga", f"Lot --> {operations}\n{RULES}")])
    return _core.Derivation(rules, LOT, 0)


@pytest.mark.parametrize("operations", BOXES)
def test_roofs_are_as_high_and_as_wide(operations: str) -> None:
    corners = derived(f"{operations} Roof.").columns().positions_m
    low, high = BOXES[operations]
    assert corners.min(axis=0) == pytest.approx(low, abs=1e-6)
    assert corners.max(axis=0) == pytest.approx(high, abs=1e-6)


@pytest.mark.parametrize("operations", SUMS)
def test_parts_have_their_areas(operations: str) -> None:
    sums: dict[str, float] = {}
    for key, value in derived(operations).reports:
        assert isinstance(value, float)
        sums[key] = sums.get(key, 0.0) + value
    assert sums == pytest.approx(SUMS[operations])
