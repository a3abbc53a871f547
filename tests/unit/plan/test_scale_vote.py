"""The vote finds the scale that most evidence means, whatever the rest says."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from veduta.plan.scale.evidence import Hypothesis, Voter, side_sigma
from veduta.plan.scale.vote import take_vote


def _voter(number: int, scales: list[float], sigma: float = 0.01) -> Voter:
    readings = tuple(Hypothesis(math.log(scale), sigma, 1.0) for scale in scales)
    return Voter("dimension", f"text {number}", f"room {number}", readings)


@given(st.floats(0.001, 0.1), st.integers(0, 10_000))
def test_four_of_ten_wrong_do_not_matter(truth: float, seed: int) -> None:
    rng = np.random.default_rng(seed)
    right = [_voter(i, [truth * math.exp(rng.normal(0, 0.01))]) for i in range(6)]
    # Wrong sizes: anywhere between a third and three times, but not all at one place.
    wrong = [_voter(10 + i, [truth * 3.0 ** (2 * (i + rng.uniform()) / 4 - 1)]) for i in range(4)]
    verdict = take_vote([*wrong, *right])
    assert verdict.metres_per_px == pytest.approx(truth, rel=0.03)
    assert sum(verdict.agrees[4:]) >= 5


@given(st.floats(0.001, 0.1), st.floats(0.2, 5.0), st.integers(0, 1000))
def test_another_resolution_gives_the_same_verdict(truth: float, factor: float, seed: int) -> None:
    rng = np.random.default_rng(seed)
    scales = [[truth * math.exp(rng.normal(0, 0.05)) for _ in range(2)] for _ in range(5)]
    one = take_vote([_voter(i, pair) for i, pair in enumerate(scales)])
    other = take_vote([_voter(i, [factor * v for v in pair]) for i, pair in enumerate(scales)])
    assert other.metres_per_px == pytest.approx(factor * one.metres_per_px, rel=1e-6)
    assert other.agrees == one.agrees


def test_alternatives_are_settled_by_the_others() -> None:
    """`345` is 3.45 m or 0.345 m: each alone is in doubt, together one scale fits all."""
    truth, lengths_cm, rng = 0.02, [345, 250, 412, 180], np.random.default_rng(1)
    voters = [
        _voter(i, [length / 100 / px, length / 1000 / px, rng.uniform(0.5, 2.0) * truth])
        for i, length in enumerate(lengths_cm)
        for px in [length / 100 / truth]
    ]
    doors = Voter("door", "", "doors", (Hypothesis(math.log(0.022), 0.12, 1.0),), mass=0.3)
    verdict = take_vote([*voters, doors])
    assert verdict.metres_per_px == pytest.approx(truth, rel=1e-3)


def test_equal_evidence_is_averaged_by_precision() -> None:
    """The closed form: the mean of logarithms, weighted by 1 / sigma^2 (within the taper)."""
    logs, sigmas = np.array([0.0, 0.006]), np.array([0.01, 0.02])
    voters = [
        Voter("area", "", f"{i}", (Hypothesis(math.log(0.02) + logs[i], sigmas[i], 1.0),))
        for i in range(2)
    ]
    verdict = take_vote(voters)
    weights = sigmas**-2.0
    expected = 0.02 * math.exp(float(weights @ logs / weights.sum()))
    assert verdict.metres_per_px == pytest.approx(expected, rel=3e-4)


def test_two_camps_are_told_of() -> None:
    camps = [_voter(i, [0.02]) for i in range(4)] + [_voter(9 + i, [0.03]) for i in range(3)]
    verdict = take_vote(camps)
    assert verdict.metres_per_px == pytest.approx(0.02, rel=1e-6)
    assert verdict.rival_mpp == pytest.approx(0.03, rel=1e-6)
    assert verdict.rival_share == pytest.approx(0.75, rel=1e-6)


def test_a_size_in_feet_and_metres_is_one_measurement() -> None:
    """Two texts of one wrong room do not outvote two rooms."""
    wrong = [Voter("dimension", "", "room 0", (Hypothesis(math.log(0.04), 0.01, 1.0),))] * 2
    right = [_voter(1, [0.02]), _voter(2, [0.02])]
    assert take_vote([*wrong, *right]).metres_per_px == pytest.approx(0.02, rel=1e-6)


@given(st.floats(1.0, 20.0), st.floats(30.0, 1000.0), st.integers(0, 1000))
def test_the_stated_precision_of_a_side_is_that_of_rounding(
    metres: float, pixels: float, seed: int
) -> None:
    """Against simulation: a length rounded to 5 cm, with both ends off by 1 px (normal)."""
    rng = np.random.default_rng(seed)
    true = metres + rng.uniform(-0.025, 0.025, 4000)
    spans = pixels + math.sqrt(2) * rng.normal(0, 1.0, 4000)
    measured = float(np.std(np.log(true / metres) + np.log(spans / pixels)))
    stated = side_sigma(metres, pixels, 0.05, 1.0)
    assert stated == pytest.approx(math.hypot(measured, 0.002), rel=0.1)
