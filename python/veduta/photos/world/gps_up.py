"""Up by GPS: where photos were taken all over an area, their places in space say it.

Along a street GPS leaves the roll open, and how cameras were held says more. From the air it is
the other way round: photos look down, and lie apart to all sides.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.photos.structure import Structure
from veduta.photos.world.absolute_orientation import absolute_orientation
from veduta.photos.world.gps_positions import GpsPositions


@dataclass(frozen=True)
class GpsUpParameters:
    """fewest: positions with heights. least_sd_m: of one coordinate, whatever is left says; of a
    barometer and of a receiver in the open. most_sd_rad: of up, beyond which it is not believed.
    differs_rad, deviations: how far the up of the photos must be off for GPS to overrule it.
    inliers: share of the positions that must agree. rounds: of the robust fit.
    """

    fewest: int = 5
    least_sd_m: float = 0.5
    most_sd_rad: float = float(np.deg2rad(6.0))
    differs_rad: float = float(np.deg2rad(8.0))
    deviations: float = 4.0
    inliers: float = 0.6
    rounds: int = 8


@dataclass(frozen=True)
class GpsUp:
    """up: (3,) in the structure's frame. sd_rad: of it. scale: metres in a unit."""

    up: NDArray[np.float64]
    sd_rad: float
    scale: float


def gps_up(
    structure: Structure, positions: GpsPositions, parameters: GpsUpParameters | None = None
) -> GpsUp | None:
    """By a similarity in space, robust against single positions; None where it says nothing."""
    known = parameters or GpsUpParameters()
    told = np.isfinite(positions.height)
    if told.sum() < known.fewest:
        return None
    own = structure.centres()[positions.rows[told]]
    there = np.column_stack([positions.east_north[told], positions.height[told]])
    kept = np.ones(len(own), dtype=bool)
    similarity = absolute_orientation(own, there)
    left = np.linalg.norm(similarity.moved(own) - there, axis=1)
    for _ in range(known.rounds):
        bound = max(3.0 * float(np.median(left)), 3.0 * known.least_sd_m)
        again = left <= bound
        if (again == kept).all() or again.sum() < known.fewest:
            break
        kept = again
        similarity = absolute_orientation(own[kept], there[kept])
        left = np.linalg.norm(similarity.moved(own) - there, axis=1)
    if kept.mean() < known.inliers:
        return None
    spread = np.linalg.svd(there[kept] - there[kept].mean(axis=0), compute_uv=False)
    spare = max(1, 3 * int(kept.sum()) - 7)
    sd_m = max(known.least_sd_m, float(np.sqrt((left[kept] ** 2).sum() / spare)))
    # A turn about the longest axis moves the places by what they spread across it.
    sd_rad = sd_m / max(float(spread[1]), 1e-9)
    if sd_rad > known.most_sd_rad:
        return None
    return GpsUp(similarity.rotation[2], float(sd_rad), similarity.scale)


def overrules(up: GpsUp, parameters: GpsUpParameters | None = None) -> bool:
    """Whether a structure's own up, its z, cannot be what GPS says."""
    known = parameters or GpsUpParameters()
    off = float(np.arccos(np.clip(up.up[2], -1.0, 1.0)))
    return off > max(known.differs_rad, known.deviations * up.sd_rad)
