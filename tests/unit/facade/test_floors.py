"""The floors' chain against all labellings, and whole splits of drawn rows."""

from __future__ import annotations

import contextlib
import math
import warnings
from collections.abc import Iterator

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.typing import NDArray

from veduta import _core
from veduta.facade.extent import RowHistograms
from veduta.facade.floors import split_floors
from veduta.facade.rows import Rows
from veduta.run.errors import NotFoundError

ROWS, HEIGHTS = 13, [2, 3, 5]
SIMILARITY, HEIGHT_CHANGE = 0.7, 0.2
costs = arrays(np.float64, ROWS + 1, elements=st.floats(-1, 1))
distances = arrays(np.float32, (ROWS, ROWS), elements=st.floats(0, 2, width=32))


def _chains(count: int, heights: list[int], rows: int) -> Iterator[list[int]]:
    """All boundaries of `count` floors, one on the other."""
    stacks = [[top] for top in range(rows + 1)]
    for _ in range(count):
        stacks = [[*s, s[-1] + h] for s in stacks for h in heights if s[-1] + h <= rows]
    yield from stacks


def _energy(
    boundaries: list[int],
    distance: NDArray[np.float32],
    scale: tuple[list[int], float, NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]],
) -> float:
    """Equations 5 to 7 with the deviations that floors.py writes down, row by row."""
    _, neutral, eaves, boundary, ground = scale
    total = float(eaves[boundaries[0]] + ground[boundaries[-1]])
    for a, b, c in zip(boundaries[:-2], boundaries[1:-1], boundaries[2:], strict=True):
        above, below = b - a, c - b
        compared = min(above, below)
        unlike = np.mean([distance[a + j, b + j] for j in range(compared)], dtype=np.float64)
        total += SIMILARITY * (unlike - neutral) * below
        total += HEIGHT_CHANGE * abs(above - below)
        total += boundary[b] * (above + below) / 2
    return float(total)


@given(distances, costs, costs, costs, st.floats(0, 2))
def test_chain_is_the_best_of_all(
    distance: NDArray[np.float32],
    eaves: NDArray[np.float64],
    boundary: NDArray[np.float64],
    ground: NDArray[np.float64],
    neutral: float,
) -> None:
    distance = (distance + distance.T) / 2
    scale = (HEIGHTS, neutral, eaves, boundary, ground)
    (solved,) = _core.floor_chain(distance, [scale], SIMILARITY, HEIGHT_CHANGE, 5)
    assert len(solved) == 5
    for count, found in enumerate(solved, start=1):
        chains = list(_chains(count, HEIGHTS, ROWS))
        assert found is not None
        energy, boundaries = found
        assert boundaries in chains
        best = min(_energy(chain, distance, scale) for chain in chains)
        assert energy == pytest.approx(best, abs=1e-6)
        assert _energy(boundaries, distance, scale) == pytest.approx(energy, abs=1e-6)


@given(distances, st.lists(st.booleans(), min_size=ROWS + 1, max_size=ROWS + 1))
def test_forbidden_places_stay_empty(distance: NDArray[np.float32], allowed: list[bool]) -> None:
    eaves = np.where(allowed, 0.0, np.inf)
    zeros = np.zeros(ROWS + 1)
    scale = (HEIGHTS, 1.0, eaves, zeros, eaves[::-1].copy())
    (solved,) = _core.floor_chain(distance + distance.T, [scale], 1.0, 0.0, 3)
    for count, found in enumerate(solved, start=1):
        chains = _chains(count, HEIGHTS, ROWS)
        possible = [c for c in chains if allowed[c[0]] and allowed[ROWS - c[-1]]]
        assert (found is None) == (not possible)
        assert found is None or found[1] in possible


def test_each_scale_is_solved_by_itself() -> None:
    rng = np.random.default_rng(3)
    distance = rng.uniform(0, 2, (40, 40)).astype(np.float32)
    distance += distance.T
    lines = [rng.uniform(-1, 1, 41) for _ in range(6)]
    scales = [([4, 5, 6], 1.0, *lines[:3]), ([9, 10], 0.8, *lines[3:])]
    together = _core.floor_chain(distance, scales, 1.0, 0.5, 4)
    apart = [_core.floor_chain(distance, [scale], 1.0, 0.5, 4)[0] for scale in scales]
    assert together == apart


