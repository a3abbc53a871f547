"""How well each point is known, and which way the surface lies that it is on.

Both are free of units: all lengths are in the frame of the structure, whatever its scale.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from veduta.photos.structure import Structure, errors_px

NEIGHBOURS = 16
"""Points that a normal is taken from, itself included."""
_MEDIAN_TO_SIGMA = 1.0 / 1.17741
"""The median length of a vector of two normal errors is 1.177 of their standard deviation."""
_LEAST_SIGMA_PX = 0.05
_FARTHEST = 1e-9
"""Least information, as a part of the largest: a point whose rays are parallel."""


@dataclass(frozen=True)
class PointQuality:
    """What is known of each of the p points.

    covariance: (p, 3, 3) by the observations alone. normal: (p, 3) unit, of its neighbourhood,
    towards the photos. thickness: (p,) root mean square of the neighbours across it; flatness:
    (p,) from 0 (a blob) to 1 (a plane). seen_from: (p, 3) mean place of the photos that see it.
    distance: (p,) from there.
    """

    covariance: NDArray[np.float64]
    normal: NDArray[np.float64]
    thickness: NDArray[np.float64]
    flatness: NDArray[np.float64]
    seen_from: NDArray[np.float64]
    distance: NDArray[np.float64]


def point_quality(structure: Structure) -> PointQuality:
    """The quality of all points. NEIGHBOURS points at least."""
    seen_from = _seen_from(structure)
    normal, thickness, flatness = surfaces(structure.points, NEIGHBOURS)
    towards = np.einsum("pi,pi->p", normal, seen_from - structure.points)
    return PointQuality(
        covariance=point_covariances(structure),
        normal=np.where(towards[:, None] < 0.0, -normal, normal),
        thickness=thickness,
        flatness=flatness,
        seen_from=seen_from,
        distance=np.linalg.norm(structure.points - seen_from, axis=1),
    )


def typical_reach(structure: Structure) -> float:
    """Median distance of a point from the middle of the photos that see it."""
    return float(np.median(np.linalg.norm(structure.points - _seen_from(structure), axis=1)))


def point_covariances(structure: Structure) -> NDArray[np.float64]:
    """(p, 3, 3) how far each point may lie off, by its observations with the poses held.

    The inverse of the sum of the observations' information, J^T J / sigma^2, where J is the
    derivative of the projection (without distortion) and sigma the scatter of the residuals.
    """
    count = len(structure.points)
    information = np.zeros((count, 3, 3))
    for row, pose in enumerate(structure.cam_from_world):
        own = structure.point_of[structure.image_of == row]
        x, y, z = (structure.points[own] @ pose[:, :3].T + pose[:, 3]).T
        focal = structure.camera(row).mean_focal_length()
        depth = np.where(np.abs(z) < 1e-12, np.inf, z)
        zero = np.zeros_like(x)
        down = np.stack(
            [np.stack([1.0 / depth, zero, -x / depth**2], -1),
             np.stack([zero, 1.0 / depth, -y / depth**2], -1)], axis=1
        )  # fmt: skip
        slope = focal * down @ pose[:, :3]
        np.add.at(information, own, np.swapaxes(slope, 1, 2) @ slope)
    values, vectors = np.linalg.eigh(information)
    values = np.maximum(values, np.maximum(values[:, -1:] * _FARTHEST, 1e-300))
    errors = errors_px(structure)
    finite = errors[np.isfinite(errors)]
    sigma = _MEDIAN_TO_SIGMA * float(np.median(finite)) if len(finite) else _LEAST_SIGMA_PX
    spread = max(sigma, _LEAST_SIGMA_PX) ** 2 / values
    found: NDArray[np.float64] = (vectors * spread[:, None, :]) @ np.swapaxes(vectors, 1, 2)
    return found


def surfaces(
    points: NDArray[np.float64], neighbours: int
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Normal, thickness and flatness of the neighbourhood of each of (p, 3) points."""
    near = cKDTree(points).query(points, k=min(neighbours, len(points)))[1]
    around = points[near] - points[near].mean(axis=1, keepdims=True)
    spread, axes = np.linalg.eigh(np.swapaxes(around, 1, 2) @ around / near.shape[1])
    spread = np.maximum(spread, 0.0)
    flatness = 1.0 - np.sqrt(spread[:, 0] / np.maximum(spread[:, 1], 1e-300))
    return axes[:, :, 0], np.sqrt(spread[:, 0]), flatness


def _seen_from(structure: Structure) -> NDArray[np.float64]:
    sums = np.zeros_like(structure.points)
    np.add.at(sums, structure.point_of, structure.centres()[structure.image_of])
    counts = np.bincount(structure.point_of, minlength=len(sums))
    found: NDArray[np.float64] = sums / np.maximum(counts, 1)[:, None]
    return found
