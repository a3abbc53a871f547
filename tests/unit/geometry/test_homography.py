"""Homographies: group laws, exact recovery, and the closed form of their derivative."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from numpy.typing import NDArray

from veduta.geometry import homography
from veduta.geometry.polygon import rectangle

SQUARE = rectangle(0.0, 0.0, 1.0, 1.0)
offsets = st.lists(st.floats(-0.3, 0.3), min_size=8, max_size=8)


def quadrilateral(values: list[float]) -> NDArray[np.float64]:
    """The unit square with its corners moved by less than a third: always convex enough."""
    return SQUARE + np.array(values).reshape(4, 2)


@given(offsets, offsets)
def test_four_points_are_met_exactly(a: list[float], b: list[float]) -> None:
    source, target = 100 * quadrilateral(a), 700 * quadrilateral(b) + 50
    assume(_well_shaped(source) and _well_shaped(target))
    matrix = homography.from_points(source, target)
    assert np.allclose(homography.apply(matrix, source), target, atol=1e-5)
    back = homography.from_points(target, source)
    inside = np.array([[0.4, 0.5], [0.5, 0.4]]) @ source[[0, 2]]
    there = homography.apply(matrix, inside)
    assert np.allclose(homography.apply(back, there), inside, atol=1e-5)
    assert np.allclose(homography.apply(homography.inverse(matrix), there), inside, atol=1e-5)


def test_many_points_are_fitted_in_least_squares() -> None:
    rng = np.random.default_rng(0)
    truth = np.array([[1.1, 0.2, 5.0], [-0.1, 0.9, 3.0], [1e-4, -2e-4, 1.0]])
    source = rng.uniform(0, 1000, (200, 2))
    target = homography.apply(truth, source) + rng.normal(0, 0.5, (200, 2))
    found = homography.apply(homography.from_points(source, target), source)
    error = found - homography.apply(truth, source)
    assert 0.0 < float(np.sqrt((error**2).mean())) < 0.2


def test_points_on_a_line_are_refused() -> None:
    line = np.array([[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [0.0, 1.0]])
    with pytest.raises(ValueError, match="line"):
        homography.from_points(line, SQUARE)
    with pytest.raises(ValueError, match="same"):
        homography.from_points(np.zeros((4, 2)), SQUARE)
    with pytest.raises(ValueError, match="four"):
        homography.from_points(SQUARE[:3], SQUARE[:3])


@given(offsets, st.floats(0.2, 0.8), st.floats(0.2, 0.8))
def test_area_scale_is_the_jacobian(values: list[float], x: float, y: float) -> None:
    target = quadrilateral(values)
    assume(_well_shaped(target))
    matrix = homography.from_points(SQUARE, target)
    step = 1e-5
    ahead = homography.apply(matrix, np.array([[x + step, y], [x, y + step]]))
    behind = homography.apply(matrix, np.array([[x - step, y], [x, y - step]]))
    jacobian = (ahead - behind) / (2 * step)
    expected = float(np.linalg.det(jacobian))
    assert homography.area_scale(matrix, np.array([[x, y]]))[0] == pytest.approx(expected, rel=1e-3)


def test_named_parts() -> None:
    matrix = homography.translation(3, 4) @ homography.scaling(2, 5)
    assert np.array_equal(homography.apply(matrix, np.array([[1.0, 1.0]])), [[5.0, 9.0]])
    assert homography.normalised(4 * matrix)[2, 2] == 1.0


def _well_shaped(points: NDArray[np.float64]) -> bool:
    edges = np.roll(points, -1, axis=0) - points
    following = np.roll(edges, -1, axis=0)
    cross = edges[:, 0] * following[:, 1] - edges[:, 1] * following[:, 0]
    return bool(cross.min() > 0.05 * np.ptp(points) ** 2)
