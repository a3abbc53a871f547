"""The nearest wall ahead: walls at known places, and shapely's own intersections as the oracle."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from shapely.geometry import LineString, Point

from veduta.plan.rooms.breaks import Parting, find_breaks
from veduta.plan.rooms.rays import FARTHEST, Ray, Walls
from veduta.plan.walls.axes import Axis
from veduta.plan.walls.graph import wall_graph
from veduta.plan.walls.pieces import Piece

THICK = 8.0


def wall(*ends: float, thick: float = THICK) -> Axis:
    return Axis(Piece(np.array(ends[:2]), np.array(ends[2:]), thick), ())


def walls(*axes: Axis) -> Walls:
    return Walls(wall_graph(axes), axes)


def ray(x: float, y: float, way: tuple[float, float] = (1.0, 0.0)) -> Ray:
    return Ray(np.array([x, y]), np.array(way), THICK, frozenset())


def test_a_wall_across_is_reached_at_its_face() -> None:
    (hit,) = walls(wall(150, 0, 150, 200)).ahead([ray(50, 100)], THICK)
    assert hit.to_side
    assert not hit.facing
    assert hit.face_px == pytest.approx(100 - THICK / 2)
    assert hit.reach_px == pytest.approx(100)


def test_a_wall_in_line_is_reached_at_its_end() -> None:
    (hit,) = walls(wall(150, 102, 300, 102)).ahead([ray(50, 100)], THICK)
    assert (hit.to_side, hit.facing) == (False, True)
    assert hit.face_px == hit.reach_px == pytest.approx(100)


def test_a_wall_in_line_behind_a_corner_faces_the_ray() -> None:
    (hit,) = walls(wall(150, 0, 150, 200), wall(150, 100, 300, 100)).ahead([ray(50, 100)], THICK)
    assert (hit.to_side, hit.facing) == (True, True)


def test_walls_behind_beside_and_too_far_away_are_not_ahead() -> None:
    around = walls(wall(20, 0, 20, 200), wall(0, 150, 300, 150), wall(400, 0, 400, 200))
    assert around.ahead([ray(50, 100)], THICK) == []
    assert around.ahead([], THICK) == []


def test_each_ray_has_its_own_answer() -> None:
    two = walls(wall(150, 0, 150, 80), wall(120, 120, 120, 200))
    rays = [ray(50, 160), ray(50, 100), ray(50, 40)]
    hits = two.ahead(rays, THICK)
    assert [hit.ray for hit in hits] == [rays[0], rays[2]]
    assert [hit.reach_px for hit in hits] == pytest.approx([70, 100])


# Walls that touch are one to the graph: they stand two thicknesses apart at least.
@given(st.lists(st.tuples(st.integers(4, 11), st.integers(0, 60)), min_size=1, max_size=5))
def test_the_nearest_is_the_one_that_shapely_finds(places: list[tuple[int, int]]) -> None:
    axes = [wall(16 * x, 60 - more, 16 * x, 140 + more) for x, more in dict(places).items()]
    (hit,) = walls(*axes).ahead([ray(50, 100)], THICK)
    beam = LineString([(50 + THICK, 100), (50 + FARTHEST * THICK, 100)])
    lines = [LineString([one.line.start, one.line.end]) for one in axes]
    crossings = [one.intersection(beam) for one in lines if one.intersects(beam)]
    nearest = min(Point(50, 100).distance(one) for one in crossings)
    assert hit.reach_px == pytest.approx(nearest)


def test_a_stub_on_a_face_goes_on_to_the_wall_ahead() -> None:
    axes = [wall(50, 50, 350, 50), wall(50, 150, 350, 150)]
    solid = np.zeros((220, 400), dtype=np.bool_)
    solid[46:54, 50:350] = solid[146:154, 50:350] = True
    solid[54:66, 200:208] = True
    (found,) = find_breaks(wall_graph(axes), axes, Parting(solid), THICK)
    assert found.start == pytest.approx([204, 50])
    assert found.end == pytest.approx([204, 150])
    (gap,) = found.gaps
    assert (gap.start[1], gap.end[1]) == (66, 146)
