"""Ways over free space: what is free, the cheapest ways, smoothing, and the order of rooms."""

from __future__ import annotations

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from sample_plan import opening, sample_storey
from scipy.sparse import coo_array
from scipy.sparse.csgraph import dijkstra
from shapely.geometry import LineString, Point, Polygon, box

from veduta.plan.document import Furniture
from veduta.plan.house.space import space_of
from veduta.plan.tour.find import coarse_notes
from veduta.plan.tour.free import BODY_M, GRAZE_M, Ground, footprint, ground_of
from veduta.plan.tour.grid import MOST_CELLS, MOST_IN_ALL, SHY_COST, SHY_M, Cells, Grid, cells_of
from veduta.plan.tour.leaves import DoorLeaf
from veduta.plan.tour.smooth import resampled, smoothed
from veduta.plan.tour.stops import short_order, squares_in

HEIGHT_M = 2.5


def thing(at: tuple[float, float], size: tuple[float, float, float], **more: float) -> Furniture:
    return Furniture(id="f", object="box", room="living", at_m=at, size_m=size, **more)


def ground(*furniture: Furniture, leaves: tuple[DoorLeaf, ...] = (), **changes: object) -> Ground:
    storey = sample_storey(furniture=list(furniture), **changes)
    return ground_of(space_of(storey, HEIGHT_M), leaves, Polygon(), ())


def test_walls_keep_the_visitor_at_arms_length() -> None:
    free = ground().free
    # The living room reaches from 0.15 to 4.94 m, the bath from 5.06 to 7.85 m.
    assert free.covers(Point(0.15 + BODY_M + 0.01, 2.5))
    assert not free.covers(Point(0.15 + BODY_M - 0.01, 2.5))
    assert not free.covers(Point(5.0, 3.0))


def test_one_walks_through_doors_and_not_through_windows() -> None:
    free = ground().free
    assert free.covers(LineString([(4.0, 1.45), (6.0, 1.45)]))  # the inner door: 1.0 to 1.9 m
    assert not free.intersects(LineString([(3.5, 0.0), (3.5, 0.1)]))  # the window w1


def test_squares_of_a_house_are_bounded_and_coarse_ones_are_told() -> None:
    """A hall of 300 m by 300 m, alone and on forty storeys: squares of 6 cm were 25 million."""
    hall = replace(ground(), floor=box(0.0, 0.0, 300.0, 300.0), solid=Polygon())
    one, many = cells_of(hall), cells_of(hall, 40)
    # But for the squares that begin at the edges.
    assert len(one.places_m) <= 1.01 * MOST_CELLS
    assert 40 * len(many.places_m) <= 1.01 * MOST_IN_ALL
    assert one.side_m == pytest.approx(math.sqrt(300.0**2 / MOST_CELLS))
    assert many.side_m > one.side_m
    small = cells_of(ground())
    said = coarse_notes([hall, ground()], [one, small])
    assert len(said) == 1
    assert "squares of 47 cm" in said[0]


@pytest.mark.parametrize(("width", "passes"), [(0.48, False), (0.55, True)])
def test_a_door_must_be_as_wide_as_the_visitor_between_its_linings(
    width: float, passes: bool
) -> None:
    """Two linings of 5 cm and twice the radius: 0.50 m."""
    openings = [opening("inner", "middle", 1.0, width)]
    free = ground(openings=openings).free
    pieces = (
        [piece for piece in free.geoms if piece.area > 1.0]
        if free.geom_type != "Polygon"
        else [free]
    )
    assert (len(pieces) == 1) == passes


def test_what_is_low_is_walked_over_and_what_hangs_is_walked_under() -> None:
    at = (2.5, 2.5)
    assert ground(thing(at, (2.0, 2.0, 0.02))).free.covers(Point(at))
    assert ground(thing(at, (1.0, 1.0, 0.4), above_m=2.0)).free.covers(Point(at))
    assert not ground(thing(at, (1.0, 1.0, 0.4), above_m=1.2)).free.covers(Point(at))


def test_furniture_is_turned_about_its_middle() -> None:
    found = footprint(thing((1.0, 2.0), (2.0, 0.5, 1.0), turn_rad=math.pi / 2))
    assert found.symmetric_difference(box(0.75, 1.0, 1.25, 3.0)).area < 1e-9


def test_a_leaf_high_up_is_no_obstacle() -> None:
    lifted = DoorLeaf(0, box(1.0, 1.0, 3.0, 3.0), 2.1, 2.2)
    standing = DoorLeaf(0, box(1.0, 1.0, 3.0, 3.0), 0.0, 2.0)
    assert ground(leaves=(lifted,)).free.covers(Point(2.0, 2.0))
    assert not ground(leaves=(standing,)).free.covers(Point(2.0, 2.0))


def brute_cost(cells: Cells, start: int, goal: int) -> float:
    """By Dijkstra's algorithm of scipy over edges that are made anew from the squares' places."""
    keys = {
        tuple(key): row
        for row, key in enumerate(
            np.round(cells.places_m / cells.side_m - 0.5).astype(int).tolist()
        )
    }
    ends, costs = [], []
    shy = SHY_COST * np.maximum(0.0, 1.0 - cells.clear_m / SHY_M) ** 2
    for (x, y), row in keys.items():
        for dx, dy in ((1, 0), (0, 1), (1, 1), (1, -1)):
            other = keys.get((x + dx, y + dy))
            if other is None or (dx and dy and not {(x + dx, y), (x, y + dy)} <= keys.keys()):
                continue
            ends.append((row, other))
            costs.append(math.hypot(dx, dy) * cells.side_m * (1.0 + (shy[row] + shy[other]) / 2.0))
    first, second = np.array(ends).T
    size = len(cells.places_m)
    matrix = coo_array((costs, (first, second)), shape=(size, size)).tocsr()
    return float(dijkstra(matrix, directed=False, indices=start)[goal])


