"""Gaps and noise in the depths of one view, against planes whose depths are known everywhere."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from veduta.dense.build.depth_gaps import GapParameters, calmed, closed_gaps

RULE = GapParameters()
SHAPE = (90, 120)


def _slant() -> NDArray[np.float32]:
    row, column = np.indices(SHAPE)
    return np.asarray(1.0 / (0.1 + 0.0004 * column + 0.0002 * row), dtype=np.float32)


def test_pinholes_of_a_plane_are_closed_where_the_plane_is() -> None:
    truth = _slant()
    given = truth.copy()
    draw = np.random.default_rng(3)
    given[draw.random(SHAPE) < 0.05] = np.nan
    given[30:37, 50:58] = np.nan
    given[[0, -1]], given[:, [0, -1]] = truth[[0, -1]], truth[:, [0, -1]]
    closed = closed_gaps(given, RULE)
    assert np.isfinite(closed).all()
    known = np.isfinite(given)
    assert np.array_equal(closed[known], given[known])
    assert np.abs(closed / truth - 1.0).max() < 0.004


def test_what_is_no_small_gap_in_one_surface_stays_open() -> None:
    given = np.full(SHAPE, 10.0, dtype=np.float32)
    given[:, 60:] = 6.0
    given[40:44, 58:62] = np.nan  # between two surfaces
    given[10:30, 10:30] = np.nan  # large
    given[70:73, :2] = np.nan  # at the picture's border
    closed = closed_gaps(given, RULE)
    assert np.array_equal(np.isfinite(closed), np.isfinite(given))


def test_without_gaps_or_depths_nothing_changes() -> None:
    nothing = np.full(SHAPE, np.nan, dtype=np.float32)
    assert closed_gaps(nothing, RULE) is nothing
    assert calmed(nothing, RULE) is nothing
    whole = _slant()
    assert closed_gaps(whole, RULE) is whole


def test_noise_is_calmed_and_steps_stay_sharp() -> None:
    truth = np.where(np.indices(SHAPE)[1] < 60, 10.0, 6.0).astype(np.float32)
    draw = np.random.default_rng(4)
    noise = (1.0 + 0.005 * draw.standard_normal(SHAPE)).astype(np.float32)
    given = truth * noise
    given[20, 20:24] = np.nan
    calm = calmed(given, RULE)
    assert np.array_equal(np.isfinite(calm), np.isfinite(given))
    off, before = np.abs(calm / truth - 1.0), np.abs(given / truth - 1.0)
    assert np.nanmean(off) < 0.4 * np.nanmean(before)
    assert np.nanmax(off[:, 55:65]) < 0.015  # no depth between the two