def test_wrong_sizes_and_labels_are_refused() -> None:
    distance, short, line = np.zeros((4, 4), np.float32), np.zeros(4), np.zeros(5)
    with pytest.raises(_core.ChainSizeError, match="eaves"):
        _core.floor_chain(distance, [([2], 1.0, short, line, line)], 1.0, 1.0, 2)
    for heights in ([], [0, 2]):
        with pytest.raises(_core.ChainLabelsError, match="heights"):
            _core.floor_chain(distance, [(heights, 1.0, line, line, line)], 1.0, 1.0, 2)


def test_a_periodic_facade_is_cut_at_its_period() -> None:
    """Rows of a noisy pattern that repeats every 12 rows: no other height is alike."""
    rng = np.random.default_rng(0)
    pattern = rng.normal(0, 1, (12, 30))
    rows = np.tile(pattern, (6, 1)) + rng.normal(0, 0.1, (72, 30))
    distance = ((rows[:, None] - rows[None]) ** 2).mean(-1).astype(np.float32)
    distance /= distance.mean()
    ends = np.full(73, math.inf)
    ends[[0, 12, 24]] = 0.0
    scale = (list(range(9, 16)), 0.85, ends, np.zeros(73), ends[::-1].copy())
    (solved,) = _core.floor_chain(distance, [scale], 1.0, 1.2, 8)
    best = min(found for found in solved if found is not None)
    assert best[1] == [0, 12, 24, 36, 48, 60, 72]


def test_next_to_no_rows_below_the_ridge_end_in_an_answer() -> None:
    """A storey may be higher than all that is left below the ridge."""
    rng = np.random.default_rng(2)
    distance = rng.random((90, 90)).astype(np.float32)
    histograms = RowHistograms(np.zeros((2, 91, 4)))
    for ridge in range(70, 90, 3):
        rows = Rows(1, ridge, distance, np.ones(90, np.float32), histograms)
        with contextlib.suppress(NotFoundError), warnings.catch_warnings():
            warnings.simplefilter("error")
            assert math.isfinite(split_floors(rows).energy)


def _rows_of(lines: NDArray[np.float64], bay: int | None) -> Rows:
    """Rows by what they look like (n, d), without edges and colours."""
    squares = (lines * lines).sum(1)
    distance = squares[:, None] + squares[None] - 2 * lines @ lines.T
    distance = (distance / distance.mean()).astype(np.float32)
    histograms = RowHistograms(np.zeros((2, len(lines) + 1, 4)))
    return Rows(1, 0, distance, np.ones(len(lines), np.float32), histograms, bay)


@pytest.mark.parametrize(("bay", "floors"), [(None, 7), (7, 7), (14, 14), (15, 14), (20, 7)])
def test_many_low_floors_need_bays_that_go_with_them(bay: int | None, floors: int) -> None:
    """Fourteen floors whose two kinds take turns: a pair of them repeats as well."""
    rng = np.random.default_rng(3)
    kinds = rng.normal(size=(14, 40)) + 0.45 * rng.normal(size=(2, 14, 40))
    front = np.concatenate([kinds[n % 2] for n in range(14)])
    lines = np.concatenate([rng.normal(size=(14, 40)), front, rng.normal(size=(20, 40))])
    split = split_floors(_rows_of(lines + 0.1 * rng.normal(size=lines.shape), bay))
    assert split.mean_storey == pytest.approx(196 / floors, rel=0.12)


def test_wide_bays_speak_against_low_storeys() -> None:
    """Rows that repeat at 20 and, in another part of their width, at 60: the bays decide."""
    rng = np.random.default_rng(5)
    third, storey = np.tile(rng.normal(size=(20, 30)), (3, 1)), rng.normal(size=(60, 12))
    floors = np.tile(np.hstack([third, storey]), (2, 1))
    lines = np.concatenate([rng.normal(size=(20, 42)), floors, rng.normal(size=(64, 42))])

    def storeys(bay: int | None) -> float:
        return split_floors(_rows_of(lines, bay)).mean_storey

    assert storeys(None) == pytest.approx(20, rel=0.1)
    assert storeys(20) == pytest.approx(20, rel=0.1)
    assert storeys(60) == pytest.approx(60, rel=0.1)
