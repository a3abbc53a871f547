"""Poses in the plane that agree best with steps between them and places that are known of some.

Corrections are spread over all steps by their covariances: Lu and Milios 1997 (Globally consistent
range scan alignment), by Gauss-Newton on sparse normal equations as Kuemmerle et al. 2011 (g2o).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_matrix, identity
from scipy.sparse.linalg import splu

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Step:
    """The pose of `second` as seen from `first`: (3,) x, y (m), turn (rad); covariance (3, 3).

    robust: whether it may be wrong altogether (a closed loop), so that it weighs less when others
    contradict it.
    """

    first: int
    second: int
    pose: Floats
    covariance: Floats
    robust: bool = False


@dataclass(frozen=True, eq=False)
class Fix:
    """Where a pose is in the world, by a map. pose: (3,); covariance: (3, 3)."""

    node: int
    pose: Floats
    covariance: Floats


@dataclass(frozen=True)
class GraphParameters:
    """rounds, still: until no pose moves farther than that. robust: residuals above so many
    deviations weigh less (Cauchy), where they may be wrong.
    """

    rounds: int = 30
    still: float = 1e-5
    robust: float = 2.0


def spread_corrections(
    poses: Floats,
    steps: Sequence[Step],
    fixes: Sequence[Fix],
    parameters: GraphParameters | None = None,
) -> Floats:
    """(n, 3) poses of least squares, from a start (n, 3). Without a fix the first pose stays."""
    chosen = parameters or GraphParameters()
    found = poses.copy()
    held = fixes or [Fix(0, poses[0].copy(), np.eye(3) * 1e-8)]
    first = np.array([step.first for step in steps], dtype=np.int64)
    second = np.array([step.second for step in steps], dtype=np.int64)
    measured = np.array([step.pose for step in steps]).reshape(-1, 3)
    known = np.array([np.linalg.inv(step.covariance) for step in steps]).reshape(-1, 3, 3)
    soft = np.array([step.robust for step in steps], dtype=bool)
    nodes = np.array([fix.node for fix in held], dtype=np.int64)
    places = np.array([fix.pose for fix in held])
    sure = np.array([np.linalg.inv(fix.covariance) for fix in held])
    for _ in range(chosen.rounds):
        residual, by_first, by_second = _of_steps(found, first, second, measured)
        weight = known * _less(residual, known, soft, chosen.robust)[:, None, None]
        away = found[nodes] - places
        away[:, 2] = _wrapped(away[:, 2])
        pull = sure * _less(away, sure, np.ones(len(nodes), bool), chosen.robust)[:, None, None]
        matrix, right = _normal_equations(
            len(found), (first, second), (by_first, by_second), weight, residual, nodes, pull, away
        )
        change = splu(matrix.tocsc()).solve(-right).reshape(-1, 3)
        found = found + change
        found[:, 2] = _wrapped(found[:, 2])
        if float(np.abs(change).max()) < chosen.still:
            break
    return found


def _of_steps(
    poses: Floats, first: NDArray[np.int64], second: NDArray[np.int64], measured: Floats
) -> tuple[Floats, Floats, Floats]:
    """(m, 3) residuals, and their (m, 3, 3) derivatives by the first and the second pose."""
    cosine, sine = np.cos(poses[first, 2]), np.sin(poses[first, 2])
    apart = poses[second, :2] - poses[first, :2]
    forward = cosine * apart[:, 0] + sine * apart[:, 1]
    left = cosine * apart[:, 1] - sine * apart[:, 0]
    turn = poses[second, 2] - poses[first, 2]
    residual = np.stack([forward, left, turn], axis=1) - measured
    residual[:, 2] = _wrapped(residual[:, 2])
    by_second = np.zeros((len(first), 3, 3))
    by_second[:, 0, 0], by_second[:, 0, 1] = cosine, sine
    by_second[:, 1, 0], by_second[:, 1, 1] = -sine, cosine
    by_second[:, 2, 2] = 1.0
    by_first = -by_second
    by_first[:, 0, 2], by_first[:, 1, 2] = left, -forward
    return residual, by_first, by_second


def _less(residual: Floats, known: Floats, soft: NDArray[np.bool_], robust: float) -> Floats:
    """(m,) weights: Cauchy's by the residual in deviations where it is soft, else 1."""
    square = np.einsum("mi,mij,mj->m", residual, known, residual) / 3.0
    return np.where(soft, 1.0 / (1.0 + square / robust**2), 1.0)


def _normal_equations(
    count: int,
    ends: tuple[NDArray[np.int64], NDArray[np.int64]],
    derivatives: tuple[Floats, Floats],
    weight: Floats,
    residual: Floats,
    nodes: NDArray[np.int64],
    pull: Floats,
    away: Floats,
) -> tuple[coo_matrix, Floats]:
    rows, columns, values = [], [], []
    right = np.zeros((count, 3))
    offset = np.arange(3)
    for one, by_one in zip(ends, derivatives, strict=True):
        weighted = np.einsum("mki,mkl->mil", by_one, weight)
        np.add.at(right, one, np.einsum("mil,ml->mi", weighted, residual))
        for other, by_other in zip(ends, derivatives, strict=True):
            block = np.einsum("mil,mlj->mij", weighted, by_other)
            rows.append(np.broadcast_to((3 * one[:, None] + offset)[:, :, None], block.shape))
            columns.append(np.broadcast_to((3 * other[:, None] + offset)[:, None], block.shape))
            values.append(block)
    rows.append(np.broadcast_to((3 * nodes[:, None] + offset)[:, :, None], pull.shape))
    columns.append(np.broadcast_to((3 * nodes[:, None] + offset)[:, None], pull.shape))
    values.append(pull)
    np.add.at(right, nodes, np.einsum("mij,mj->mi", pull, away))
    at = (
        np.concatenate([block.ravel() for block in rows]),
        np.concatenate([block.ravel() for block in columns]),
    )
    filled = np.concatenate([block.ravel() for block in values])
    matrix = coo_matrix((filled, at), shape=(3 * count, 3 * count))
    return matrix + 1e-9 * identity(3 * count), right.ravel()


def _wrapped(angle: Floats) -> Floats:
    return np.asarray((angle + np.pi) % (2 * np.pi) - np.pi, dtype=np.float64)
