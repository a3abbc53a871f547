"""The nearest wall ahead of each end, against the same said wall by wall."""

from __future__ import annotations

import math

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from veduta.plan.openings.gaps import (
    BESIDE,
    CROSSING_RAD,
    FARTHEST,
    PARALLEL_RAD,
    beyond_corners,
    find_gaps,
)
from veduta.plan.openings.strip import Sheet, sample
from veduta.plan.walls.pieces import Piece

Way = NDArray[np.float64]


def to_end(piece: Piece, origin: Way, ray: Way, other: Piece) -> float:
    cross = abs(ray[0] * other.direction[1] - ray[1] * other.direction[0])
    ends = [one - origin for one in (other.start, other.end)]
    along = [float(one @ ray) for one in ends]
    near = ends[0] if along[0] <= along[1] else ends[1]
    beside = abs(ray[0] * near[1] - ray[1] * near[0])
    thick = max(piece.thickness_px, other.thickness_px)
    if cross > math.sin(PARALLEL_RAD) or beside > max(3.0, BESIDE * thick) or max(along) < 0:
        return math.inf
    return min(along)


def to_side(origin: Way, ray: Way, other: Piece) -> float:
    cross = ray[0] * other.direction[1] - ray[1] * other.direction[0]
    if abs(cross) < math.sin(CROSSING_RAD):
        return math.inf
    apart = other.start - origin
    distance = (apart[0] * other.direction[1] - apart[1] * other.direction[0]) / cross
    along = (apart[0] * ray[1] - apart[1] * ray[0]) / cross
    half = other.thickness_px / 2 / abs(cross)
    reaches = -other.thickness_px <= along <= other.length_px + other.thickness_px
    return float(distance - half) if reaches and distance >= -half - 3 else math.inf


def nearest(pieces: list[Piece], index: int, at_end: bool) -> tuple[int, bool, float] | None:
    """The piece ahead, whether its side is, and how far its face is."""
    piece = pieces[index]
    origin, ray = (piece.end, piece.direction) if at_end else (piece.start, -piece.direction)
    best = (-1, False, math.inf)
    for number, other in enumerate(pieces):
        if number == index:
            continue
        for side, away in (
            (False, to_end(piece, origin, ray, other)),
            (True, to_side(origin, ray, other)),
        ):
            behind = max(3.0, 0.3 * piece.thickness_px, other.thickness_px)
            if -behind < away < best[2]:
                best = (number, side, away)
    number, side, away = best
    if number < 0:
        return None
    thick = piece.thickness_px if side else min(piece.thickness_px, pieces[number].thickness_px)
    return best if max(3.0, 0.3 * thick) < away <= FARTHEST * thick else None


walls = st.builds(
    lambda x, y, length, turn, thick: Piece(
        np.array([x, y], float),
        np.array([x, y], float) + length * np.array([math.cos(turn), math.sin(turn)]),
        thick,
    ),
    st.integers(0, 40).map(lambda value: 10 * value),
    st.integers(0, 40).map(lambda value: 10 * value),
    st.floats(10.0, 200.0),
    st.sampled_from([0.0, 0.02, math.pi / 2, math.pi, 0.7, -2.0]),
    st.floats(4.0, 14.0),
)


@given(st.lists(walls, max_size=9))
@settings(max_examples=150, deadline=None)
def test_gaps_lead_to_the_nearest_wall_ahead(pieces: list[Piece]) -> None:
    expected = set()
    for index in range(len(pieces)):
        for at_end in (False, True):
            found = nearest(pieces, index, at_end)
            if found is not None:
                number, side, _ = found
                expected.add((index, at_end) if side else tuple(sorted((index, number))))
    gaps = find_gaps(pieces)
    assert {
        (gap.piece, gap.at_end) if gap.to_side else tuple(sorted((gap.piece, gap.target)))
        for gap in gaps
    } == expected
    for gap in gaps:
        found = nearest(pieces, gap.piece, gap.at_end)
        assert found is not None
        assert math.isclose(gap.width_px, found[2], abs_tol=1e-6)


def test_what_lies_beyond_two_corners_in_one_line_is_found_once() -> None:
    def wall(*ends: float) -> Piece:
        return Piece(np.array(ends[:2]), np.array(ends[2:]), 20.0)

    # A room of 210 by 210 px between its faces, and walls that end at the middle of each side.
    sides = [
        wall(100.0, 85.0, 100.0, 315.0),
        wall(330.0, 85.0, 330.0, 315.0),
        wall(100.0, 85.0, 330.0, 85.0),
        wall(100.0, 315.0, 330.0, 315.0),
    ]
    level = [wall(0.0, 200.0, 90.0, 200.0), wall(340.0, 200.0, 450.0, 200.0)]
    upright = [wall(215.0, 0.0, 215.0, 75.0), wall(215.0, 325.0, 215.0, 400.0)]

    def found(pieces: list[Piece]) -> list[list[list[float]]]:
        return [np.sort([one.start, one.end], axis=0).tolist() for one in beyond_corners(pieces)]

    across, down = [[110.0, 200.0], [320.0, 200.0]], [[215.0, 95.0], [215.0, 305.0]]
    assert found([*sides, *level]) == [across]
    assert found([*sides, level[1]]) == [across]
    # Those that cross have one middle, too, but are two.
    assert found([*sides, *level, *upright]) == [across, down]


@given(st.lists(st.tuples(st.floats(-40.0, 60.0), st.floats(-40.0, 60.0)), min_size=1, max_size=40))
def test_marks_are_those_that_are_sampled(places: list[tuple[float, float]]) -> None:
    faint = np.random.default_rng(3).random((17, 23)) < 0.5
    sheet = Sheet(np.zeros(faint.shape, np.float32), faint)
    points = np.round(np.array(places), 6)[:, None] + np.array([[0.0, 0.0], [0.5, 3.0]])
    assert np.array_equal(sheet.marked(points), sample(faint, points) > 0)
