"""Candidate vanishing points of a photo: RANSAC over pairs of segments."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.imaging.segments import Segments

_SAMPLES = 500
_TOLERANCE_RAD = np.deg2rad(2.0)
_DISTINCT_RAD = np.deg2rad(4.0)
_STEEP_RAD = np.deg2rad(50.0)
"""Segments steeper than this may run up the wall, flatter than 90 - 25 degrees along it."""

_FLAT_RAD = np.deg2rad(65.0)


@dataclass(frozen=True)
class Candidates:
    """Homogeneous vanishing points (k, 3) of unit norm in centred pixels / diagonal, best first."""

    points: NDArray[np.float64]
    support: NDArray[np.float64]


def vertical_candidates(
    segments: Segments, weights: NDArray[np.float64], count: int, rng: np.random.Generator
) -> Candidates:
    """Where steep segments meet. Coordinates as those of the segments."""
    steep = np.arctan2(np.abs(segments.directions()[:, 1]), np.abs(segments.directions()[:, 0]))
    return _candidates(segments, weights, steep >= _STEEP_RAD, count, rng)


def horizontal_candidates(
    segments: Segments, weights: NDArray[np.float64], count: int, rng: np.random.Generator
) -> Candidates:
    """Where segments that are not steep meet. Coordinates as those of the segments."""
    steep = np.arctan2(np.abs(segments.directions()[:, 1]), np.abs(segments.directions()[:, 0]))
    return _candidates(segments, weights, steep <= _FLAT_RAD, count, rng)


def _candidates(
    segments: Segments,
    weights: NDArray[np.float64],
    usable: NDArray[np.bool_],
    count: int,
    rng: np.random.Generator,
) -> Candidates:
    chosen, weight = segments.select(usable), weights[usable]
    if len(chosen) < 2:
        return Candidates(np.zeros((0, 3)), np.zeros(0))
    points = _sampled_points(chosen, weight, rng)
    near = _near(chosen, points)
    support = near @ weight
    kept: list[int] = []
    left = np.ones(len(points), dtype=np.bool_)
    while len(kept) < count and left.any():
        best = int(np.argmax(np.where(left, support, -1.0)))
        kept.append(best)
        # Drop those that are explained by the same segments.
        shared = near[:, near[best]] @ weight[near[best]]
        left &= shared < 0.6 * np.minimum(support, support[best])
        left[best] = False
    return Candidates(points[kept], support[kept])


def _sampled_points(
    segments: Segments, weights: NDArray[np.float64], rng: np.random.Generator
) -> NDArray[np.float64]:
    """(s, 3) unit homogeneous meeting points of random pairs, long segments more often."""
    lines = np.cross(_homogeneous(segments.start), _homogeneous(segments.end))
    lines /= np.linalg.norm(lines, axis=1)[:, None]
    pick = rng.choice(len(segments), size=(_SAMPLES, 2), p=weights / weights.sum())
    pick = pick[pick[:, 0] != pick[:, 1]]
    points = np.cross(lines[pick[:, 0]], lines[pick[:, 1]])
    norm = np.linalg.norm(points, axis=1)
    good = norm > 1e-9
    return np.asarray(points[good] / norm[good, None])


def _near(segments: Segments, points: NDArray[np.float64]) -> NDArray[np.bool_]:
    """(s, n) whether segment n points at vanishing point s within the tolerance."""
    middle, direction = segments.midpoints(), segments.directions()
    towards_x = points[:, :1] - middle[None, :, 0] * points[:, 2:]
    towards_y = points[:, 1:2] - middle[None, :, 1] * points[:, 2:]
    cross = np.abs(direction[None, :, 0] * towards_y - direction[None, :, 1] * towards_x)
    length = np.hypot(towards_x, towards_y)
    return np.asarray(cross <= np.sin(_TOLERANCE_RAD) * length)


def _homogeneous(points: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.hstack([points, np.ones((len(points), 1))])
