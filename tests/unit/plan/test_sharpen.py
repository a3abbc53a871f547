"""The scale by single readings, against sums and closed forms, and with wrong ones among them."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.stats import norm

from veduta.plan.scale.sharpen import Reading, sharpened

SIDES_PX = (120.0, 150.0, 190.0, 240.0, 300.0, 380.0, 460.0, 600.0)


def _reading(truth: float, error: float, pixels: float, sigma: float = 0.003) -> Reading:
    return Reading(math.log(truth) + error, sigma, 1.0, 1.0 / pixels)


def test_it_is_the_mean_over_all_scales_offsets_and_excesses() -> None:
    """Summed up term by term, by the formula of the mixture, with scipy's density."""
    rng = np.random.default_rng(3)
    readings = [
        Reading(math.log(0.02) + rng.normal(0.002, 0.004), 0.003, rng.uniform(0.3, 1.0), 1.0 / side)
        for side in SIDES_PX[:5]
    ]
    away = np.linspace(-0.02, 0.02, 401)
    likely = np.zeros(len(away))
    for excess, offset in itertools.product((1.0, 1.5, 2.2, 3.3), np.linspace(-1.0, 1.0, 9)):
        product = norm.pdf(away, scale=0.006) * norm.pdf(offset, scale=0.3) / excess
        for one in readings:
            expected = math.log(0.02) + away + one.per_px * offset
            right = norm.pdf(one.log_mpp, expected, one.sigma * excess)
            product = product * (0.2 * 10.0 + 0.8 * right) ** one.trust
        likely += product
    mean = 0.02 * math.exp(float(likely @ away / likely.sum()))
    assert sharpened(0.02, readings) == pytest.approx(mean, rel=1e-9)


def test_equal_readings_draw_the_vote_to_them_by_the_precision_of_both() -> None:
    """Of normal errors alone: the mean of vote and readings, weighed by 1 / sigma^2."""
    readings = [Reading(math.log(0.02) + 0.004, 0.003, 1.0, 0.0)] * 9
    precision = 9 / 0.003**2
    expected = 0.004 * precision / (precision + 1 / 0.006**2)
    assert math.log(sharpened(0.02, readings) / 0.02) == pytest.approx(expected, rel=0.02)


@settings(deadline=None, max_examples=40)
@given(st.floats(0.001, 0.1), st.floats(-0.008, 0.008), st.integers(0, 10_000))
def test_wrong_sides_do_not_matter(truth: float, vote: float, seed: int) -> None:
    """Three of eleven, too short by as much as furniture hides."""
    rng = np.random.default_rng(seed)
    right = [_reading(truth, rng.normal(0, 0.002), side) for side in SIDES_PX]
    wrong = [_reading(truth, rng.uniform(0.015, 0.03), side) for side in SIDES_PX[:3]]
    found = sharpened(truth * math.exp(vote), [*right, *wrong])
    assert found == pytest.approx(truth, rel=0.004)


def test_faces_that_lie_too_far_within_rooms_are_told_by_sides_of_different_lengths() -> None:
    """All sides half a pixel too short: at their mean, the scale would be too large by 0.2 %."""
    readings = [_reading(0.02, 0.5 / side, side, sigma=0.0005) for side in SIDES_PX]
    mean = float(np.mean([one.log_mpp for one in readings])) - math.log(0.02)
    assert mean > 0.0018
    assert abs(math.log(sharpened(0.02, readings) / 0.02)) < 0.25 * mean


def test_few_readings_leave_the_vote_as_it_is() -> None:
    readings = [_reading(0.02, 0.005, side) for side in SIDES_PX[:3]]
    assert sharpened(0.02, readings) == 0.02
    assert sharpened(0.02, []) == 0.02
