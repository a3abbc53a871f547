"""Floors that are alike from side to side, and what is only alike from floor to floor."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from veduta.facade.between import Between
from veduta.facade.boxes import Box
from veduta.facade.columns_alike import likeness_of_columns
from veduta.facade.extent import RowHistograms
from veduta.facade.floors import Floors
from veduta.facade.plausible import (
    HARDLY_ALIKE,
    NOT_IN_COLUMNS,
    NOT_PARTED,
    SINGLE,
    STOREY_DOUBTS,
    UNENDED,
    storey_doubts,
)
from veduta.facade.rows import Rows

FLOORS = Floors([10, 50, 90, 130], 40.0, -0.3, {}, 100)
SHAPE = (120, 160)


def windows(shifts: tuple[int, int, int] = (0, 0, 0)) -> NDArray[np.float32]:
    """Log-odds of windows of 20 x 20 px, 40 px apart, each floor's shifted by so many pixels."""
    scores = np.full(SHAPE, -1.0, np.float32)
    for floor, shift in enumerate(shifts):
        for x in range(10, 150, 40):
            scores[
                40 * floor + 10 : 40 * floor + 30, (x + shift) % 160 : (x + shift) % 160 + 20
            ] = 1
    return scores


def of(values: NDArray[np.floating]) -> float:
    """The likeness, which is there for three floors."""
    found = likeness_of_columns(np.asarray(values, np.float32), FLOORS)
    assert found is not None
    return found


def test_windows_above_each_other_are_alike() -> None:
    assert of(windows()) == pytest.approx(1.0)


def test_windows_over_piers_are_not() -> None:
    assert of(windows((0, 20, 0))) < -0.5


def test_rails_and_boards_are_nothing_but_rows_and_columns() -> None:
    """A sum of a profile down and one across has no interaction at all."""
    rng = np.random.default_rng(1)
    noise = 0.01 * rng.normal(size=SHAPE)
    fence = np.sin(np.arange(120) / 6)[:, None] + np.sign(np.sin(np.arange(160) / 3))[None]
    assert abs(of(fence + noise)) < 0.1


def test_chance_is_not_alike() -> None:
    rng = np.random.default_rng(2)
    assert abs(of(rng.normal(size=SHAPE))) < 0.1


def test_the_correlation_is_that_of_the_interaction() -> None:
    """Against numpy's, on floors of the size that they are compared at."""
    rng = np.random.default_rng(3)
    shared = rng.normal(size=(24, 160))
    bands = np.stack([shared + rng.normal(size=(24, 160)) for _ in range(3)]).astype(np.float32)
    floors = Floors([0, 24, 48, 72], 24.0, -0.3, {}, 100)
    centred = bands - bands.mean(2, keepdims=True)
    centred -= centred.mean((0, 1))
    pairs = ((0, 1), (1, 2))
    true = np.median([np.corrcoef(centred[a].ravel(), centred[b].ravel())[0, 1] for a, b in pairs])
    assert likeness_of_columns(bands.reshape(72, 160), floors) == pytest.approx(true, abs=0.01)


def _rows(bay: int | None) -> Rows:
    none = RowHistograms(np.zeros((2, 2, 64)))
    return Rows(1, 0, np.zeros((1, 1), np.float32), np.zeros(1, np.float32), none, bay)


def test_what_makes_storeys_doubtful() -> None:
    assert storey_doubts(_rows(None), FLOORS, windows(), []) == []
    assert storey_doubts(_rows(40), FLOORS, windows((0, 20, 0)), []) == [NOT_IN_COLUMNS]
    hardly = Floors(FLOORS.boundaries, 40.0, -0.1, {}, 100)
    assert storey_doubts(_rows(40), hardly, windows(), []) == [HARDLY_ALIKE]
    upper, lower = (Box("window", 10, y, 20, 40, n, 0, 0.9) for y, n in ((10, 3), (50, 2)))
    glass = [Between(upper, lower, 1.0)]
    assert storey_doubts(_rows(40), FLOORS, windows(), glass) == [NOT_PARTED]
    assert set(STOREY_DOUBTS) == {HARDLY_ALIKE, NOT_PARTED, NOT_IN_COLUMNS, SINGLE, UNENDED}


def test_a_single_floor_needs_bays() -> None:
    single = Floors([10, 130], 120.0, -0.3, {}, 100)
    assert likeness_of_columns(windows(), single) is None
    assert storey_doubts(_rows(None), single, windows(), []) == [SINGLE]
    assert storey_doubts(_rows(40), single, windows(), []) == []
