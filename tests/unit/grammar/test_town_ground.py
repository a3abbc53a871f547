"""The ground between lots of different heights."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.spatial import ConvexHull

from veduta.grammar.block import Block
from veduta.grammar.ground import SINK_M, Ground, ground_of, height_at
from veduta.grammar.ground_margin import BELOW_M, MARGIN_M, REACH
from veduta.grammar.lot import Lot


def lot(x: float, y: float, z: float, size: float = 10.0) -> Lot:
    ring = np.array([[0.0, 0.0], [size, 0.0], [size, size], [0.0, size]])
    return Lot(f"{x} {y}", "lot", (ring,), (x, y, z))


def height(grounds: dict[str, Ground], x: float, y: float) -> list[float]:
    """How high lots would stand on all triangles at a place, by barycentric coordinates."""
    found: list[float] = []
    for ground in grounds.values():
        corners = ground.points_m[ground.triangles]
        near = (corners[:, :, :2].min(axis=1) <= (x, y)).all(axis=1)
        near &= (corners[:, :, :2].max(axis=1) >= (x, y)).all(axis=1)
        for a, b, c in corners[near]:
            sides = np.column_stack([b[:2] - a[:2], c[:2] - a[:2]])
            if abs(np.linalg.det(sides)) < 1e-12:
                continue
            s, t = np.linalg.solve(sides, np.array([x, y]) - a[:2])
            if min(s, t, 1 - s - t) >= -1e-9:
                found.append(float(a[2] + s * (b[2] - a[2]) + t * (c[2] - a[2]) + SINK_M))
    return found


def area(ground: Ground) -> NDArray[np.float64]:
    """Twice the area of each triangle on the map; above zero where counter-clockwise."""
    a, b, c = (ground.points_m[ground.triangles[:, k], :2] for k in range(3))
    (ux, uy), (vx, vy) = (b - a).T, (c - a).T
    found: NDArray[np.float64] = ux * vy - uy * vx
    return found


def test_level_lots_have_the_plane() -> None:
    assert ground_of([Block("parts/00", (lot(0, 0, 2.0), lot(20, 0, 2.04)), (0, 0, 0))]) == {}
    assert ground_of([]) == {}


def test_lots_stand_on_it_and_streets_rise_between_them() -> None:
    blocks = [
        Block("parts/00", (lot(0, 0, 1.0), lot(0, 30, 1.0)), (0, 0, 1)),
        Block("parts/01", (lot(30, 0, 3.0), lot(30, 30, 3.0)), (30, 0, 3)),
    ]
    grounds = ground_of(blocks)
    assert set(grounds) == {"parts/00", "parts/01"}
    for x, truth in ((0.0, 1.0), (5.0, 1.0), (20.0, 2.0), (25.0, 2.5), (35.0, 3.0)):
        for y in (3.0, 18.0, 36.0):
            told = height(grounds, x, y)
            assert told, (x, y)
            assert told == pytest.approx([truth] * len(told), abs=1e-6), (x, y)
    assert height_at(grounds.values(), 20.0, 18.0) == pytest.approx(2.0 - SINK_M)
    assert height_at(grounds.values(), 20.0, -MARGIN_M - 1) is None


def test_around_the_town_it_falls_to_the_plane_so_that_one_can_walk() -> None:
    """Level where it leaves the lots and where it ends; never steeper than the cubic between."""
    for rise in (4.0, 60.0):
        places = [(20.0 * x, 20.0 * y) for x in range(3) for y in range(3)]
        lots = tuple(lot(x, y, 0.0 if (x, y) == (20, 20) else rise) for x, y in places)
        (ground,) = ground_of([Block("parts/00", lots, (0, 0, 0))]).values()
        width = max(MARGIN_M, REACH * (rise - SINK_M))
        outer = ground.points_m[ConvexHull(ground.points_m[:, :2]).vertices]
        assert outer[:, 2] == pytest.approx(BELOW_M)
        assert outer[:, 0].min() == pytest.approx(-width, rel=0.01)
        assert outer[:, 1].max() == pytest.approx(50 + width, rel=0.01)
        a, b, c = (ground.points_m[ground.triangles[ground.between :, k]] for k in range(3))
        normal = np.cross(b - a, c - a)
        slope = np.hypot(normal[:, 0], normal[:, 1]) / normal[:, 2]
        assert 0.9 < slope.max() / (1.5 * rise / width) < 1.05
        assert slope.max() < np.tan(np.radians(30))
        for share in (0.1, 0.5, 0.8):
            truth = rise * (1 - 3 * share**2 + 2 * share**3)
            told = height({"": ground}, 50 + share * width, 25.0)
            assert told[0] == pytest.approx(truth, abs=0.01 * rise + 0.06)


def test_a_lot_stays_level_between_neighbours_that_are_closer_than_it_is_long() -> None:
    """Corners of others lie in its circle: triangles between all corners would cross it."""
    long = Lot("long", "long", (np.array([[0, 0], [40, 0], [40, 6], [0, 6.0]]),), (0, 0, 0.0))
    beside = [lot(x, y, 5.0, size=4.0) for x in (4.0, 16.0, 28.0) for y in (-5.0, 7.0)]
    grounds = ground_of([Block("parts/00", (long, *beside), (0, 0, 0))])
    for x in np.linspace(1.0, 39.0, 20):
        for y in (0.5, 3.0, 5.5):
            told = height(grounds, float(x), y)
            assert told
            assert told == pytest.approx([0.0] * len(told), abs=1e-6), (x, y)


def test_the_higher_of_two_neighbours_counts_where_they_meet() -> None:
    grounds = ground_of([Block("parts/00", (lot(0, 0, 1.0), lot(10, 0, 2.0)), (0, 0, 0))])
    assert height(grounds, 10.0, 0.0) == pytest.approx([2.0] * len(height(grounds, 10.0, 0.0)))
    assert min(height(grounds, 15.0, 5.0)) == pytest.approx(2.0)


@given(
    st.lists(
        st.tuples(st.integers(0, 9), st.integers(0, 9), st.floats(0, 60)),
        min_size=1,
        max_size=25,
        unique_by=lambda one: one[:2],
    )
)
def test_it_covers_the_town_once(places: list[tuple[int, int, float]]) -> None:
    """Blocks of neighbours share it without gap or overlap: areas add up to that of the whole."""
    lots = [lot(14.0 * x, 17.0 * y, z) for x, y, z in places]
    half = len(lots) // 2 or 1
    blocks = [Block("a", tuple(lots[:half]), (0, 0, 0)), Block("b", tuple(lots[half:]), (0, 0, 0))]
    grounds = ground_of([block for block in blocks if block.lots])
    heights = [z for _, _, z in places]
    assert bool(grounds) == (max(heights) - min(heights) >= 0.05)
    if not grounds:
        return
    assert all((area(ground) > 0).all() for ground in grounds.values())

    every = np.concatenate([ground.points_m for ground in grounds.values()])
    whole = ConvexHull(every[:, :2]).volume
    assert sum(area(ground).sum() for ground in grounds.values()) / 2 == pytest.approx(whole)
    corners = np.concatenate([one.rings_m[0] + one.anchor_m[:2] for one in lots])
    between = sum(area(ground)[: ground.between].sum() for ground in grounds.values()) / 2
    assert between == pytest.approx(ConvexHull(corners).volume)
    for one, (_, _, z) in zip(lots, places, strict=True):
        told = height(grounds, one.anchor_m[0] + 5.0, one.anchor_m[1] + 4.0)
        assert told
        assert told == pytest.approx([z] * len(told), abs=1e-6)
