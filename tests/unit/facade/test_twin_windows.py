"""Wide stripes are parted at a pier, and only there."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.typing import NDArray

from veduta.facade.twin_windows import part_twins

STOREY, WIDTH, ROWS = 100, 160, 40
STRIPE = (40, 70)


def _drawn(
    *windows: tuple[int, int], pier: float
) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Scores of windows (x, width) with `pier` between them in the stripe, and their edges."""
    score = np.full((ROWS, WIDTH), -1.0, np.float32)
    score[:, STRIPE[0] : sum(STRIPE)] = pier
    gx = np.zeros_like(score)
    for x, w in windows:
        score[:, x : x + w] = 0.9
        gx[:, [x - 1, x + w - 1]] = 20.0
    return score, gx


def _parts(
    score: NDArray[np.float32], gx: NDArray[np.float32], stripe: tuple[int, int] = STRIPE
) -> list[tuple[int, int]]:
    (parts,) = part_twins([stripe], score, gx, [np.ones(ROWS, bool)], STOREY)
    return parts


@pytest.mark.parametrize("pier", [6, 12, 20])
def test_a_pier_parts_two_windows(pier: int) -> None:
    width = (70 - pier) // 2
    windows = [(40, width), (40 + width + pier, 70 - width - pier)]
    assert _parts(*_drawn(*windows, pier=0.3)) == windows


@pytest.mark.parametrize(
    ("windows", "pier"),
    [
        ([(40, 70)], 0.3),  # one wide window
        ([(40, 34), (76, 34)], 0.75),  # its middle rail: 6 cm
        ([(40, 28), (80, 30)], 0.8),  # what is between looks like a window too
        ([(40, 15), (65, 45)], 0.3),  # a window and a narrow one beside it
    ],
)
def test_other_stripes_stay(windows: list[tuple[int, int]], pier: float) -> None:
    assert _parts(*_drawn(*windows, pier=pier)) == [STRIPE]


def test_a_stripe_of_one_window_is_too_narrow() -> None:
    score, gx = _drawn((40, 18), (64, 18), pier=0.3)
    assert _parts(score, gx, (40, 42)) == [(40, 42)]


@given(arrays(np.float32, (1, WIDTH), elements=st.floats(-1.5, 1.5, width=32)), st.data())
def test_parts_lie_in_their_stripe(line: NDArray[np.float32], data: st.DataObject) -> None:
    x = data.draw(st.integers(0, WIDTH - 1))
    stripe = (x, data.draw(st.integers(1, WIDTH - x)))
    gx = np.gradient(line, axis=1).astype(np.float32) * 20
    (parts,) = part_twins([stripe], line, gx, [np.ones(1, bool)], STOREY)
    assert parts[0][0] == x
    assert sum(parts[-1]) == sum(stripe)
    for (left, width), (right, _) in zip(parts[:-1], parts[1:], strict=True):
        assert left + width + 0.03 * STOREY <= right
    assert len(parts) == 1 or min(w for _, w in parts) >= 0.15 * STOREY
