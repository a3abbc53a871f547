"""Corrections spread over a path: least squares of scipy must say the same."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.optimize import least_squares

from veduta.drive.read.pose_graph import Fix, Step, spread_corrections
from veduta.drive.read.scan_match import between, joined

Floats = NDArray[np.float64]


def _square(seed: int) -> tuple[Floats, list[Step], Floats]:
    """A square with a side of ten steps: its true poses, noisy steps, and their chain."""
    random = np.random.default_rng(seed)
    truth, steps = [np.zeros(3)], []
    covariance = np.diag([0.02**2, 0.02**2, 0.01**2])
    for row in range(40):
        step = np.array([1.0, 0.0, np.pi / 2 if row % 10 == 9 else 0.0])
        truth.append(joined(truth[-1], step))
        steps.append(Step(row, row + 1, step + random.normal(0, [0.02, 0.02, 0.01]), covariance))
    chain = [np.zeros(3)]
    for noisy in steps:
        chain.append(joined(chain[-1], noisy.pose))
    return np.array(truth), steps, np.array(chain)


def _residuals(flat: Floats, steps: list[Step], fixes: list[Fix]) -> Floats:
    poses = flat.reshape(-1, 3)
    found = []
    for step in steps:
        off = between(step.pose, between(poses[step.first], poses[step.second]))
        seen = between(poses[step.first], poses[step.second]) - step.pose
        seen[2] = off[2]
        found.append(np.linalg.cholesky(np.linalg.inv(step.covariance)).T @ seen)
    for fix in fixes:
        away = poses[fix.node] - fix.pose
        away[2] = (away[2] + np.pi) % (2 * np.pi) - np.pi
        found.append(np.linalg.cholesky(np.linalg.inv(fix.covariance)).T @ away)
    return np.concatenate(found)


def test_closed_square_is_what_scipy_finds() -> None:
    truth, steps, chain = _square(3)
    loop = Step(0, 40, between(truth[0], truth[40]), np.diag([1e-4, 1e-4, 1e-5]))
    start = Fix(0, np.zeros(3), np.eye(3) * 1e-8)
    found = spread_corrections(chain, [*steps, loop], [])
    links, fixes = [*steps, loop], [start]
    other = least_squares(_residuals, chain.ravel(), xtol=1e-12, args=(links, fixes))
    off = found - other.x.reshape(-1, 3)
    assert np.abs(off[:, :2]).max() < 1e-4
    assert np.abs((off[:, 2] + np.pi) % (2 * np.pi) - np.pi).max() < 1e-4
    before = np.linalg.norm(chain[:, :2] - truth[:, :2], axis=1).max()
    after = np.linalg.norm(found[:, :2] - truth[:, :2], axis=1).max()
    assert after < 0.6 * before


def test_wrong_loop_weighs_little() -> None:
    truth, steps, chain = _square(5)
    right = [Step(0, 40, between(truth[0], truth[40]), np.diag([1e-3, 1e-3, 1e-4]), robust=True)]
    wrong = Step(5, 30, np.array([0.0, 0.0, 0.0]), np.diag([1e-3, 1e-3, 1e-4]), robust=True)
    with_both = spread_corrections(chain, [*steps, *right, wrong], [])
    off = np.linalg.norm(with_both[:, :2] - truth[:, :2], axis=1)
    assert off.max() < 0.5


def test_fixes_place_the_path_in_the_world() -> None:
    truth, steps, chain = _square(7)
    place = np.array([500.0, -200.0, 2.0])
    world = np.array([joined(place, pose) for pose in truth])
    fixes = [Fix(row, world[row], np.diag([0.01, 0.01, 0.001])) for row in range(0, 41, 4)]
    start = np.array([joined(place + np.array([3.0, -2.0, 0.2]), pose) for pose in chain])
    found = spread_corrections(start, steps, fixes)
    assert np.linalg.norm(found[:, :2] - world[:, :2], axis=1).max() < 0.15


@pytest.mark.parametrize("turn", [3.1, -3.1])
def test_headings_around_half_a_turn_do_not_jump(turn: float) -> None:
    step = Step(0, 1, np.array([1.0, 0.0, 0.2]), np.eye(3) * 0.01)
    start = np.array([[0.0, 0.0, turn], joined(np.array([0.0, 0.0, turn]), step.pose)])
    found = spread_corrections(
        start, [step], [Fix(0, start[0] + [0, 0, 2 * np.pi], np.eye(3) * 0.01)]
    )
    assert np.abs(np.sin(found[:, 2] - start[:, 2])).max() < 1e-6
