"""States, the motion graph and its walks, the tail after the head, a swimmer's wave."""

from __future__ import annotations

import numpy as np
import pytest

from veduta.fauna.motion.angles import angles_of, axis_of, coefficients
from veduta.fauna.motion.follow import follow_head, own_share
from veduta.fauna.motion.gaits import roamed_gait
from veduta.fauna.motion.graph import closed_walk, interpolated, motion_graph, walk
from veduta.fauna.motion.states import (
    StateSampling,
    curvature_range,
    draw_states,
    largest_step,
    without_turn,
)
from veduta.fauna.motion.wave import swimming_wave


@pytest.fixture(scope="module")
def seen() -> np.ndarray:
    """States of a wave that runs down a body, with a slowly changing size."""
    along, times = np.linspace(0.0, 1.0, 100), np.arange(80) * 0.02
    size = 0.5 + 0.3 * np.sin(1.3 * times)[:, None]
    angles = size * np.sin(2.0 * np.pi * (1.1 * along[None, :] - 1.7 * times[:, None]))
    return without_turn(coefficients(angles))


def _components(edges: np.ndarray) -> int:
    """By flooding: another way than a spanning tree."""
    left, count = set(range(len(edges))), 0
    while left:
        count += 1
        front = {left.pop()}
        while front:
            front = {int(q) for p in front for q in np.flatnonzero(edges[p])} & left
            left -= front
    return count


def test_drawn_states_obey_equation_8_and_bend_as_the_animal_did(seen: np.ndarray) -> None:
    drawn = draw_states(seen, StateSampling(count=50), 3).states
    assert len(drawn) == 50
    low, high = np.abs(seen[:, 1:]).min(axis=0), np.abs(seen[:, 1:]).max(axis=0)
    assert (np.abs(drawn[:, 1:]) >= low - 1e-12).all()
    assert (np.abs(drawn[:, 1:]) <= high + 1e-12).all()
    least, most = curvature_range(seen, 100)
    slack = 0.05 * (most - least) / 2.0
    bends = np.diff(angles_of(drawn, 100), axis=1) * 100
    assert bends.min() >= least - slack - 1e-9
    assert bends.max() <= most + slack + 1e-9


def test_the_threshold_is_the_least_that_joins_all(seen: np.ndarray) -> None:
    graph = motion_graph(np.concatenate([seen, draw_states(seen, StateSampling(40), 0).states]))
    apart = np.linalg.norm(graph.states[:, None, 1:] - graph.states[None, :, 1:], axis=2)
    np.fill_diagonal(apart, np.inf)
    assert _components(apart <= graph.threshold) == 1
    assert _components(apart < graph.threshold * (1.0 - 1e-9)) == 2
    assert np.array_equal(graph.edges, apart <= graph.threshold)


def test_a_walk_takes_the_neighbour_of_the_largest_w(seen: np.ndarray) -> None:
    graph = motion_graph(seen)
    steps = walk(graph, 5, 60)
    degree, visits = graph.edges.sum(axis=1), np.zeros(len(seen))
    visits[5] = 1
    for before, after in zip(steps, steps[1:], strict=False):
        around = np.flatnonzero(graph.edges[before])
        worth = degree[around] / 2.0 ** visits[around]
        assert worth[list(around).index(after)] == pytest.approx(worth.max())
        visits[after] += 1


def test_a_closed_walk_comes_back_along_edges(seen: np.ndarray) -> None:
    graph = motion_graph(seen)
    steps = closed_walk(graph, 7, 25)
    assert steps[0] == steps[-1] == 7
    assert all(graph.edges[a, b] for a, b in zip(steps, steps[1:], strict=False))


def test_interpolation_never_turns_faster_than_the_footage(seen: np.ndarray) -> None:
    graph = motion_graph(np.concatenate([seen, draw_states(seen, StateSampling(30), 1).states]))
    most = np.maximum(largest_step(seen, 100), 1e-3)
    frames = interpolated(graph.states, walk(graph, 0, 40), most)
    assert (np.abs(np.diff(angles_of(frames, 100), axis=0)) <= most + 1e-9).all()


def test_the_tail_goes_where_the_head_was() -> None:
    frames = 0.4 * np.sin(2.0 * np.pi * np.arange(300) / 60.0)[:, None] * np.ones(50)
    followed = follow_head(frames, periodic=True)
    share = own_share(50)
    behind = int(np.flatnonzero(share == 0.0)[0])
    assert np.allclose(followed[1:, behind + 1 :], followed[:-1, behind:-1])
    expected = share * frames[10] + (1.0 - share) * np.r_[followed[9, :1], followed[9, :-1]]
    assert np.allclose(followed[10], expected)


def test_a_land_snake_slides_in_its_own_track(seen: np.ndarray) -> None:
    gait = roamed_gait("slither", seen, 0.02, StateSampling(30), 0, 4.0, 0.4, follows=True)
    axes = axis_of(gait.angles) + gait.middle[:, None]
    front = axes[:, 20]  # where a point behind the head goes, and went in the cycles before
    track = np.concatenate([front - [n * gait.stride, 0.0] for n in range(4)])
    tail = axes[:, 70]
    apart = np.linalg.norm(tail[:, None] - track[None], axis=2).min(axis=1)
    assert apart.max() < 0.01
    assert gait.middle[0, 1] == pytest.approx(gait.middle[-1, 1], abs=1e-9)
    assert np.allclose(gait.angles[0], gait.angles[-1])


def test_the_wave_of_a_swimmer_is_found_again() -> None:
    along, times = np.linspace(0.0, 1.0, 60), np.arange(90) * 0.02
    size, phase = 0.1 + 0.5 * along, -2.0 * np.pi * 0.9 * along
    clean = size * np.cos(2.0 * np.pi * 3.3 * times[:, None] + phase)
    noisy = clean + np.random.default_rng(4).normal(0.0, 0.05, clean.shape)
    wave = swimming_wave(noisy + 0.3 * times[:, None], times)
    assert wave.frequency_hz == pytest.approx(3.3, rel=0.01)
    assert wave.share > 0.9
    apart = np.abs(wave.at(3.3 * times) - wave.mean - clean)
    assert apart.max() < 0.06
