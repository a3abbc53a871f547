"""The errors that bundle adjustment leaves: a slow warp of all, and the noise of each point."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Drift:
    """A warp along one direction: half a wave over the length, and a whole one half as high.

    axis: (3,) unit. start, length: along it (m). heights_m: (2, 3). phases: (2,).
    """

    axis: Floats
    start: float
    length: float
    heights_m: Floats
    phases: Floats

    def shift(self, points: Floats) -> Floats:
        """(n, 3) how far points are moved."""
        return np.asarray(np.sin(self._angles(points)) @ self.heights_m, np.float64)

    def turn(self, points: Floats) -> Floats:
        """(n, 3) rotation vectors of the surroundings of points: half the curl of the shift."""
        rates = np.array([1.0, 2.0]) * np.pi / self.length
        slope = (np.cos(self._angles(points)) * rates) @ self.heights_m
        return np.asarray(0.5 * np.cross(self.axis, slope), np.float64)

    def _angles(self, points: Floats) -> Floats:
        share = (points @ self.axis - self.start) / self.length
        return np.asarray(np.pi * share[:, None] * np.array([1.0, 2.0]) + self.phases, np.float64)


def draw_drift(centres: Floats, size_m: float, rng: np.random.Generator) -> Drift:
    """A warp whose deviation is about `size_m`, along the longest extent of the photos' places."""
    middle = centres.mean(axis=0)
    axis = np.linalg.svd(centres - middle)[2][0]
    along = centres @ axis
    heights = size_m * rng.standard_normal((2, 3)) * np.array([[1.0], [0.5]])
    phases = rng.uniform(0.0, 2 * np.pi, 2)
    return Drift(axis, float(along.min()), float(np.ptp(along)), heights, phases)


def turned(vectors: Floats) -> Floats:
    """(n, 3, 3) rotations of rotation vectors (n, 3), by Rodrigues' formula."""
    angle = np.linalg.norm(vectors, axis=1)[:, None, None]
    x, y, z = vectors.T
    zero = np.zeros_like(x)
    cross = np.stack([zero, -z, y, z, zero, -x, -y, x, zero], axis=1).reshape(-1, 3, 3)
    safe = np.maximum(angle, 1e-12)
    first, second = np.sin(angle) / safe, (1.0 - np.cos(angle)) / safe**2
    return np.asarray(np.eye(3) + first * cross + second * cross @ cross, np.float64)


def information(
    points: Floats, centres: Floats, point_of: NDArray[np.int64], focal_over_noise: Floats
) -> Floats:
    """(p, 3, 3) what the lines of sight say of each point (1 / m²).

    centres, focal_over_noise: (o, 3) and (o,), of each observation. A line of sight says nothing
    along itself; across, its error grows with the distance.
    """
    sight = points[point_of] - centres
    distance = np.linalg.norm(sight, axis=1)
    sight /= distance[:, None]
    weight = (focal_over_noise / distance) ** 2
    each = weight[:, None, None] * (np.eye(3) - sight[:, :, None] * sight[:, None, :])
    total = np.zeros((len(points), 3, 3))
    np.add.at(total, point_of, each)
    return total
