"""Rays against boxes, cylinders and balls: marching along them must find the same."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from veduta.synthetic.drives import rays

_STEP_M = 0.002


@pytest.fixture(scope="module")
def beams() -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    random = np.random.default_rng(2)
    directions = random.normal(size=(300, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    return random.uniform(-0.5, 0.5, (300, 3)), directions


def _march(origins: NDArray[np.float64], directions: NDArray[np.float64], inside) -> NDArray:  # type: ignore[no-untyped-def]
    at = np.arange(_STEP_M, 6.0, _STEP_M)
    points = origins[:, None] + at[:, None] * directions[:, None]
    hit = inside(points)
    return np.where(hit.any(axis=1), at[np.argmax(hit, axis=1)], np.inf)


def _agree(found: NDArray[np.float64], marched: NDArray[np.float64]) -> None:
    near = np.where(found < 5.9, found, np.inf)
    both = np.isfinite(near) & np.isfinite(marched)
    assert both.sum() > 5
    np.testing.assert_allclose(near[both], marched[both], atol=3 * _STEP_M)
    assert (np.isfinite(near) == np.isfinite(marched)).mean() > 0.96


def test_boxes(beams) -> None:  # type: ignore[no-untyped-def]
    box = np.array([[[1.0, -1.0, -1.0], [2.0, 1.5, 1.0]], [[-3.0, -2.0, -2.0], [-2.0, 2.0, 2.0]]])
    found = rays.to_boxes(*beams, box)
    _agree(
        found, _march(*beams, lambda p: sum(((p > lo) & (p < hi)).all(-1) for lo, hi in box) > 0)
    )


def test_balls(beams) -> None:  # type: ignore[no-untyped-def]
    ball = np.array([[2.0, 0.5, 0.0, 1.2]])
    found = rays.to_balls(*beams, ball)
    _agree(found, _march(*beams, lambda p: ((p - ball[0, :3]) ** 2).sum(-1) < ball[0, 3] ** 2))


def test_cylinders(beams) -> None:  # type: ignore[no-untyped-def]
    origins, directions = beams
    level = directions.copy()
    level[:, 2] *= 0.1  # caps are not part of a cylinder here
    level /= np.linalg.norm(level, axis=1, keepdims=True)
    cylinder = np.array([[2.0, 0.5, 1.2, -1.5, 1.5]])

    def inside(p: NDArray[np.float64]) -> NDArray[np.bool_]:
        flat = ((p[..., :2] - cylinder[0, :2]) ** 2).sum(-1) < cylinder[0, 2] ** 2
        return np.asarray(flat & (np.abs(p[..., 2]) < 1.5))

    _agree(rays.to_cylinders(origins, level, cylinder), _march(origins, level, inside))
