"""Quaternions of rotations, against SciPy's."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from veduta.geometry.quaternions import quaternions_of, rotations_of

ANY = Rotation.random(500, rng=np.random.default_rng(2))
HALF = Rotation.from_rotvec(
    np.pi * np.array([[1, 0, 0], [0, 1, 0], [0, 0, 1], [0.6, 0.8, 0], [0, 0, 0], [-0.6, 0, 0.8]])
)


@pytest.mark.parametrize("turns", [ANY, HALF])
def test_they_are_those_of_scipy(turns: Rotation) -> None:
    matrices = turns.as_matrix()
    expected = Rotation.from_matrix(matrices).as_quat(canonical=True)
    assert np.array_equal(quaternions_of(matrices), expected)
    assert np.allclose(rotations_of(expected), matrices, atol=1e-14)


def test_what_is_a_rotation_but_for_rounding_is_taken_for_the_nearest() -> None:
    rounded = ANY.as_matrix().astype(np.float32).astype(np.float64)
    expected = Rotation.from_matrix(rounded).as_quat(canonical=True)
    assert np.array_equal(quaternions_of(rounded), expected)


def test_the_length_of_a_quaternion_does_not_matter() -> None:
    turns = ANY.as_quat()
    assert np.allclose(rotations_of(3.0 * turns), ANY.as_matrix(), atol=1e-13)


@pytest.mark.parametrize("matrix", [np.diag([1.0, 1.0, -1.0]), np.diag([1.0, 1.0, 0.0])])
def test_what_mirrors_or_flattens_is_refused(matrix: np.ndarray) -> None:
    with pytest.raises(ValueError, match="no rotation"):
        quaternions_of(matrix[None])


def test_none_gives_none() -> None:
    assert quaternions_of(np.zeros((0, 3, 3))).shape == (0, 4)
