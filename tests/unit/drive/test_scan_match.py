"""2D scans of a drawn room matched onto each other: the true step must come out."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from veduta.drive.read.scan_match import between, joined, match_scans, moved

_WALLS = np.array([
    [[-6, -4], [7, -4]], [[7, -4], [7, 5]], [[7, 5], [2, 5]], [[2, 5], [2, 7]], [[2, 7], [-6, 7]],
    [[-6, 7], [-6, -4]], [[-2, 1], [-1, 2]],
], dtype=float)  # fmt: skip


def _scan(pose: NDArray[np.float64], sigma_m: float, seed: int) -> NDArray[np.float64]:
    """(n, 2) what 180 beams over 270 degrees see of the walls, in the scanner's frame."""
    angles = np.deg2rad(np.linspace(-135, 135, 180)) + pose[2]
    beams = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    nearest = np.full(len(beams), np.inf)
    for one, two in _WALLS:
        along = two - one
        cross = beams[:, 0] * along[1] - beams[:, 1] * along[0]
        offset = one - pose[:2]
        with np.errstate(divide="ignore", invalid="ignore"):
            distance = (offset[0] * along[1] - offset[1] * along[0]) / cross
            share = (offset[0] * beams[:, 1] - offset[1] * beams[:, 0]) / cross
        hit = (distance > 0) & (share >= 0) & (share <= 1)
        nearest = np.where(hit & (distance < nearest), distance, nearest)
    nearest = nearest + np.random.default_rng(seed).normal(0.0, sigma_m, len(nearest))
    local = angles - pose[2]
    return np.stack([np.cos(local), np.sin(local)], axis=1) * nearest[:, None]


@given(
    st.floats(-0.4, 0.4), st.floats(-0.4, 0.4), st.floats(-0.3, 0.3), st.integers(0, 1000)
)  # fmt: skip
@settings(max_examples=15)
def test_true_step_is_found_from_a_start_that_knows_nothing(
    x: float, y: float, turn: float, seed: int
) -> None:
    first, second = np.zeros(3), np.array([x, y, turn])
    found = match_scans(_scan(first, 0.01, seed), _scan(second, 0.01, seed + 1), np.zeros(3))
    np.testing.assert_allclose(found.pose[:2], second[:2], atol=0.02)
    assert abs(found.pose[2] - turn) < 0.01
    assert found.share > 0.8


def test_covariance_is_that_of_many_draws() -> None:
    step = np.array([0.2, 0.1, 0.05])
    found = [match_scans(_scan(np.zeros(3), 0.02, k), _scan(step, 0.0, k), step) for k in range(40)]
    spread = np.std([match.pose for match in found], axis=0)
    told = np.sqrt(np.mean([np.diag(match.covariance) for match in found], axis=0))
    assert ((spread / told > 0.3) & (spread / told < 3.0)).all()


def test_corridor_is_not_known_along_itself() -> None:
    x = np.linspace(-5, 5, 101)
    corridor = np.concatenate([np.stack([x, np.full(101, side)], axis=1) for side in (-1.5, 1.5)])
    found = match_scans(corridor, corridor, np.zeros(3))
    assert found.covariance[0, 0] > 100 * found.covariance[1, 1]


def test_too_few_points_match_nothing() -> None:
    found = match_scans(np.zeros((3, 2)), np.zeros((40, 2)), np.array([1.0, 2.0, 0.1]))
    assert found.share == 0.0
    np.testing.assert_array_equal(found.pose, [1.0, 2.0, 0.1])


@pytest.mark.parametrize("turn", [-3.0, 0.4, 3.0])
def test_steps_join_to_what_they_are_between(turn: float) -> None:
    first, second = np.array([1.0, -2.0, 2.5]), np.array([-0.5, 3.0, turn])
    joint = joined(first, between(first, second))
    np.testing.assert_allclose(joint[:2], second[:2], atol=1e-12)
    assert abs(np.sin(joint[2] - turn)) < 1e-12
    points = np.array([[1.0, 0.0], [0.3, 0.7]])
    relative = moved(first, moved(between(first, second), points))
    np.testing.assert_allclose(relative, moved(second, points), atol=1e-12)
