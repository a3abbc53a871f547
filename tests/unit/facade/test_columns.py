"""The window stripes' chain against all labellings."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.typing import NDArray

from veduta import _core
from veduta.facade.appearance import Scores
from veduta.facade.columns import split_columns
from veduta.facade.evidence import Evidence

WIDTH, WIDTHS, GAPS = 14, [2, 3, 4], (1, 5)
WEIGHTS = {
    "jamb_weight": 0.3,
    "similarity": 0.4,
    "width_change": 0.1,
    "gap_symmetry": 0.2,
    "neutral": 1.0,
}
Stripes = list[tuple[int, int]]


def _all_stripes(step: int) -> Iterator[Stripes]:
    """Every choice of stripes at multiples of `step` with allowed widths and gaps."""
    labels = [(x, w) for x in range(0, WIDTH, step) for w in WIDTHS if x + w <= WIDTH]
    chains: list[Stripes] = [[]]
    while chains:
        yield from chains
        chains = [
            [*chain, (x, w)]
            for chain in chains
            for x, w in labels
            if not chain or GAPS[0] <= x - sum(chain[-1]) <= GAPS[1]
        ]


def _mirror(distance: NDArray[np.float32], start: int, end: int) -> float:
    """Mean dissimilarity of a stretch and its mirror image (equation 8)."""
    half = (end - start) // 2
    values = [distance[start + i, end - 1 - i] for i in range(half)]
    return float(np.mean(values, dtype=np.float64)) if half else 0.0


def _energy(
    stripes: Stripes,
    distance: NDArray[np.float32],
    evidence: NDArray[np.float64],
    jamb: NDArray[np.float64],
) -> float:
    """Pixel by pixel: evidence in stripes earns, outside it costs; then the pairs."""
    k = WEIGHTS
    inside = np.zeros(WIDTH, bool)
    total = 0.0
    for x, w in stripes:
        inside[x : x + w] = True
        total -= k["jamb_weight"] * (jamb[x] + jamb[x + w])
    total += evidence[~inside].sum() - evidence[inside].sum()
    for (x, w), (next_x, next_w) in pairwise(stripes):
        gap = x + w
        alike = [distance[x + j, next_x + j] for j in range(min(w, next_w))]
        unlike = float(np.mean(alike, dtype=np.float64)) - k["neutral"]
        total += k["similarity"] * unlike * next_w + k["width_change"] * abs(w - next_w)
        symmetry = _mirror(distance, gap, next_x) - k["neutral"]
        total += k["gap_symmetry"] * symmetry * (next_x - gap)
    return float(total)


@given(
    arrays(np.float32, (WIDTH, WIDTH), elements=st.floats(0, 2, width=32)),
    arrays(np.float64, WIDTH, elements=st.floats(-1, 1)),
    arrays(np.float64, WIDTH + 1, elements=st.floats(-1, 1)),
    st.integers(1, 2),
)
def test_chain_is_the_best_of_all(
    distance: NDArray[np.float32],
    evidence: NDArray[np.float64],
    jamb: NDArray[np.float64],
    step: int,
) -> None:
    distance = (distance + distance.T) / 2
    energy, stripes = _core.column_chain(
        distance, evidence, jamb, WIDTHS, step=step, gap_min=GAPS[0], gap_max=GAPS[1], **WEIGHTS
    )
    choices = list(_all_stripes(step))
    assert stripes in choices
    best = min(_energy(choice, distance, evidence, jamb) for choice in choices)
    assert energy == pytest.approx(best, abs=1e-6)
    assert _energy(stripes, distance, evidence, jamb) == pytest.approx(energy, abs=1e-6)


def test_all_choices_are_tried() -> None:
    """The oracle itself: one stripe of width w fits at 14 - w + 1 places."""
    single = [choice for choice in _all_stripes(1) if len(choice) == 1]
    assert len(single) == sum(WIDTH - w + 1 for w in WIDTHS)
    assert [] in list(_all_stripes(1))
    assert max(len(choice) for choice in _all_stripes(1)) == 5  # 2 and a gap of 1, five times


def test_wrong_sizes_are_refused() -> None:
    distance, evidence = np.zeros((6, 6), np.float32), np.zeros(6)
    given_ = {"step": 1, "gap_min": 1, "gap_max": 3, **WEIGHTS}
    with pytest.raises(_core.ChainSizeError, match="jamb"):
        _core.column_chain(distance, evidence, np.zeros(6), [2], **given_)
    with pytest.raises(_core.ChainSizeError, match="distance"):
        _core.column_chain(distance[:5], evidence, np.zeros(7), [2], **given_)
    with pytest.raises(_core.ChainLabelsError, match="widths"):
        _core.column_chain(distance, evidence, np.zeros(7), [], **given_)
    with pytest.raises(_core.ChainLabelsError, match="step"):
        _core.column_chain(distance, evidence, np.zeros(7), [2], **{**given_, "step": 0})


@pytest.mark.parametrize("cue", ["window", "level"])
def test_stripes_are_where_windows_or_level_edges_are(cue: str) -> None:
    rows, width, storey = 120, 200, 60.0
    drawn = [(20, 24), (80, 24), (140, 24)]
    flat = np.zeros((rows, width), np.float32)
    shown = np.random.default_rng(0).normal(-0.5, 0.2, flat.shape).astype(np.float32)
    jambs = flat.copy()
    for x, w in drawn:
        shown[10:50, x : x + w] += 1.2
        shown[70:110, x : x + w] += 1.2
        jambs[:, [x - 1, x, x + w - 1, x + w]] = 15.0
    evidence = Evidence(1.0, np.zeros((rows, width, 3), np.float32), jambs, flat, flat == 0)
    scores = Scores(flat, flat, flat)
    found = split_columns(evidence, 0, rows, storey, replace(scores, **{cue: shown})).stripes
    assert len(found) == len(drawn)
    np.testing.assert_allclose(found, drawn, atol=2)
