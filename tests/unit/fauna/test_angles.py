"""Angles of an axis, their coefficients, and the axis again."""

from __future__ import annotations

import numpy as np

from veduta.fauna.motion.angles import (
    angles_of,
    axis_angles,
    axis_of,
    coefficients,
    equal_steps,
    extended,
)


def _spiral(turns: float, count: int) -> np.ndarray:
    angle = np.linspace(0.0, 2.0 * np.pi * turns, count)
    return np.stack([(1.0 + angle) * np.cos(angle), (1.0 + angle) * np.sin(angle)], axis=1)


def test_equal_steps_are_equal_along_a_circle() -> None:
    angle = np.linspace(0.0, np.pi, 2000) ** 2 / np.pi  # unevenly sampled
    points = equal_steps(np.stack([np.cos(angle), np.sin(angle)], axis=1)[None], 11)[0]
    exact = np.linspace(0.0, np.pi, 11)
    assert np.allclose(points, np.stack([np.cos(exact), np.sin(exact)], axis=1), atol=1e-5)


def test_angles_have_no_jump_over_several_turns() -> None:
    points = equal_steps(_spiral(3.0, 9000)[None], 801)
    angles = axis_angles(points)[0]
    assert np.abs(np.diff(angles)).max() < 0.5
    assert abs(angles[-1] - angles[0]) > 2.0 * np.pi * 2.5


def test_frames_are_brought_together_by_whole_turns() -> None:
    line = np.stack([np.linspace(1.0, 0.0, 21), np.zeros(21)], axis=1)
    spin = np.linspace(0.0, 6.0 * np.pi, 60)
    turns = np.stack(
        [np.stack([np.cos(a) * line[:, 0], np.sin(a) * line[:, 0]], axis=1) for a in spin]
    )
    assert np.allclose(axis_angles(turns).mean(axis=1), spin)


def test_the_extension_begins_anew_without_a_jump() -> None:
    angles = np.linspace(0.3, 2.0, 100)[None] ** 2
    signal = np.concatenate([extended(angles), extended(angles)], axis=1)[0]
    inside = np.abs(np.diff(angles[0])).max()
    assert np.abs(np.diff(signal)).max() < 5.0 * inside


def test_states_keep_the_shape_of_a_smooth_axis() -> None:
    along = np.linspace(0.0, 1.0, 100)
    angles = np.stack([0.8 * np.sin(2.0 * np.pi * (along - t)) for t in (0.0, 0.2, 0.7)])
    again = axis_of(angles_of(coefficients(angles), 100))
    assert np.linalg.norm(again - axis_of(angles), axis=2).max() < 0.01


def test_a_state_is_the_same_wherever_the_axis_is_and_however_it_is_turned() -> None:
    random = np.random.default_rng(1)
    angles = np.cumsum(random.normal(0.0, 0.05, 101))
    points = axis_of(angles[None], 1.0)[0]
    turn = np.array([[np.cos(2.0), -np.sin(2.0)], [np.sin(2.0), np.cos(2.0)]])
    moved = 3.0 * points @ turn.T + [4.0, -2.0]
    states = [coefficients(axis_angles(p[None]))[0, 1:] for p in (points, moved)]
    assert np.allclose(*states, atol=1e-9)


def test_the_axis_has_its_middle_at_the_origin_and_its_length() -> None:
    points = axis_of(np.random.default_rng(2).normal(0.0, 0.1, (3, 50)), 2.0)
    middle = 0.5 * (points[:, 1:] + points[:, :-1])
    assert np.allclose(middle.mean(axis=1), 0.0)
    assert np.allclose(np.linalg.norm(np.diff(points, axis=1), axis=2).sum(axis=1), 2.0)
