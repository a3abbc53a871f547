"""The distance between windows, from columns that repeat and from columns that do not."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from veduta.facade.bays import bay_width
from veduta.facade.evidence import Float


def columns(period: int, count: int, seed: int, noise: float) -> list[Float]:
    """Three channels whose columns repeat, `count` periods of them, each with its own noise."""
    rng = np.random.default_rng(seed)
    motif = rng.normal(size=(3, 60, period))
    motif = (motif + np.roll(motif, 1, axis=2) + np.roll(motif, 2, axis=2)) / 3**0.5
    channels = np.tile(motif, (1, 1, count)) + rng.normal(0, noise, (3, 60, period * count))
    return [(c / c.std()).astype(np.float32) for c in channels]


@given(st.integers(8, 40), st.integers(4, 9), st.integers(0, 1000), st.floats(0, 0.7))
def test_the_period_is_the_bay(period: int, count: int, seed: int, noise: float) -> None:
    assert bay_width(columns(period, count, seed, noise), 1) == period


@pytest.mark.parametrize("step", [1, 2, 3])
def test_it_is_counted_in_grid_columns(step: int) -> None:
    channels = [np.repeat(channel, step, axis=1) for channel in columns(20, 6, 1, 0.2)]
    assert bay_width(channels, step) == 20


@given(st.integers(0, 1000), st.integers(1, 300))
def test_noise_has_none(seed: int, width: int) -> None:
    rng = np.random.default_rng(seed)
    assert bay_width([rng.normal(size=(80, width)).astype(np.float32)], 1) is None


def test_two_windows_are_no_rhythm() -> None:
    """Mirrored about the middle, as on a house with a door between them."""
    half = columns(60, 1, 4, 0.0)
    assert bay_width([np.hstack([c, c[:, ::-1]]) for c in half], 1) is None
    assert bay_width(columns(60, 2, 4, 0.0), 1) is None
