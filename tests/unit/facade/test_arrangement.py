"""Buildings of one call stand side by side, and the visitor stands in the street."""

from __future__ import annotations

import itertools
from pathlib import Path

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from veduta.facade.arrangement import EYE_M, GAP_M, Placed, Stand, arrange

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


def test_fronts_on_walls_of_one_frame_stand_there() -> None:
    turned = np.eye(4)
    turned[:2, :2], turned[:3, 3] = [[0, -1], [1, 0]], (20.0, 5.0, 3.0)
    stands = [Stand(tuple(m.T.ravel().tolist()), "EPSG:25832", (7e5, 5e6, 0.0))
              for m in (np.eye(4), turned)]  # fmt: skip
    buildings = [
        Placed(f"b{number}", (0.0, -0.5, 0.0), (10.0, 8.0, 12.0), stand)
        for number, stand in enumerate(stands)
    ]
    place = arrange(buildings, Path())
    assert (place.crs, place.origin_m) == ("EPSG:25832", (7e5, 5e6, 0.0))
    assert np.array_equal(place.parts["b1"].standing.transform, turned)
    assert place.parts["b1"].standing.arrangement == "single"
    alone = arrange(buildings[1:], Path())
    # The visitor stands before the front, which looks along +x here, at eye height above its foot.
    assert alone.start is not None
    assert np.allclose(alone.start.eye, (20.5 + 1.3 * 12.0, 10.0, 3.0 + EYE_M))

    other = Placed("b2", (0.0, 0.0, 0.0), (5.0, 5.0, 5.0))
    mixed = arrange([*buildings, other], Path())
    assert mixed.crs is None
    assert {placed.standing.arrangement for placed in mixed.parts.values()} == {"invented"}
