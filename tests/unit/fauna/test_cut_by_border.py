"""An animal with legs that enters or leaves the frame: what is seen of it is used, and told."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import pytest

from veduta.fauna.document.plan import load_plan
from veduta.fauna.limbed_recipe import fewer
from veduta.fauna.motion.figure import figure_of
from veduta.fauna.read.basis import FitLooks, spline_basis
from veduta.fauna.read.fit import Fit
from veduta.fauna.read.silhouettes import (
    SilhouetteLooks,
    Silhouettes,
    _about,
    silhouettes_of,
)
from veduta.fauna.read.windows import middles_of, windows_of
from veduta.synthetic.animals import Filmed, film_quadruped

LOOKS = SilhouetteLooks()
LEFT, RIGHT = 60, 320
"""The columns of the film that a narrower camera would have seen."""


@lru_cache(maxsize=1)
def filmed() -> Filmed:
    return film_quadruped(721, frames=44, cycle=20.0)


@lru_cache(maxsize=1)
def narrow() -> Silhouettes:
    return silhouettes_of(filmed().masks[:, :, LEFT:RIGHT], LOOKS, "film", with_cut=True)


def test_frames_that_the_border_cuts_are_good_ones_and_named() -> None:
    found = narrow()
    assert found.cut is not None
    touching = filmed().masks[found.rows][:, :, [LEFT, RIGHT - 1]].any(axis=(1, 2))
    np.testing.assert_array_equal(found.cut, touching)
    assert 5 < found.cut.sum() < len(found.rows) - 5
    assert [one is not None for one in found.shown()] == found.cut.tolist()
    alone = silhouettes_of(filmed().masks[:, :, LEFT:RIGHT], LOOKS, "film")
    np.testing.assert_array_equal(alone.rows, found.rows[~found.cut])


def test_the_middle_of_an_animal_that_leaves_goes_on_as_the_animal_does() -> None:
    found, film = narrow(), filmed()
    true = middles_of(film.masks)[found.rows] - [LEFT, 0.0]
    laid = np.linalg.norm(middles_of(found.masks, found.shown()) - true, axis=1)
    of_parts = np.linalg.norm(middles_of(found.masks) - true, axis=1)
    assert laid.max() < 0.04 * film.length_px
    assert of_parts.max() > 0.1 * film.length_px


def test_what_lies_beyond_the_border_is_neither_animal_nor_ground() -> None:
    found = narrow()
    shown = found.shown()
    middle = middles_of(found.masks, shown)
    windows = windows_of(found.masks, 40, middle, shown)
    whole = np.isfinite(windows.shares).all(axis=(1, 2))
    assert found.cut is not None
    assert whole[~found.cut].all()
    assert not whole[found.cut][-1]
    frames = found.rows.astype(np.float64)
    fit = Fit(
        figure_of(load_plan("quadruped")), windows, spline_basis(frames, FitLooks()), FitLooks(),
        frames,
    )  # fmt: skip
    numbers = np.random.default_rng(4).normal(0.0, 0.3, fit.size)
    loss, gradient, each = fit.loss(numbers, 150.0, 0.03)
    assert np.isfinite(loss)
    assert np.isfinite(gradient).all()
    # Ground where nothing is known would cost what the figure has there.
    ground = windows_of(found.masks, 40, middle)
    held = Fit(fit.figure, ground, fit.basis, fit.looks, frames)
    held.weights = fit.weights
    costs = held.loss(numbers, 150.0, 0.03)[2]
    assert (costs[found.cut] >= each[found.cut] - 1e-9).all()
    assert costs[found.cut][-1] > 1.2 * each[found.cut][-1]


def test_of_frames_that_are_as_far_the_earlier_ones_tell_the_usual_area() -> None:
    """Silhouettes that come and go, each of an area of its own: ties stand at the ends."""
    rng = np.random.default_rng(25)
    for _ in range(40):
        good, areas = rng.random(80) < 0.6, rng.random(80)
        rows = np.flatnonzero(good)
        usual = [
            np.median(areas[sorted(rows, key=lambda other: abs(other - row))[:9]])
            for row in range(80)
        ]
        np.testing.assert_array_equal(_about(areas, good, 9), usual)


def test_an_animal_that_comes_nearer_is_kept_and_a_frame_that_flickers_is_not() -> None:
    masks = np.zeros((25, 120, 160), dtype=np.bool_)
    for row in range(25):
        half = 20 + row // 2
        masks[row, 60 - half : 60 + half, 80 - half : 80 + half] = True
    masks[12, 60:] = False
    found = silhouettes_of(masks, LOOKS, "nearer", with_cut=True)
    assert [row for row, _ in found.left_out] == [12]
    assert len(silhouettes_of(masks, LOOKS, "nearer").rows) < 22


@pytest.mark.parametrize(("whole", "kept"), [(10, 10), (80, 72)])
def test_of_many_frames_those_that_show_it_whole_come_first(whole: int, kept: int) -> None:
    rows = np.arange(10, 110)
    cut = np.ones(100, dtype=np.bool_)
    cut[:whole] = False
    found = Silhouettes(np.ones((100, 2, 2), dtype=np.bool_), rows, np.ones(100), (), cut)
    used, more = fewer(found)
    assert used.cut is not None
    assert len(used.rows) == 72
    assert int((~used.cut).sum()) == kept
    np.testing.assert_array_equal(np.sort(np.concatenate([used.rows, more])), rows)
