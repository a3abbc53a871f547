"""Quaternions of rotations and back, without a library that is slow to load."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

_ORTHOGONAL = 1e-12
Matrices = NDArray[np.float64]


def quaternions_of(rotations: Matrices) -> NDArray[np.float64]:
    """(n, 4) unit quaternions x, y, z, w of (n, 3, 3) rotations, w positive where it is not 0.

    A matrix that is a rotation but for rounding is taken for the nearest one. ValueError where one
    mirrors or flattens. The products of a quaternion's members are the symmetric matrix whose rows
    are taken here; that of the largest member is divided by its length (Shepperd 1978).
    """
    if not (np.linalg.det(rotations) > 0.0).all():
        raise ValueError("a matrix that mirrors or flattens is no rotation")
    m = _nearest(np.asarray(rotations, dtype=np.float64))
    diagonal = np.einsum("nii->ni", m)
    trace = diagonal[:, 0] + diagonal[:, 1] + diagonal[:, 2]
    products = np.empty((len(m), 4, 4))
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        products[:, i, i] = 1.0 - trace + 2.0 * diagonal[:, i]
        products[:, i, j] = products[:, j, i] = m[:, j, i] + m[:, i, j]
        products[:, i, 3] = products[:, 3, i] = m[:, k, j] - m[:, j, k]
    products[:, 3, 3] = 1.0 + trace
    largest = np.column_stack([diagonal, trace]).argmax(axis=1)
    found = products[np.arange(len(m)), largest]
    found /= np.linalg.norm(found, axis=1, keepdims=True)
    return np.asarray(np.where(_is_turned_over(found)[:, None], -found, found))


def rotations_of(quaternions: NDArray[np.floating]) -> Matrices:
    """(n, 3, 3) rotations of (n, 4) quaternions x, y, z, w, of any length but 0."""
    q = np.asarray(quaternions, dtype=np.float64)
    q = q / np.linalg.norm(q, axis=1, keepdims=True)
    x, y, z, w = q.T
    rows = [
        [x * x - y * y - z * z + w * w, 2.0 * (x * y - z * w), 2.0 * (x * z + y * w)],
        [2.0 * (x * y + z * w), -x * x + y * y - z * z + w * w, 2.0 * (y * z - x * w)],
        [2.0 * (x * z - y * w), 2.0 * (y * z + x * w), -x * x - y * y + z * z + w * w],
    ]
    return np.moveaxis(np.array(rows), 2, 0)


def _nearest(matrices: Matrices) -> Matrices:
    """The rotations nearest to those that are not quite one."""
    squares = matrices @ np.swapaxes(matrices, 1, 2)
    off = ~np.isclose(squares, np.eye(3), atol=_ORTHOGONAL).all(axis=(1, 2))
    if not off.any():
        return matrices
    left, _, right = np.linalg.svd(matrices[off], full_matrices=False)
    found = matrices.copy()
    found[off] = left @ right
    return found


def _is_turned_over(quaternions: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Whether the first of w, x, y, z that is not 0 is below it."""
    ordered = quaternions[:, [3, 0, 1, 2]]
    first = (ordered != 0.0).argmax(axis=1)
    return np.asarray(ordered[np.arange(len(ordered)), first] < 0.0)
