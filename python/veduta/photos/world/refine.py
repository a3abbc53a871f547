"""The placement that leaves least between walls and facades, in space, with its uncertainty.

Absolute orientation by the corners of facades (equation 2.33), but each corner counts along what
is known of it: a wall's plane is known to centimetres, its edges to decimetres, its foot hardly at
all. The noise of each kind is taken from the residuals.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.photos.world.columns import Placements, WallColumns
from veduta.photos.world.evidence import FacadeIndex, Matches, match_walls
from veduta.photos.world.gauss_newton import (
    GATE,
    UP_SD_RAD,
    Pose,
    Rows,
    median_sd,
    stepped,
)
from veduta.photos.world.georeference import Similarity

ITERATIONS = 8
LEAST_SD_M = (0.05, 0.15, 0.2, 0.5)
"""Plane, edge, top, foot: models are drawn no finer than this."""
FIRST_SD_M = (0.3, 0.5, 0.7, 1.0)
CORNERS_SHARE = 0.5
"""Four corners of a plane say two things of its place, not four."""
PLANE, EDGE, TOP, FOOT = range(4)


@dataclass(frozen=True)
class Refined:
    """A placement in space. covariance: (7, 7) of the logarithm of scale, the rotation (radians
    about east, north, up) and the shift of the middle (m).

    wall, kind, left_m: (r,) of each residual its wall, kind and size. weight: (r,) 0 to 1.
    """

    pose: Pose
    covariance: NDArray[np.float64]
    wall: NDArray[np.int64]
    kind: NDArray[np.int64]
    left_m: NDArray[np.float64]
    weight: NDArray[np.float64]

    @property
    def world_from_model(self) -> Similarity:
        """How the structure lies in the world."""
        return self.pose.similarity

    @property
    def level(self) -> Placements:
        """The same without the tilt."""
        turn = self.world_from_model.rotation
        across, shift = turn[0, 0] + turn[1, 1], self.world_from_model.shift
        angle = np.arctan2(turn[1, 0] - turn[0, 1], across)
        factor = self.world_from_model.scale * np.exp(1j * angle)
        return Placements(np.array([factor]), np.array([complex(shift[0], shift[1])]))


@dataclass(frozen=True)
class WallRows:
    """What walls say of a placement; wall, kind: (r,) of each of the rows."""

    rows: Rows
    wall: NDArray[np.int64]
    kind: NDArray[np.int64]


def refine(
    walls: WallColumns,
    corners: NDArray[np.float64],
    index: FacadeIndex,
    placement: Placements,
    middle: NDArray[np.float64],
    up_sd_rad: float = UP_SD_RAD,
) -> Refined:
    """From one placement on; corners: (w, 4, 3) of the walls in their own frame, start and end at
    the foot, then at the top. middle: (3,) of the photos. up_sd_rad: of the structure's z, as up.
    """
    matches = match_walls(walls, index, placement)
    turn, shift = placement.turn[0], placement.shift[0]
    now = Pose(
        Similarity(
            float(np.abs(turn)),
            _about_up(float(np.angle(turn))),
            np.array([shift.real, shift.imag, matches.lift_m[0]]),
        )
    )
    sds = np.array(FIRST_SD_M)
    for step in range(ITERATIONS + 1):
        seen = wall_rows(corners, index, matches)
        after = stepped(now, seen.rows, sds[seen.kind], middle, up_sd_rad)
        now = after.pose
        refined = Refined(now, after.covariance, seen.wall, seen.kind, after.left_m, after.weight)
        if step == ITERATIONS:
            break
        if step >= 2:
            sds = deviations(seen.kind, after.left_m, sds)
        matches = match_walls(walls, index, refined.level)
    return refined


def _about_up(angle: float) -> NDArray[np.float64]:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def wall_rows(corners: NDArray[np.float64], index: FacadeIndex, matches: Matches) -> WallRows:
    """Planes, edges, tops and feet of walls against those of the facades they are matched with."""
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
    on = np.flatnonzero((facade >= 0).any(axis=1))
    add(on, corners[on, 2:].mean(axis=1), up, tops[on], TOP)
    add(on, corners[on, :2].mean(axis=1), up, feet[on], FOOT)
    what = np.concatenate(kind).astype(np.int64)
    whose = np.concatenate(wall).astype(np.int64)
    is_plane = what == PLANE
    found = Rows(
        np.concatenate(place),
        np.concatenate(direction),
        np.concatenate(offset),
        is_plane,
        np.where(is_plane, CORNERS_SHARE, 1.0),
        whose,
    )
    return WallRows(found, whose, what)


def deviations(
    kind: NDArray[np.int64], left_m: NDArray[np.float64], before: NDArray[np.float64]
) -> NDArray[np.float64]:
    """(4,) the noise of each kind: by the median of what is left, no finer than models are."""
    inside = np.abs(left_m) < GATE * before[kind]
    return np.array(
        [
            median_sd(left_m[inside & (kind == one)], LEAST_SD_M[one], FIRST_SD_M[one])
            for one in range(4)
        ]
    )
