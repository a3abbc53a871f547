"""Sky and partings against brute force and scipy."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest
from drawn_facade import draw_facade, rectified_of
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.typing import NDArray
from scipy.stats import wasserstein_distance

from veduta import _core
from veduta.facade.evidence import Evidence, gather
from veduta.facade.extent import RowHistograms, Skyline, find_skyline, ridge_row, row_histograms
from veduta.facade.regions import region_colours

ROWS, COLUMNS = 4, 5


@given(
    arrays(np.float32, (ROWS, COLUMNS), elements=st.floats(-4, 4, width=32)),
    st.floats(0, 2, width=32),
    st.floats(0, 4, width=32),
)
def test_skyline_is_the_best_of_all(unary: NDArray[np.float32], slope: float, jump: float) -> None:
    def energy(rows: tuple[int, ...] | list[int]) -> float:
        steps = np.abs(np.diff(rows))
        own = unary[list(rows), range(COLUMNS)].sum(dtype=np.float64)
        return float(own + np.minimum(slope * steps, jump).sum())

    found = _core.skyline_chain(unary, slope, jump)
    best = min(energy(rows) for rows in product(range(ROWS), repeat=COLUMNS))
    assert energy(found) == pytest.approx(best, abs=1e-4)


@given(arrays(np.float32, (6, 3), elements=st.floats(-4, 4, width=32)))
def test_a_free_skyline_takes_each_column_s_least(unary: NDArray[np.float32]) -> None:
    found = _core.skyline_chain(unary, 0.0, 0.0)
    assert unary[found, range(3)] == pytest.approx(unary.min(axis=0), abs=1e-6)


def test_an_empty_skyline_is_refused() -> None:
    with pytest.raises(_core.ChainLabelsError):
        _core.skyline_chain(np.zeros((0, 3), np.float32), 1.0, 1.0)


def _evidence(chroma: NDArray[np.float32]) -> Evidence:
    """Evidence without edges of an (h, w, 2) picture of a and b."""
    lab = np.dstack([np.full(chroma.shape[:2], 128, np.float32), chroma])
    zeros = np.zeros(chroma.shape[:2], np.float32)
    return Evidence(1.0, lab, zeros, zeros, np.ones(chroma.shape[:2], bool))


@given(
    arrays(np.float32, (14, 6, 2), elements=st.integers(0, 63).map(lambda v: 4.0 * v)),
    st.integers(1, 5),
)
def test_parting_is_the_earth_mover_s_distance(chroma: NDArray[np.float32], half: int) -> None:
    """On both marginals of chroma, which are quantised to bins of 4."""
    bins = np.arange(0, 257, 4)
    counts = [[np.histogram(row[:, c], bins)[0] for row in chroma] for c in range(2)]
    running = np.zeros((2, 15, 64))
    running[:, 1:] = np.cumsum(counts, axis=1)
    parting = RowHistograms(running).parting(half)
    assert parting.shape == (15,)
    for row in range(1, 14):
        above, below = chroma[max(0, row - half) : row], chroma[row : row + half]
        pairs = [(above[:, :, c].ravel(), below[:, :, c].ravel()) for c in range(2)]
        true = sum(wasserstein_distance(a, b) for a, b in pairs)
        assert parting[row] == pytest.approx(true, abs=1e-6)


def test_sky_and_edges_are_left_out_of_the_histograms() -> None:
    rng = np.random.default_rng(1)
    chroma = rng.integers(0, 256, (30, 8, 2)).astype(np.float32)
    evidence = _evidence(chroma)
    rows = rng.integers(0, 12, 8)
    edges = rng.random((30, 8)) < 0.2
    evidence.gx[edges] = 99.0
    evidence.valid[:, 7] = False
    histograms = row_histograms(evidence, Skyline(rows, 0))
    kept = (np.arange(30)[:, None] >= rows[None]) & ~edges & evidence.valid
    per_row = np.diff(histograms.running, axis=1).sum(-1)
    assert per_row.tolist() == [kept.sum(1).tolist()] * 2


def test_regions_take_their_mean_colour() -> None:
    """Grain is averaged away within each of four fields, and the fields stay apart."""
    rng = np.random.default_rng(2)
    lab = np.empty((60, 80, 3), np.float32)
    fields = [np.s_[:30, :40], np.s_[:30, 40:], np.s_[30:, :40], np.s_[30:, 40:]]
    for i, field in enumerate(fields):
        lab[field] = (60 + 40 * i, 110 + 15 * i, 170 - 20 * i)
    grain = lab + rng.normal(0, 1.0, lab.shape).astype(np.float32)
    zeros = np.zeros(lab.shape[:2], np.float32)
    found = region_colours(Evidence(1.0, grain, zeros, zeros, zeros == 0))
    for field in fields:
        inner = found[field][4:-4, 4:-4]
        assert np.ptp(inner.reshape(-1, 3), axis=0).max() < 1e-3
        assert np.abs(inner - grain[field].mean((0, 1))).max() < 1.5
    assert found.mean((0, 1)) == pytest.approx(grain.mean((0, 1)), abs=1e-2)


@pytest.mark.parametrize("shadow", [False, True])
def test_the_sky_of_a_drawn_facade(shadow: bool) -> None:
    drawn = draw_facade(4, shadow=shadow)
    skyline = find_skyline(gather(*_seen(drawn.pixels)))
    assert skyline.reason == ""
    assert np.abs(skyline.rows - drawn.ridge).max() <= 2
    assert abs(skyline.level - drawn.ridge) <= 2


def test_chimneys_reach_above_the_level() -> None:
    drawn = draw_facade(4)
    drawn.pixels[drawn.ridge - 40 : drawn.ridge, 60:90] = (120, 70, 60)
    skyline = find_skyline(gather(*_seen(drawn.pixels)))
    assert abs(skyline.level - drawn.ridge) <= 2
    assert np.abs(skyline.rows[62:88] - (drawn.ridge - 40)).max() <= 2


def test_no_sky_says_why() -> None:
    drawn = draw_facade(4)
    cut = drawn.pixels[drawn.boundaries[0] + 10 :]  # begins within the wall
    skyline = find_skyline(gather(*_seen(np.ascontiguousarray(cut))))
    assert skyline.rows.sum() == 0
    assert skyline.reason


def test_a_wall_of_the_sky_s_colour_is_no_sky() -> None:
    """Plain rows of wall over windows: without a sky, whatever is bright at the upper edge."""
    rng = np.random.default_rng(3)
    pixels = np.full((360, 300, 3), 170, np.float64)
    pixels[:30] += 12
    for y in range(40, 330, 80):
        for x in range(20, 280, 60):
            pixels[y : y + 45, x : x + 25] = rng.integers(30, 200, (45, 25, 1))
    pixels += rng.normal(0, 2, pixels.shape)
    skyline = find_skyline(gather(*_seen(pixels.clip(0, 255).astype(np.uint8))))
    assert skyline.level <= 40


def test_the_ridge_is_not_looked_for_under_sides_that_lean() -> None:
    """Columns under a side of the photo begin where the side is, not where the roof is."""
    at = np.arange(200)
    first = np.where(at < 80, 10 + at // 4, 30 + 3 * (at - 80))
    valid = np.arange(400)[:, None] >= first[None]
    rows = np.maximum(first, 50)
    assert ridge_row(rows, valid) == 50
    assert ridge_row(rows, np.ones_like(valid)) == np.percentile(rows, 60).astype(int)


def test_without_sky_the_facade_begins_where_the_photo_does() -> None:
    drawn = draw_facade(4)
    cut = np.ascontiguousarray(drawn.pixels[drawn.boundaries[0] + 10 :])
    pixels, valid = _seen(cut)
    valid[:20] = False
    skyline = find_skyline(gather(pixels, valid))
    assert skyline.reason
    assert (skyline.rows == 20).all()
    assert skyline.level == 20


def _seen(pixels: NDArray[np.uint8]) -> tuple[NDArray[np.uint8], NDArray[np.bool_]]:
    rectified = rectified_of(pixels)
    return rectified.pixels, rectified.valid
