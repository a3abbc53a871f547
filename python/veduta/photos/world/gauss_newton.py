"""One step towards the placement that leaves least between what was seen and a model's facades.

Eight unknowns: the logarithm of the scale, the rotation (radians about east, north, up), the shift
of the middle of the photos (m), and how far what is seen of facades lies behind their planes:
outlines are drawn by the wall, while glass, frames and doors, which have most of the points, stand
back from it. Up is known beforehand, not quite.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from veduta.photos.world.georeference import Similarity

UP_SD_RAD = float(np.deg2rad(1.5))
"""How well up is known before where only cameras say it: from how people hold them."""
BEHIND_M, BEHIND_SD_M = 0.05, 0.1
"""How far points of a facade lie behind its plane on average, before they are looked at."""
GATE = 3.5
"""A residual beyond so many deviations counts nothing."""
_UNKNOWNS = 7
_MOST_STEP = 0.1
"""Of the logarithm of the scale, of the rotation (radians) and of what lies behind (m)."""


@dataclass(frozen=True)
class Rows:
    """Residual = direction . place - offset, of r places in the frame of the structure.

    place, direction: (r, 3). is_plane: (r,) whether the residual is along a facade's normal.
    share: (r,) what a row counts beside others that say the same. group: (r,) rows of one group
    may be off together.
    """

    place: NDArray[np.float64]
    direction: NDArray[np.float64]
    offset: NDArray[np.float64]
    is_plane: NDArray[np.bool_]
    share: NDArray[np.float64]
    group: NDArray[np.int64]


@dataclass(frozen=True)
class Pose:
    """Where the structure lies; behind_m: what is seen of facades lies so far behind them."""

    similarity: Similarity
    behind_m: float = BEHIND_M


@dataclass(frozen=True)
class Step:
    """The next pose; left_m, weight: (r,) the residuals before it and what they count.

    covariance: (7, 7) of all unknowns but the last.
    """

    pose: Pose
    covariance: NDArray[np.float64]
    left_m: NDArray[np.float64]
    weight: NDArray[np.float64]


def stepped(
    now: Pose,
    rows: Rows,
    sd: NDArray[np.float64],
    middle: NDArray[np.float64],
    up_sd_rad: float,
) -> Step:
    """One step of Gauss-Newton with weights that fall off for what does not fit (Tukey).

    sd: (r,) metres. middle: (3,) of the photos. up_sd_rad: of the structure's z, as up.
    """
    before = now.similarity
    arm = before.scale * (rows.place - middle) @ before.rotation.T
    centre = before.moved(middle[None])[0]
    left = residuals_m(now, rows)
    weight = weights(left, sd)
    jacobian = np.column_stack(
        [
            (rows.direction * arm).sum(axis=1),
            np.cross(arm, rows.direction),
            rows.direction,
            rows.is_plane,
        ]
    )
    strength = weight * rows.share / sd**2
    known, right = _known_before(now, up_sd_rad)
    normal = jacobian.T @ (strength[:, None] * jacobian) + known
    right -= jacobian.T @ (strength * left)
    inverse = np.linalg.inv(normal)
    step = inverse @ right
    for part in (slice(0, 4), slice(7, 8)):
        step[part] = np.clip(step[part], -_MOST_STEP, _MOST_STEP)
    scale = before.scale * float(np.exp(step[0]))
    turn = Rotation.from_rotvec(step[1:4]).as_matrix() @ before.rotation
    shift = centre + step[4:7] - scale * turn @ middle
    covariance = _covariance(inverse, jacobian * (strength * left)[:, None], rows.group)
    after = Pose(Similarity(scale, turn, shift), now.behind_m + float(step[7]))
    return Step(after, covariance[:_UNKNOWNS, :_UNKNOWNS], left, weight)


def residuals_m(pose: Pose, rows: Rows) -> NDArray[np.float64]:
    """(r,) what a pose leaves."""
    there = pose.similarity.moved(rows.place)
    behind = np.where(rows.is_plane, pose.behind_m, 0.0)
    found: NDArray[np.float64] = (rows.direction * there).sum(axis=1) - rows.offset + behind
    return found


def weights(left_m: NDArray[np.float64], sd: NDArray[np.float64]) -> NDArray[np.float64]:
    """(r,) 0 to 1, by what is left (Tukey's biweight)."""
    return np.maximum(0.0, 1.0 - (left_m / (GATE * sd)) ** 2) ** 2


def median_sd(left_m: NDArray[np.float64], low: float, high: float) -> float:
    """The deviation that the median of residuals speaks for, within bounds; high for too few."""
    if len(left_m) < 4:
        return high
    return float(np.clip(1.4826 * np.median(np.abs(left_m)), low, high))


def _known_before(now: Pose, up_sd_rad: float) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """(8, 8) and (8,) of the normal equations: up, what lies behind, and a little of the rest."""
    up = now.similarity.rotation[:, 2]
    tilt = np.zeros((2, _UNKNOWNS + 1))
    tilt[0, 1:4] = (0.0, up[2], -up[1])
    tilt[1, 1:4] = (-up[2], 0.0, up[0])
    normal = tilt.T @ tilt / up_sd_rad**2
    normal += np.diag([1e-2, 0.0, 0.0, 1e-2, 1e-6, 1e-6, 1e-6, 1.0 / BEHIND_SD_M**2])
    right = -tilt.T @ up[:2] / up_sd_rad**2
    right[7] -= (now.behind_m - BEHIND_M) / BEHIND_SD_M**2
    return normal, right


def _covariance(
    inverse: NDArray[np.float64], pull: NDArray[np.float64], group: NDArray[np.int64]
) -> NDArray[np.float64]:
    """(8, 8) from what each group pulls at the unknowns, and no less than from the noise alone.

    What is left at one facade is not independent: it is drawn wrong, or its points lie off
    together. So facades are what counts (the estimator of clusters).
    """
    groups, group = np.unique(group, return_inverse=True)
    pulls = np.zeros((len(groups), pull.shape[1]))
    np.add.at(pulls, group, pull)
    count = len(groups)
    spare = max(1.0, count - 4.0)
    spread = inverse @ (pulls.T @ pulls) @ inverse * count / spare
    factor = np.sqrt(np.maximum(1.0, np.diag(spread) / np.diag(inverse)))
    found: NDArray[np.float64] = inverse * np.outer(factor, factor)
    return found
