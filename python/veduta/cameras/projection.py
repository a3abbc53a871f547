"""A camera out of a projection matrix: its triangle and its turn parted, signs with care."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
LEAST_DETERMINANT = 1e-12
"""Of a matrix's left part, whose rows have length 1: less is no camera with a centre."""


@dataclass(frozen=True, eq=False)
class Parted:
    """K (3, 3) with a positive diagonal and 1 in the corner, and the pose (3, 4)."""

    matrix: Floats
    cam_from_world: Floats


def part_projection(projection: Floats) -> Parted | None:
    """K and the pose of (3, 4) P, of any scale and sign; None where P is no camera's.

    P = s K [R, t]. The sign of s is that which makes R a turn and no mirror: det of P's left part
    has the sign of s cubed, as K's diagonal is positive.
    """
    left = projection[:, :3]
    lengths = np.linalg.norm(left, axis=1)
    if not np.isfinite(projection).all() or lengths.min() <= 0.0:
        return None
    if abs(np.linalg.det(left / lengths[:, None])) < LEAST_DETERMINANT:
        return None
    signed = projection * np.sign(np.linalg.det(left))
    triangle, turn = _triangle_and_turn(signed[:, :3])
    shift = np.linalg.solve(triangle, signed[:, 3])
    return Parted(triangle / triangle[2, 2], np.column_stack([turn, shift]))


def nearest_turn(square: Floats, most: float) -> Floats | None:
    """The turn (3, 3) that is nearest to a matrix; None where it is off by more than `most`.

    Files have six or seven digits, which leave a turn that is not quite orthogonal.
    """
    if np.abs(square @ square.T - np.eye(3)).max() > most or np.linalg.det(square) < 0.0:
        return None
    u, _, v = np.linalg.svd(square)
    return np.asarray(u @ v)


def _triangle_and_turn(square: Floats) -> tuple[Floats, Floats]:
    """Upper triangle with positive diagonal, and orthogonal, whose product it is (RQ)."""
    flip = np.eye(3)[::-1]
    q, r = np.linalg.qr((flip @ square).T)
    triangle = flip @ r.T @ flip
    turn = flip @ q.T
    signs = np.where(np.diag(triangle) < 0.0, -1.0, 1.0)
    return triangle * signs, signs[:, None] * turn
