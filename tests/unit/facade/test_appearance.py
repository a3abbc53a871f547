"""What looks like window rather than wall, on pictures of a few patches."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from veduta.facade.appearance import class_scores, wall_colour
from veduta.facade.evidence import Evidence

STOREY = 60.0
WALL = (150.0, 128.0, 140.0)
PATCHES = {"bluer": np.s_[70:110, 30:60], "yellower": np.s_[70:110, 120:150]}


def _evidence(seed: int = 1) -> Evidence:
    """A wall with grain and two patches, as much bluer and yellower than it; no edges are given."""
    rng = np.random.default_rng(seed)
    lab = np.empty((180, 180, 3), np.float32)
    lab[:] = WALL
    for name, step in (("bluer", -14.0), ("yellower", 14.0)):
        lab[PATCHES[name]][..., 2] += step
    lab += rng.normal(0, 1.0, lab.shape).astype(np.float32)
    zeros = np.zeros(lab.shape[:2], np.float32)
    return Evidence(1.0, lab, zeros, zeros, np.ones(lab.shape[:2], bool))


def _window(evidence: Evidence) -> NDArray[np.float32]:
    wall = wall_colour(evidence, 0, evidence.height, STOREY)
    return class_scores(evidence, wall, 0, evidence.height, STOREY).window


def test_panes_are_bluer_than_the_wall() -> None:
    window = _window(_evidence())
    assert window[PATCHES["bluer"]].mean() > window[PATCHES["yellower"]].mean() + 0.3


def test_upright_edges_around_speak_for_a_window() -> None:
    plain, framed = _evidence(), _evidence()
    framed.gx[20:60, 70:110:4] = 15.0
    part = np.s_[25:55, 75:105]
    assert _window(framed)[part].mean() > _window(plain)[part].mean() + 0.3


def test_level_edges_around_speak_for_a_stripe_and_not_for_its_rows() -> None:
    plain = _evidence()
    level = np.zeros_like(plain.gy)
    level[20:60:4, 70:110] = 15.0
    framed, part = replace(plain, gy=level), np.s_[25:55, 75:105]
    wall = wall_colour(plain, 0, plain.height, STOREY)
    without, with_edges = (class_scores(e, wall, 0, 180, STOREY) for e in (plain, framed))
    assert with_edges.level[part].mean() > without.level[part].mean() + 0.3
    np.testing.assert_array_equal(with_edges.window, without.window)


@pytest.mark.parametrize("fill", [(0.0, 128.0, 128.0), (255.0, 128.0, 128.0), (90.0, 160.0, 90.0)])
def test_what_is_no_photo_has_no_say_in_the_wall(fill: tuple[float, float, float]) -> None:
    seen, other = _evidence(), _evidence()
    for evidence in (seen, other):
        evidence.valid[:, 100:] = False
    other.lab[:, 100:] = fill
    walls = [wall_colour(evidence, 0, 180, STOREY) for evidence in (seen, other)]
    known = np.s_[:, :100]
    assert np.allclose(walls[0].colour[known], walls[1].colour[known], atol=1e-3)
    assert np.allclose(walls[0].unlike[known], walls[1].unlike[known], atol=1e-3)
