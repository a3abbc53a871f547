"""A frame for a model that has none: z up, y the way that the photos look.

Structure from motion knows a place up to a similarity. Up is inferred from how people hold
cameras: the rows of their photos are level, whichever way they turn and tilt them. The scale is
not known without further records; the model gets a size at which a screen shows it well.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from veduta.photos.cameras.looking_down import survey_up
from veduta.photos.structure import Structure

TYPICAL_DISTANCE = 10.0
"""Median distance of a point from the cameras that see it, in the units of the result."""
TILT_WEIGHT = 0.01
"""What the columns of the photos say of up, against their rows; it decides where all photos look
one way, and their rows leave a circle of directions open."""
AGREEING = 0.5
"""Length of the mean of the photos' columns from which on they point one way, on the whole."""
LEAST_OTHER_WAY = 0.15
"""Share of the photos that look the other way."""
GROUND_SHARE = 0.01
"""Share of the points that may lie under z = 0: they are the false ones, or a cellar."""


@dataclass(frozen=True)
class Oriented:
    """The model in its new frame. level_deg: spread of the photos' rows about the horizontal."""

    structure: Structure
    level_deg: float


def oriented(structure: Structure, up: NDArray[np.float64] | None = None) -> Oriented:
    """The same model with z up, the photos looking along y, and the points about the origin.

    up: (3,) in the frame of the model, where it is known; else by the photos, which may look down.
    """
    rotations = structure.cam_from_world[:, :, :3]
    up = survey_up(structure) if up is None else up
    up = up_direction(rotations) if up is None else up
    level = np.rad2deg(np.arcsin(np.clip(np.abs(rotations[:, 0] @ up), 0.0, 1.0)))
    turn = _turn(up, rotations[:, 2].mean(axis=0))
    scale = TYPICAL_DISTANCE / _typical_distance(structure)
    points = scale * structure.points @ turn.T
    middle = np.median(points, axis=0)
    middle[2] = np.quantile(points[:, 2], GROUND_SHARE)
    return Oriented(transformed(structure, scale, turn, -middle), float(np.median(level)))


def up_direction(cam_from_world: NDArray[np.float64]) -> NDArray[np.float64]:
    """(3,) unit vector up, in the frame of the model, from (n, 3, 3) rotations."""
    rows, columns = cam_from_world[:, 0], cam_from_world[:, 1]
    tilt = columns.T @ columns
    mean = _mean_of_both_ways(rows, columns)
    if np.linalg.norm(mean) > AGREEING:  # what is level of them lies to all sides, and goes
        tilt = len(columns) * np.outer(mean, mean)
    form = rows.T @ rows - TILT_WEIGHT * tilt
    up: NDArray[np.float64] = np.linalg.eigh(form)[1][:, 0]
    # Image rows count downwards.
    return up if float((columns @ up).mean()) < 0.0 else -up


def _mean_of_both_ways(
    rows: NDArray[np.float64], columns: NDArray[np.float64]
) -> NDArray[np.float64]:
    """(3,) of the columns of photos that look one way, and of those that look the other, alike.

    Lines of a survey are flown there and back: what is level of their columns then goes.
    """
    axis = np.linalg.eigh(rows.T @ rows)[1][:, 2]
    there = rows @ axis > 0.0
    if min(int(there.sum()), int((~there).sum())) < LEAST_OTHER_WAY * len(rows):
        mean: NDArray[np.float64] = columns.mean(axis=0)
        return mean
    both: NDArray[np.float64] = (columns[there].mean(axis=0) + columns[~there].mean(axis=0)) / 2.0
    return both


def transformed(
    structure: Structure, scale: float, turn: NDArray[np.float64], shift: NDArray[np.float64]
) -> Structure:
    """The model in another frame: x becomes `scale * turn @ x + shift`.

    The cameras' own axes keep the scale of the points, so that projections stay.
    """
    return replace(
        structure,
        cam_from_world=moved_poses(structure.cam_from_world, scale, turn, shift),
        points=scale * structure.points @ turn.T + shift,
    )


def moved_poses(
    poses: NDArray[np.float64], scale: float, turn: NDArray[np.float64], shift: NDArray[np.float64]
) -> NDArray[np.float64]:
    """(n, 3, 4) cam_from_world where the world's x becomes `scale * turn @ x + shift`."""
    rotations = poses[:, :, :3] @ turn.T
    shifts = scale * poses[:, :, 3] - rotations @ shift
    return np.concatenate([rotations, shifts[:, :, None]], axis=2)


def _turn(up: NDArray[np.float64], ahead: NDArray[np.float64]) -> NDArray[np.float64]:
    """(3, 3) rotation that takes `up` to z and the level part of `ahead` to y."""
    level = ahead - (ahead @ up) * up
    length = float(np.linalg.norm(level))
    if length < 1e-6:  # straight down, or all around: any way will do
        level = np.cross(up, np.eye(3)[int(np.argmin(np.abs(up)))])
        length = float(np.linalg.norm(level))
    north = level / length
    return np.stack([np.cross(north, up), north, up])


def _typical_distance(structure: Structure) -> float:
    apart = structure.points[structure.point_of] - structure.centres()[structure.image_of]
    return float(np.median(np.linalg.norm(apart, axis=1)))
