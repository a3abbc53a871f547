"""Up, from what is upright itself: walls, and the vertical edges that the photos show.

People hold cameras level to about a degree (`orient`); a wall of 15 m leans by a hand's breadth
then. What is vertical in the scene says it better: normals of walls are level, and so is the normal
of the plane through a camera and a vertical edge. Each is a direction that up is square to; the up
is taken that suits them, with weights that forgive what is not upright.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.photos.cameras.orient import GROUND_SHARE, transformed
from veduta.photos.structure import Structure
from veduta.photos.walls.plan_view import FLAT_ENOUGH, STEEPEST
from veduta.photos.walls.point_quality import surfaces

ROUNDS = 30
FARTHEST_RAD = np.deg2rad(6.0)
"""Up is looked for so far about that which the cameras say; directions further off are others."""
FINEST_RAD = np.deg2rad(0.05)
"""Least scatter that is believed."""
PRIOR_RAD = np.deg2rad(1.0)
"""How well the cameras alone say it."""
FEWEST = 20
NEIGHBOURS = 32
"""Points that the normal of a wall's neighbourhood is taken from."""
SHARED_RAD = np.deg2rad(0.5)
"""What the directions of one kind may be off by together: the drift of the poses, relief."""


TRUE_RAD = np.deg2rad(0.25)
"""What stands upright in one place may lean together: plumb lines of buildings, drift of poses."""


@dataclass(frozen=True)
class Upright:
    """up: (3,) unit. moved_deg: from what the cameras said. sd_deg: about the worse known axis.
    by: what says it where walls and vertical edges do not.
    """

    up: NDArray[np.float64]
    moved_deg: float
    sd_deg: float
    by: str = ""

    @property
    def whole_sd_rad(self) -> float:
        """How well up is known: what the directions scatter by, and what they have in common."""
        return float(np.hypot(np.deg2rad(self.sd_deg), TRUE_RAD))


def level_normals(
    points: NDArray[np.float64], up: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """(n, 3) normals of the flat neighbourhoods that stand upright, nearly, and their weights."""
    normal, _, flatness = surfaces(points, NEIGHBOURS)
    upright = (np.abs(normal @ up) <= STEEPEST) & (flatness >= FLAT_ENOUGH)
    return normal[upright], flatness[upright]


def upright(
    structure: Structure, edges: tuple[NDArray[np.float64], NDArray[np.float64]] | None = None
) -> tuple[Structure, Upright]:
    """The structure, whose z is about up, turned so that walls and edges stand upright.

    edges: (n, 3) normals of the planes through a camera and an edge that may be vertical, and
    their weights, where photos were looked at. They are finer than walls, and have the last word.
    """
    first = np.array([0.0, 0.0, 1.0])
    found = refined_up(first, *level_normals(structure.points, first))
    if edges is not None and len(edges[0]):
        finer = refined_up(found.up, *edges, prior_rad=np.deg2rad(found.sd_deg) + SHARED_RAD)
        found = Upright(finer.up, _degrees(finer.up, first), finer.sd_deg)
    axis = np.cross(found.up, first)
    turn = cv2.Rodrigues(
        axis / max(float(np.linalg.norm(axis)), 1e-300) * np.deg2rad(_degrees(found.up, first))
    )[0]
    foot = float(np.quantile(structure.points[:, 2], GROUND_SHARE))
    turned = structure.points @ np.asarray(turn).T
    shift = np.array([0.0, 0.0, foot - float(np.quantile(turned[:, 2], GROUND_SHARE))])
    return transformed(structure, 1.0, np.asarray(turn), shift), found


def _degrees(one: NDArray[np.float64], two: NDArray[np.float64]) -> float:
    return float(np.rad2deg(np.arctan2(np.linalg.norm(np.cross(one, two)), one @ two)))


def refined_up(
    up: NDArray[np.float64],
    level: NDArray[np.float64],
    weights: NDArray[np.float64],
    prior_rad: float = PRIOR_RAD,
) -> Upright:
    """The up that (n, 3) unit directions are square to, from a first one; weights: (n,).

    Tukey's weights, their width from twice `FARTHEST_RAD` down to the scatter of the directions.
    About an axis that no direction speaks of the first up stays.
    """
    first, scatter = up, FARTHEST_RAD / 3.0
    basis = np.linalg.svd(first[None])[2][1:]
    cost = np.zeros((2, 2))
    count = 0.0
    for _ in range(ROUNDS):
        lean = np.arcsin(np.clip(level @ up, -1.0, 1.0))
        tail = np.clip(1.0 - (lean / (4.685 * scatter)) ** 2, 0.0, None) ** 2 * weights
        count = float(tail.sum()) ** 2 / max(float((tail**2).sum()), 1e-300)
        if count < FEWEST:
            return Upright(first, 0.0, float(np.rad2deg(prior_rad)))
        tail = tail * count / float(tail.sum())
        # up = first + basis^T x; level . up = 0 for the weighted, and x = 0 by the prior.
        slope = level @ basis.T
        cost = (slope * tail[:, None]).T @ slope / scatter**2 + np.eye(2) / prior_rad**2
        step = np.linalg.solve(cost, -(slope * tail[:, None]).T @ (level @ first) / scatter**2)
        up = first + basis.T @ step
        up = up / np.linalg.norm(up)
        inside = np.abs(lean) < FARTHEST_RAD
        if inside.any():
            scatter = max(FINEST_RAD, 1.4826 * _median(np.abs(lean[inside]), weights[inside]))
    sd = float(np.sqrt(np.linalg.inv(cost).diagonal().max()))
    return Upright(up, _degrees(up, first), float(np.rad2deg(sd)))


def _median(values: NDArray[np.float64], weights: NDArray[np.float64]) -> float:
    order = np.argsort(values)
    sums = np.cumsum(weights[order])
    return float(values[order][np.searchsorted(sums, 0.5 * sums[-1])])
