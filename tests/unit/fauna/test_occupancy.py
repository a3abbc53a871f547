"""Capsules against silhouettes: the kernel against all distances by numpy, and gradients."""

from __future__ import annotations

import numpy as np
import pytest

from veduta._core import CoverFault, capsules_cover
from veduta.fauna.document.plan import load_plan
from veduta.fauna.motion.figure import Figure, Floats, figure_of, posed
from veduta.fauna.read.occupancy import Singles, cover


def _figure() -> tuple[Figure, Floats]:
    figure = figure_of(load_plan("quadruped"), ("ear", "horn", "beard"))
    random = np.random.default_rng(4)
    angles = figure.rest + random.normal(size=(3, len(figure.start))) * 0.2
    return figure, posed(figure, np.zeros((3, 2)), angles, figure.length, figure.apart).joints


def _losses(
    figure: Figure, joints: Floats, pixels: Singles, shares: Singles, weights: Singles, soft: float
) -> Floats:
    """Every segment's distance from every place, in double precision."""
    a, b = joints[:, figure.start, None], joints[:, figure.end, None]
    along = b - a
    away = pixels[None, None].astype(np.float64) - a
    t = np.clip((away * along).sum(-1) / (along**2).sum(-1), 0.0, 1.0)
    far = np.linalg.norm(away - t[..., None] * along, axis=-1)
    first, last = figure.deep[figure.start], figure.deep[figure.end]
    inside = 1.0 / (1.0 + np.exp((far - first[:, None] * (1 - t) - last[:, None] * t) / soft))
    error = 1.0 - np.prod(1.0 - inside, axis=1) - shares
    found = (weights * error**2).sum(axis=1) / shares.sum(axis=1)
    return np.asarray(found, dtype=np.float64)


def test_the_kernel_agrees_with_all_distances_and_their_differences() -> None:
    figure, joints = _figure()
    random = np.random.default_rng(5)
    side = np.linspace(-0.8, 1.2, 40)
    pixels = np.stack(np.meshgrid(side, side), axis=-1).reshape(-1, 2).astype(np.float32)
    shares = (random.random((3, 1600)) < 0.4).astype(np.float32)
    weights = random.random(1600).astype(np.float32) + 0.5

    def loss(at: Floats) -> Floats:
        return _losses(figure, at, pixels, shares, weights, 0.03)

    found = cover(figure, joints, figure.deep, pixels, shares, weights, 0.03)
    np.testing.assert_allclose(found.loss, loss(joints), rtol=1e-3)
    for joint in (0, 3, len(figure.names) - 1):
        for axis in (0, 1):
            step = np.zeros_like(joints)
            step[:, joint, axis] = 1e-5
            slope = (loss(joints + step) - loss(joints - step)) / 2e-5
            # The taper's own turn is left out of the gradient: it is small.
            off = np.abs(found.by_joint[:, joint, axis] - slope)
            assert (off < 0.02 + 0.1 * np.abs(slope)).all()


def test_what_does_not_belong_together_is_refused() -> None:
    figure, joints = _figure()
    pixels = np.zeros((4, 2), dtype=np.float32)
    shares, weights = np.ones((3, 4), dtype=np.float32), np.ones(4, dtype=np.float32)
    with pytest.raises(CoverFault, match="weights has 3 numbers, not 4"):
        cover(figure, joints, figure.deep, pixels, shares, weights[:3], 0.1)
    with pytest.raises(CoverFault, match="wider than 0"):
        cover(figure, joints, figure.deep, pixels, shares, weights, 0.0)
    flat = joints.astype(np.float32)[..., :1]
    deep = figure.deep.astype(np.float32)
    with pytest.raises(CoverFault, match="two coordinates"):
        capsules_cover(figure.start, figure.end, flat, deep, pixels, shares, weights, 0.1)
