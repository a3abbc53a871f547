"""What is carried over gaps: what one eye alone sees lies behind what is beside it."""

from __future__ import annotations

import numpy as np
import pytest

from veduta.walk.build.stereo import carried_over, farther_beside

GREY = np.full((20, 40, 3), 128, dtype=np.uint8)


def test_a_gap_between_near_and_far_is_far() -> None:
    disparity = np.full((20, 40), 10.0, dtype=np.float32)
    disparity[:, 20:] = 50.0
    disparity[:, 12:20] = np.nan  # seen by the left eye alone, beside the near thing
    picture = GREY.copy()
    picture[:, 20:] = 220
    assert carried_over(disparity, picture)[:, 12:20] == pytest.approx(10.0, abs=0.5)


def test_what_is_beside_is_the_lesser_of_the_nearest_known_ones() -> None:
    """By a loop over the pixels."""
    rng = np.random.default_rng(3)
    disparity = rng.uniform(1.0, 60.0, (6, 40)).astype(np.float32)
    disparity[rng.uniform(size=disparity.shape) < 0.6] = np.nan
    disparity[2] = np.nan
    beside = farther_beside(disparity, np.isfinite(disparity))
    for row, found in zip(disparity, beside, strict=True):
        for column in range(40):
            sides = [side[np.isfinite(side)] for side in (row[column::-1], row[column:])]
            known = [side[0] for side in sides if len(side)]
            assert found[column] == min(known) if known else np.isnan(found[column])


def test_rows_without_anything_known_are_filled_from_others() -> None:
    disparity = np.full((20, 40), np.nan, dtype=np.float32)
    disparity[:8] = 12.0
    filled = carried_over(disparity, GREY)
    assert np.isfinite(filled).all()
    assert filled[12:] == pytest.approx(12.0, abs=0.5)


def test_nothing_known_is_nothing() -> None:
    assert (carried_over(np.full((4, 6), np.nan, dtype=np.float32), GREY[:4, :6]) == 0).all()
