"""Plane homographies: 3x3 float64 matrices that act on homogeneous pixel columns.

Named `b_from_a`: `apply(b_from_a, points_a)` gives points in b. Points are (n, 2) float64.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Matrix = NDArray[np.float64]
Points = NDArray[np.float64]


def translation(x: float, y: float) -> Matrix:
    """Moves points by (x, y)."""
    return np.array([[1.0, 0.0, x], [0.0, 1.0, y], [0.0, 0.0, 1.0]])


def scaling(x: float, y: float) -> Matrix:
    """Multiplies x and y."""
    return np.diag([x, y, 1.0])


def homogeneous(b_from_a: Matrix, points_a: Points) -> NDArray[np.float64]:
    """(n, 3) homogeneous images of points, before the division."""
    points = np.asarray(points_a, dtype=np.float64).reshape(-1, 2)
    return points @ b_from_a[:, :2].T + b_from_a[:, 2]


def apply(b_from_a: Matrix, points_a: Points) -> Points:
    """(n, 2) images of points; a point on the horizon of the map becomes infinite."""
    mapped = homogeneous(b_from_a, points_a)
    with np.errstate(divide="ignore", invalid="ignore"):
        return mapped[:, :2] / mapped[:, 2:]


def inverse(b_from_a: Matrix) -> Matrix:
    """a_from_b, with the last entry 1 where that is possible."""
    return normalised(np.asarray(np.linalg.inv(b_from_a), dtype=np.float64))


def normalised(b_from_a: Matrix) -> Matrix:
    """The same map with the last entry 1, or with norm 1 where the last entry is about zero."""
    last = float(b_from_a[2, 2])
    norm = float(np.linalg.norm(b_from_a))
    return b_from_a / (last if abs(last) > 1e-9 * norm else norm)


def from_points(points_a: Points, points_b: Points) -> Matrix:
    """b_from_a of at least four correspondences, least squares in the algebraic distance.

    The normalised direct linear transform (Hartley and Zisserman, algorithm 4.2). Raises
    ValueError when the points do not fix a homography (three of four on one line).
    """
    a = np.asarray(points_a, dtype=np.float64).reshape(-1, 2)
    b = np.asarray(points_b, dtype=np.float64).reshape(-1, 2)
    if len(a) != len(b) or len(a) < 4:
        raise ValueError("a homography needs at least four pairs of points")
    norm_a, norm_b = _isotropic(a), _isotropic(b)
    u, v = apply(norm_a, a), apply(norm_b, b)
    ones, zeros = np.ones((len(u), 1)), np.zeros((len(u), 3))
    uh = np.hstack([u, ones])
    rows_x = np.hstack([uh, zeros, -v[:, :1] * uh])
    rows_y = np.hstack([zeros, uh, -v[:, 1:] * uh])
    _, singular, vt = np.linalg.svd(np.vstack([rows_x, rows_y]))
    # vt[8] has norm 1: a determinant of zero maps the plane to a line.
    flat = abs(float(np.linalg.det(vt[8].reshape(3, 3)))) < 1e-9
    if flat or singular[7] < 1e-9 * singular[0]:
        raise ValueError("the points do not fix a homography: too many lie on one line")
    return normalised(np.linalg.inv(norm_b) @ vt[8].reshape(3, 3) @ norm_a)


def area_scale(b_from_a: Matrix, points_a: Points) -> NDArray[np.float64]:
    """(n,) signed local area magnification, det(H) / w^3; negative where the map mirrors."""
    w = homogeneous(b_from_a, points_a)[:, 2]
    with np.errstate(divide="ignore"):
        return np.asarray(np.linalg.det(b_from_a) / w**3)


def _isotropic(points: Points) -> Matrix:
    """Similarity that takes points to centroid zero and mean distance sqrt(2)."""
    centre = points.mean(axis=0)
    distance = float(np.linalg.norm(points - centre, axis=1).mean())
    if distance <= 0.0:
        raise ValueError("the points do not fix a homography: all are the same")
    factor = np.sqrt(2.0) / distance
    return scaling(factor, factor) @ translation(-centre[0], -centre[1])
