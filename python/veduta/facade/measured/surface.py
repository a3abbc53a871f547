"""The wall's own surface in a depth map: a plane through what is neither hole nor ledge."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Depths = NDArray[np.float32]
Mask = NDArray[np.bool_]
# The median deviation of a normal distribution, as its standard deviation.
NORMAL = 1.4826


@dataclass(frozen=True)
class SurfaceParameters:
    """fewest_px, least_share: of the wall that must have a depth for it to tell anything.
    sigmas, least_m: what deviates more from the plane is no wall (m). rounds: of fitting.
    most_px: pixels that are fitted, evenly taken.
    """

    fewest_px: int = 200
    least_share: float = 0.1
    sigmas: float = 3.0
    least_m: float = 0.02
    rounds: int = 8
    most_px: int = 200_000


@dataclass(frozen=True, eq=False)
class WallSurface:
    """beyond_m: (h, w) how far each pixel stands before it, NaN where unknown. spread_m: of the
    wall about it, as a standard deviation.
    """

    beyond_m: Depths
    spread_m: float


def wall_surface(depths_m: Depths, wall: Mask, parameters: SurfaceParameters) -> WallSurface | None:
    """The plane of the wall's pixels; None where too few of them have a depth.

    Fitted by least squares to what is near it, in rounds, from the median on.
    """
    rows, columns = np.nonzero(wall & np.isfinite(depths_m))
    enough = max(parameters.fewest_px, parameters.least_share * np.count_nonzero(wall))
    if len(rows) < enough:
        return None
    step = -(-len(rows) // parameters.most_px)
    rows, columns = rows[::step], columns[::step]
    height, width = depths_m.shape
    base = np.column_stack([np.ones(len(rows)), columns / width - 0.5, rows / height - 0.5])
    values = depths_m[rows, columns].astype(np.float64)
    plane = np.array([np.median(values), 0.0, 0.0])
    spread = 0.0
    for _ in range(parameters.rounds):
        off = np.abs(values - base @ plane)
        spread = NORMAL * float(np.median(off))
        near = off <= max(parameters.sigmas * spread, parameters.least_m)
        plane = np.linalg.lstsq(base[near], values[near], rcond=None)[0]
    off = np.abs(values - base @ plane)
    spread = NORMAL * float(np.median(off))
    across = plane[1] * (np.arange(width) / width - 0.5)
    down = plane[2] * (np.arange(height) / height - 0.5)
    level = (plane[0] + across + down[:, None]).astype(np.float32)
    return WallSurface(depths_m - level, spread)
