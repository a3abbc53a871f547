"""The placement that leaves least between walls and facades, in space, with its uncertainty.

Absolute orientation by the corners of facades (equation 2.33), but each corner counts along what
is known of it: a wall's plane is known to centimetres, its edges to decimetres, its foot hardly at
all. Seven unknowns: scale, rotation, shift; up is known beforehand, not quite. Gauss-Newton with
weights that fall off for what does not fit; the noise of each kind is taken from the residuals.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.photos.world.columns import Placements, WallColumns
from veduta.photos.world.evidence import FacadeIndex, Matches, match_walls
from veduta.photos.world.georeference import Similarity

ITERATIONS = 8
UP_SD_RAD = np.deg2rad(1.5)
"""How well up is known before: from how people hold cameras."""
LEAST_SD_M = (0.05, 0.15, 0.2, 0.5)
"""Plane, edge, top, foot: models are drawn no finer than this."""
FIRST_SD_M = (0.3, 0.5, 0.7, 1.0)
GATE = 3.5
"""A residual beyond so many deviations counts nothing."""
PLANE, EDGE, TOP, FOOT = range(4)


@dataclass(frozen=True)
class Refined:
    """A placement in space. covariance: (7, 7) of the logarithm of scale, the rotation (radians
    about east, north, up) and the shift of the middle (m). rows: the residuals that count.

    wall, kind, left_m: (r,) of each residual its wall, kind and size. weight: (r,) 0 to 1.
    """

    world_from_model: Similarity
    covariance: NDArray[np.float64]
    wall: NDArray[np.int64]
    kind: NDArray[np.int64]
    left_m: NDArray[np.float64]
    weight: NDArray[np.float64]

    @property
    def level(self) -> Placements:
        """The same without the tilt."""
        turn = self.world_from_model.rotation
        across, shift = turn[0, 0] + turn[1, 1], self.world_from_model.shift
        angle = np.arctan2(turn[1, 0] - turn[0, 1], across)
        factor = self.world_from_model.scale * np.exp(1j * angle)
        return Placements(np.array([factor]), np.array([complex(shift[0], shift[1])]))


@dataclass(frozen=True)
class _Rows:
    """Residual = direction . place - offset, of places of the model."""

    place: NDArray[np.float64]
    direction: NDArray[np.float64]
    offset: NDArray[np.float64]
    wall: NDArray[np.int64]
    kind: NDArray[np.int64]


def refine(
    walls: WallColumns,
    corners: NDArray[np.float64],
    index: FacadeIndex,
    placement: Placements,
    middle: NDArray[np.float64],
) -> Refined:
    """From one placement on; corners: (w, 4, 3) of the walls in their own frame, start and end at
    the foot, then at the top. middle: (3,) of the photos.
    """
    matches = match_walls(walls, index, placement)
    turn, shift = placement.turn[0], placement.shift[0]
    similarity = Similarity(
        float(np.abs(turn)),
        _about_up(float(np.angle(turn))),
        np.array([shift.real, shift.imag, matches.lift_m[0]]),
    )
    sds = np.array(FIRST_SD_M)
    refined = None
    for step in range(ITERATIONS):
        rows = _rows(corners, index, matches)
        refined = _stepped(similarity, rows, sds, middle)
        similarity = refined.world_from_model
        if step >= 2:
            sds = _deviations(refined, sds)
        matches = match_walls(walls, index, refined.level)
    rows = _rows(corners, index, matches)
    return _stepped(similarity, rows, sds, middle)


def _about_up(angle: float) -> NDArray[np.float64]:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def _rows(corners: NDArray[np.float64], index: FacadeIndex, matches: Matches) -> _Rows:
    facades = index.facades
    facade, off = matches.facade[0], matches.off_m[0]
    place, direction, offset, wall, kind = [], [], [], [], []
    up = np.array([0.0, 0.0, 1.0])

    def add(
        rows: NDArray[np.int64],
        at: NDArray[np.float64],
        way: NDArray[np.float64],
        to: NDArray[np.float64],
        what: int,
    ) -> None:
        place.append(at)
        direction.append(np.broadcast_to(way, at.shape))
        offset.append(to)
        wall.append(rows)
        kind.append(np.full(len(rows), what))

    for side, ends in ((0, (0, 3)), (2, (1, 2))):
        rows = np.flatnonzero((facade[:, side] >= 0) & (np.abs(off[:, side]) < 2.0))
        own = facade[rows, side]
        outward = np.column_stack([facades.outward[own], np.zeros(len(own))])
        along = np.column_stack([facades.along[own], np.zeros(len(own))])
        base = (facades.outward[own] * facades.start[own]).sum(axis=1)
        for corner in ends:
            add(rows, corners[rows, corner], outward, base, PLANE)
        edge = facades.start if side == 0 else facades.end
        to = (facades.along[own] * edge[own]).sum(axis=1)
        add(rows, corners[rows][:, list(ends)].mean(axis=1), along, to, EDGE)
    tops = np.where(facade >= 0, facades.top[facade], -np.inf).max(axis=1)
    feet = np.where(facade >= 0, facades.bottom[facade], np.inf).min(axis=1)
    rows = np.flatnonzero((facade >= 0).any(axis=1))
    add(rows, corners[rows, 2:].mean(axis=1), up, tops[rows], TOP)
    add(rows, corners[rows, :2].mean(axis=1), up, feet[rows], FOOT)
    return _Rows(
        np.concatenate(place),
        np.concatenate(direction),
        np.concatenate(offset),
        np.concatenate(wall).astype(np.int64),
        np.concatenate(kind).astype(np.int64),
    )


def _stepped(
    now: Similarity, rows: _Rows, sds: NDArray[np.float64], middle: NDArray[np.float64]
) -> Refined:
    """One step of Gauss-Newton, and what is left before it."""
    arm = now.scale * (rows.place - middle) @ now.rotation.T
    centre = now.moved(middle[None])[0]
    left = (rows.direction * (arm + centre)).sum(axis=1) - rows.offset
    sd = sds[rows.kind]
    # Four corners of a plane say two things of its place, not four.
    share = np.where(rows.kind == PLANE, 0.5, 1.0)
    weight = np.maximum(0.0, 1.0 - (left / (GATE * sd)) ** 2) ** 2
    jacobian = np.column_stack(
        [
            (rows.direction * arm).sum(axis=1),
            np.cross(arm, rows.direction),
            rows.direction,
        ]
    )
    strength = weight * share / sd**2
    normal = jacobian.T @ (strength[:, None] * jacobian)
    right = -jacobian.T @ (strength * left)
    up = now.rotation[:, 2]
    prior = np.zeros((2, 7))
    prior[0, 1:4] = (0.0, up[2], -up[1])
    prior[1, 1:4] = (-up[2], 0.0, up[0])
    normal += prior.T @ prior / UP_SD_RAD**2
    right -= prior.T @ up[:2] / UP_SD_RAD**2
    normal += np.diag([1e-2, 0, 0, 1e-2, 1e-6, 1e-6, 1e-6])
    inverse = np.linalg.inv(normal)
    step = inverse @ right
    step[0] = np.clip(step[0], -0.1, 0.1)
    step[1:4] = np.clip(step[1:4], -0.1, 0.1)
    scale = now.scale * float(np.exp(step[0]))
    turn = _rotation(step[1:4]) @ now.rotation
    shift = centre + step[4:] - scale * turn @ middle
    return Refined(
        Similarity(scale, turn, shift),
        _covariance(inverse, jacobian * (strength * left)[:, None], rows.wall),
        rows.wall,
        rows.kind,
        left,
        weight,
    )


def _covariance(
    inverse: NDArray[np.float64], pull: NDArray[np.float64], wall: NDArray[np.int64]
) -> NDArray[np.float64]:
    """(7, 7) from what each wall pulls at the unknowns, and no less than from the noise alone.

    What is left at the corners of one wall is not independent: its facade is drawn wrong, or its
    points lie off together. So walls are what counts (the estimator of clusters).
    """
    pulls = np.zeros((int(wall.max()) + 1, 7))
    np.add.at(pulls, wall, pull)
    count = len(np.unique(wall))
    spare = max(1.0, count - 4.0)
    spread = inverse @ (pulls.T @ pulls) @ inverse * count / spare
    factor = np.sqrt(np.maximum(1.0, np.diag(spread) / np.diag(inverse)))
    found: NDArray[np.float64] = inverse * np.outer(factor, factor)
    return found


def _rotation(about: NDArray[np.float64]) -> NDArray[np.float64]:
    """(3, 3) of a vector of rotation (Rodrigues)."""
    angle = float(np.linalg.norm(about))
    if angle < 1e-15:
        return np.eye(3)
    x, y, z = about / angle
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    found: NDArray[np.float64] = (
        np.eye(3) + np.sin(angle) * cross + (1.0 - np.cos(angle)) * cross @ cross
    )
    return found


def _deviations(refined: Refined, before: NDArray[np.float64]) -> NDArray[np.float64]:
    """The noise of each kind: the median of what is left, no smaller than models are drawn."""
    found = np.array(LEAST_SD_M)
    for kind in range(4):
        own = (refined.kind == kind) & (np.abs(refined.left_m) < GATE * before[kind])
        if own.sum() >= 4:
            spread = 1.4826 * float(np.median(np.abs(refined.left_m[own])))
            found[kind] = np.clip(spread, LEAST_SD_M[kind], FIRST_SD_M[kind])
        else:
            found[kind] = FIRST_SD_M[kind]
    return found