def test_ways_cost_what_the_cheapest_cost(monkeypatch: pytest.MonkeyPatch) -> None:
    cells = cells_of(ground(thing((2.5, 2.5), (1.5, 0.8, 0.8), turn_rad=0.4)))
    grid = Grid([cells])
    start, goal = grid.nearest(0, (1.0, 4.0)), grid.nearest(0, (7.0, 4.0))
    assert start is not None
    assert goal is not None
    expected = brute_cost(cells, start, goal)
    # By the straight line ahead, then by what is known to be left.
    first = grid.way(start, goal)
    assert grid.costs([start, goal])[0, 1] == pytest.approx(expected, rel=1e-9)
    monkeypatch.setattr(Grid, "_beeline", None)  # is not asked for any more
    for way in (first, grid.way(start, goal)):
        assert (way[0], way[-1]) == (start, goal)
        shy = SHY_COST * np.maximum(0.0, 1.0 - cells.clear_m[way] / SHY_M) ** 2
        steps = np.linalg.norm(np.diff(cells.places_m[way], axis=0), axis=1)
        cost = float((steps * (1.0 + (shy[1:] + shy[:-1]) / 2.0)).sum())
        assert cost == pytest.approx(expected, rel=1e-9)


def test_squares_are_free_and_pieces_are_those_of_the_region() -> None:
    closed = ground(openings=[opening("front", "south-1", 0.6, 1.0)])
    cells = cells_of(closed)
    assert shapely.contains_xy(closed.free, *cells.places_m.T).all()
    left = cells.piece[cells.places_m[:, 0] < 4.9]
    right = cells.piece[cells.places_m[:, 0] > 5.1]
    assert not set(left.tolist()) & set(right.tolist())
    area = len(cells.places_m) * cells.side_m**2
    assert area == pytest.approx(closed.free.area, rel=0.02)


@given(st.floats(-1.0, 9.0), st.floats(-1.0, 6.0), st.floats(0.0, 7.0), st.floats(0.0, 5.0))
def test_squares_in_a_room_are_those_with_their_middles_in_it(
    x: float, y: float, wide: float, deep: float
) -> None:
    cells = cells_of(ground())
    grid = Grid([cells, cells])
    room = box(x, y, x + wide, y + deep)
    inside = np.flatnonzero(shapely.contains_xy(room, *cells.places_m.T))
    assert squares_in(room, grid, 1).tolist() == (inside + len(cells.places_m)).tolist()
    assert squares_in(Polygon(), grid, 1).tolist() == []


@given(st.floats(0.2, 2.0), st.floats(0.1, 1.0))
def test_smoothed_ways_stay_free_and_keep_their_ends(wide: float, deep: float) -> None:
    """Round a block that stands in the way."""
    block = box(-wide / 2, -5.0, wide / 2, deep)
    free = box(-4.0, -3.0, 4.0, 3.0).difference(block)
    corner = wide / 2 + 0.05
    given_way = np.array(
        [
            (-3.0, -2.0),
            (-corner, -2.0),
            (-corner, deep + 0.05),
            (corner, deep + 0.05),
            (corner, -2.0),
            (3.0, -2.0),
        ]
    )
    found = smoothed(given_way, free, free.buffer(GRAZE_M))
    assert free.buffer(0.031).covers(LineString(found))
    assert found[0].tolist() == [-3.0, -2.0]
    assert found[-1].tolist() == [3.0, -2.0]
    assert LineString(found).length <= LineString(given_way).length + 1e-9


def test_corners_are_rounded_in_the_open() -> None:
    corner = np.array([(0.0, 0.0), (3.0, 0.0), (3.0, 3.0)])
    open_air = box(-1.0, -1.0, 4.0, 4.0)
    found = smoothed(corner, open_air, open_air)
    course = np.unwrap(np.arctan2(*np.diff(found, axis=0).T[::-1]))
    assert np.degrees(np.abs(np.diff(course)).max()) < 15.0


def test_resampled_points_lie_at_equal_distances() -> None:
    found = resampled(np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 2.0)]), 0.25)
    assert len(found) == 13
    assert np.linalg.norm(np.diff(found, axis=0), axis=1) == pytest.approx(np.full(12, 0.25))


@given(st.lists(st.tuples(st.floats(0, 10), st.floats(0, 10)), min_size=3, max_size=7))
def test_orders_are_nearly_as_short_as_the_shortest(places: list[tuple[float, float]]) -> None:
    points = np.array(places)
    costs = np.linalg.norm(points[:, None] - points[None], axis=2)

    def length(order: tuple[int, ...]) -> float:
        trip = [0, *order, 0]
        return float(sum(costs[a, b] for a, b in itertools.pairwise(trip)))

    found = short_order(costs)
    assert sorted(found) == list(range(1, len(points)))
    best = min(length(order) for order in itertools.permutations(range(1, len(points))))
    assert length(tuple(found)) <= 1.3 * best + 1e-6
