"""The ground that a camera stands over, as a plane, and how high above it points are."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class GroundLimits:
    """farthest_m: of points that count. spread_m: how far from the plane they count. rounds: of the
    fit. least: points that make a ground.
    """

    farthest_m: float = 30.0
    spread_m: float = 0.4
    rounds: int = 8
    least: int = 200


def height_above_ground(
    points: Floats, measured: NDArray[np.bool_], limits: GroundLimits = GroundLimits()
) -> Floats | None:
    """(h, w) metres above the plane under the camera; None where no ground is seen.

    points: (h, w, 3) in the camera's frame, y down. The lowest points begin, and what is near the
    plane is fitted again: y = a + b x + c z.
    """
    near = measured & (points[..., 1] > 0.2) & (points[..., 2] < limits.farthest_m)
    if near.sum() < limits.least:
        return None
    chosen = points[near]
    thin = chosen[:: max(1, len(chosen) // 20_000)]
    table = np.column_stack([np.ones(len(thin)), thin[:, 0], thin[:, 2]])
    plane = np.array([np.percentile(thin[thin[:, 2] < np.percentile(thin[:, 2], 40), 1], 85), 0, 0])
    for step in range(limits.rounds):
        spread = limits.spread_m * max(1.0, 3.0 - step)
        off = (thin[:, 1] - table @ plane) / spread
        weight = np.exp(-np.minimum(off**2, 60.0))
        weighted = table * weight[:, None]
        plane = np.linalg.solve(table.T @ weighted + 1e-6 * np.eye(3), weighted.T @ thin[:, 1])
    ground = plane[0] + plane[1] * points[..., 0] + plane[2] * points[..., 2]
    return np.asarray(ground - points[..., 1])
