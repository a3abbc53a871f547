"""Buildings of one call stand side by side, and the visitor stands in the street."""

from __future__ import annotations

import itertools
from pathlib import Path

from hypothesis import given
from hypothesis import strategies as st

from veduta.facade.arrangement import EYE_M, GAP_M, Placed, arrange

size = st.floats(0.5, 60.0)


@given(st.lists(st.tuples(st.floats(-2, 0), size, st.floats(-2, 0), size, size), min_size=1))
def test_no_two_touch(boxes: list[tuple[float, float, float, float, float]]) -> None:
    buildings = [
        Placed(f"b{number}", (left, front, 0.0), (left + width, front + depth, height))
        for number, (left, width, front, depth, height) in enumerate(boxes)
    ]
    place = arrange(buildings, Path())
    parts = [placed.row for placed in place.parts.values() if placed.row is not None]
    assert [part.id for part in parts] == [building.name for building in buildings]
    edges = [
        (part.bounds.min[0] + part.transform[12], part.bounds.max[0] + part.transform[12])
        for part in parts
    ]
    for (_, right), (left, _) in itertools.pairwise(edges):
        assert abs(left - right - GAP_M) < 1e-6
    wanted = "single" if len(boxes) == 1 else "invented"
    assert {part.arrangement for part in parts} == {wanted}
    assert parts[0].transform[12] == 0.0

    assert place.start is not None
    x, y, z = place.start.eye
    assert z == EYE_M
    assert y < min(building.low[1] for building in buildings)
    assert edges[0][0] <= x <= edges[-1][1]
