"""Walls that step aside, stand free, or lie in one another: what belongs to the house."""

from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from veduta.plan.walls.axes import Axis
from veduta.plan.walls.graph import wall_graph
from veduta.plan.walls.jogs import jogs
from veduta.plan.walls.join import joined
from veduta.plan.walls.meetings import meetings, pairs_in_reach
from veduta.plan.walls.pieces import Piece


def _piece(x0: float, y0: float, x1: float, y1: float, thick: float = 10.0) -> Piece:
    return Piece(np.array([x0, y0]), np.array([x1, y1]), thick)


def _solid(pieces: list[Piece]) -> np.ndarray:
    mask = np.zeros((500, 800), np.bool_)
    for one in pieces:
        low, high = np.minimum(one.start, one.end), np.maximum(one.start, one.end)
        half = one.thickness_px / 2 * (np.abs(one.direction[::-1]) > 0.5)
        (left, top), (right, bottom) = (low - half).astype(int), (high + half).astype(int)
        mask[top:bottom, left:right] = True
    return mask


def _hang_together(pieces: list[Piece]) -> int:
    """How many groups of walls the graph has, by a search from node to node."""
    graph = wall_graph([Axis(one, ()) for one in pieces])
    left = {edge.first for edge in graph.edges} | {edge.second for edge in graph.edges}
    groups = 0
    while left:
        groups, waiting = groups + 1, [left.pop()]
        while waiting:
            node = waiting.pop()
            for edge in graph.edges:
                for one, other in ((edge.first, edge.second), (edge.second, edge.first)):
                    if one == node and other in left:
                        left.discard(other)
                        waiting.append(other)
    return groups


@pytest.mark.parametrize("aside", [20.0, -20.0, 24.0])
@pytest.mark.parametrize("turned", [False, True])
def test_a_wall_that_steps_aside_hangs_together(aside: float, turned: bool) -> None:
    pieces = [_piece(100, 200, 300, 200, 30), _piece(300, 200 + aside, 500, 200 + aside, 32)]
    if turned:
        pieces = [Piece(one.start[::-1], one.end[::-1], one.thickness_px) for one in pieces]
    (step,) = jogs(pieces, _solid(pieces))
    assert step.length_px == pytest.approx(abs(aside))
    assert _hang_together(pieces) == 2
    assert _hang_together([*pieces, step]) == 1


def test_walls_in_one_line_and_walls_side_by_side_are_no_steps() -> None:
    straight = [_piece(100, 200, 300, 200), _piece(300, 203, 500, 203)]
    assert not jogs(straight, _solid(straight))
    beside = [_piece(100, 200, 300, 200), _piece(100, 209, 300, 209)]
    assert not jogs(beside, _solid(beside))
    apart = [_piece(100, 200, 300, 200), _piece(320, 208, 500, 208)]
    assert not jogs(apart, _solid(apart))


def _core() -> list[Piece]:
    """Four walls of 1200 px that hang together."""
    return [
        _piece(100, 100, 400, 100),
        _piece(400, 100, 400, 400),
        _piece(400, 400, 100, 400),
        _piece(100, 400, 100, 100),
    ]


def test_walls_that_stand_free_are_kept_where_they_are_many() -> None:
    piers = [_piece(500, 50 + 60 * row, 600, 50 + 60 * row) for row in range(4)]
    assert len(wall_graph([Axis(one, ()) for one in [*_core(), *piers]]).edges) == 8


def test_one_bar_and_furniture_of_other_thicknesses_are_left_out() -> None:
    bar = [_piece(500, 50, 600, 50)]
    assert len(wall_graph([Axis(one, ()) for one in [*_core(), *bar]]).edges) == 4
    things = [_piece(500, 50 + 60 * row, 600, 50 + 60 * row, 14 + 4 * row) for row in range(4)]
    assert len(wall_graph([Axis(one, ()) for one in [*_core(), *things]]).edges) == 4


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_no_pair_of_walls_that_meets_is_passed_over(seed: int) -> None:
    """Walls at corners, askew at small angles, in one line, and curved, thick and thin."""
    rng = np.random.default_rng(seed)
    pieces = []
    for _ in range(24):
        start = rng.integers(0, 12, 2) * 50 + rng.normal(0, 3, 2)
        angle = np.pi / 2 * rng.integers(0, 4) + rng.choice([0.0, 0.24, rng.uniform(0, np.pi)])
        end = start + rng.uniform(20, 300) * np.array([np.cos(angle), np.sin(angle)])
        bulge = rng.uniform(-0.8, 0.8) * (rng.random() < 0.2)
        pieces.append(Piece(start, end, rng.uniform(1, 40), bulge=bulge))
    every = list(combinations(range(len(pieces)), 2))
    pairs = pairs_in_reach(pieces)
    assert pairs == [pair for pair in every if pair in set(pairs)]
    met = [pair for pair in every if meetings(pieces[pair[0]], pieces[pair[1]])]
    assert met
    assert set(met) <= set(pairs)


def test_walls_far_from_each_other_are_no_pair() -> None:
    assert pairs_in_reach([_piece(0, 0, 100, 0), _piece(400, 0, 400, 90)]) == []
    assert pairs_in_reach([]) == []


@pytest.mark.parametrize(
    ("shorter", "kept"),
    [
        (_piece(200, 108, 260, 108, 6), False),  # within
        (_piece(95, 100, 300, 100, 6), False),  # out of its end by less than half a thickness
        (_piece(70, 111, 300, 111, 6), True),  # out of its end
        (_piece(200, 118, 260, 118, 6), True),  # beside
        (_piece(200, 110, 200, 250, 6), True),  # from within it into a room
        (_piece(200, -50, 200, 110, 6), True),  # from a room into it
        (_piece(200, 92, 200, 108, 60), False),  # across, no longer than it is thick
    ],
)
def test_pieces_within_the_body_of_a_longer_one_are_dropped(shorter: Piece, kept: bool) -> None:
    longer = _piece(100, 100, 500, 100, 24)
    found = joined([shorter, longer], np.zeros((400, 600), np.bool_))
    assert len(found) == 1 + kept
    assert max(one.length_px for one in found) == pytest.approx(400)
