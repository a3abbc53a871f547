"""Near legs are told from far ones: by the pictures, and without them by the order of steps."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from veduta.fauna.document.plan import load_plan
from veduta.fauna.motion.figure import figure_of
from veduta.fauna.read.basis import FitLooks, cycle_basis, spline_basis
from veduta.fauna.read.fit import Fit
from veduta.fauna.read.limbed import LimbedLooks, LimbedSeen, fit_limbed
from veduta.fauna.read.nearer import NearerLooks, nearer_legs
from veduta.fauna.read.sides import sides_told
from veduta.fauna.read.windows import Windows
from veduta.synthetic.animals import Filmed, film_quadruped


@pytest.fixture(scope="module")
def walk() -> tuple[Filmed, LimbedSeen]:
    film = film_quadruped(21, frames=30, cycle=20.0)
    seen = fit_limbed(
        film.masks, np.arange(30), load_plan("quadruped"), LimbedLooks(), lambda: None,
        pictures=film.frames,
    )  # fmt: skip
    return film, seen


def _apart(film: Filmed, seen: LimbedSeen, toe: str, side: str) -> float:
    """How far a fitted left toe is from the film's of that side, px, on the mean."""
    joints = seen.windows.in_picture(seen.fitted.joints(), seen.fitted.px_per_length)
    mine = joints[:, seen.fitted.figure.names.index(f"{toe}_left")]
    return float(np.linalg.norm(mine - film.joints[f"{toe}_{side}"], axis=1).mean())


@pytest.mark.parametrize("toe", ["front_toe", "hind_toe"])
def test_pictures_tell_near_legs_from_far_ones(walk: tuple[Filmed, LimbedSeen], toe: str) -> None:
    film, seen = walk
    assert {one.part for one in seen.nearer} == {"front_leg", "hind_leg"}
    assert _apart(film, seen, toe, "left") < 0.3 * _apart(film, seen, toe, "right")


def test_the_same_animal_the_other_way_is_told_as_surely(walk: tuple[Filmed, LimbedSeen]) -> None:
    film, seen = walk
    windows = replace(seen.windows, middle_px=seen.windows.middle_px * [-1.0, 1.0] + [640.0, 0.0],
                      faces=-1.0)  # fmt: skip
    mirrored = np.ascontiguousarray(film.frames[:, :, ::-1])
    told = nearer_legs(mirrored, seen.fitted, windows, seen.frames, NearerLooks())
    first = nearer_legs(film.frames, seen.fitted, seen.windows, seen.frames, NearerLooks())
    for one, other in zip(told, first, strict=True):
        assert one.left * other.left > 0.0
        assert abs(one.left) > NearerLooks().sure


def test_pictures_without_texture_tell_nothing(walk: tuple[Filmed, LimbedSeen]) -> None:
    film, seen = walk
    plain = np.full_like(film.frames, 90)
    told = nearer_legs(plain, seen.fitted, seen.windows, seen.frames, NearerLooks())
    assert all(abs(one.left) < NearerLooks().sure or one.places == 0 for one in told)


def test_without_pictures_a_front_foot_follows_the_hind_foot_of_its_side(
    walk: tuple[Filmed, LimbedSeen],
) -> None:
    film, seen = walk
    fitted = seen.fitted
    looks = FitLooks()
    basis = cycle_basis(seen.frames, seen.cycle or 0.0, looks)
    fit = Fit(fitted.figure, seen.windows, basis, looks, seen.frames)
    wrong = fit.other_way_round(fitted.numbers, "front_leg")
    sided, told = sides_told(fit, wrong, fit.fitted(wrong, fitted.px_per_length, 0.01), None)
    again = replace(seen, fitted=fit.fitted(sided, fitted.px_per_length, 0.01))
    assert told == ()
    same = [_apart(film, again, toe, "left") < _apart(film, again, toe, "right")
            for toe in ("front_toe", "hind_toe")]  # fmt: skip
    assert same[0] == same[1]


@pytest.mark.parametrize("shared", [True, False])
def test_the_other_way_round_left_legs_are_where_right_ones_were(shared: bool) -> None:
    figure = figure_of(load_plan("quadruped"), {"ear", "horn", "beard"})
    frames = np.arange(12.0)
    windows = Windows(np.ones((12, 8, 8), np.float32), np.zeros((12, 2)), 4.0, 1.0)
    looks = FitLooks()
    basis = cycle_basis(frames, 9.0, looks) if shared else spline_basis(frames, looks)
    fit = Fit(figure, windows, basis, looks, frames)
    numbers = np.random.default_rng(3).normal(0.0, 0.5, fit.size)
    before = fit.fitted(numbers, 40.0, 0.05).joints()
    after = fit.fitted(fit.other_way_round(numbers, "hind_leg"), 40.0, 0.05).joints()
    for row, name in enumerate(figure.names):
        other = name
        if name.startswith(("hind", "knee", "hock")):
            other = name.replace("_left", "_") + "right" if name.endswith("left") else (
                name.removesuffix("right") + "left"
            )  # fmt: skip
        np.testing.assert_allclose(after[:, row], before[:, figure.names.index(other)], atol=1e-9)
