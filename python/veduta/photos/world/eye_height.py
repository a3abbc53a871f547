"""What the height of the cameras says: photos of a street are mostly taken by who stands in it.

With a placement of the right scale and height the cameras are at the height of eyes above the feet
of the buildings beside them; by chance they may be anywhere up or down. They hang together, so that
all of them say it once.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

from veduta.photos.city.facades import Facades

EYES_M, EYES_SD_M = 1.6, 0.5
"""Above the feet of the nearest building: the street may fall away from it a little."""
ON_FOOT = 0.7
"""Share of collections of photos that are taken from the ground."""
HEIGHTS_PER_M = 0.1
"""How densely heights lie by chance."""
NEAR_M = 40.0
"""Feet of buildings further away say nothing of the ground."""
BESIDE_M = 3.0
"""Beyond the nearest facade: the lowest of these stands on the ground."""


@dataclass(frozen=True)
class Feet:
    """Where the buildings of a model stand on the ground."""

    facades: Facades

    def under(self, places: NDArray[np.float64]) -> NDArray[np.float64]:
        """(n,) the height of the feet beside (n, 2) places; NaN where no building is near."""
        if len(self.facades) == 0:
            return np.full(len(places), np.nan)
        tree, bottom = self._bottoms
        away = np.asarray(tree.query(places)[0])
        # A bay or an upper storey may be the nearest: it does not stand on the ground.
        around = tree.query_ball_point(places, away + BESIDE_M)
        lowest = np.array([bottom[rows].min() for rows in around])
        found: NDArray[np.float64] = np.where(away <= NEAR_M, lowest, np.nan)
        return found

    @cached_property
    def _bottoms(self) -> tuple[KDTree, NDArray[np.float64]]:
        places, row = self.facades.samples()
        return KDTree(places), self.facades.bottom[row]


def eye_height_nats(centres: NDArray[np.float64], feet: Feet) -> float:
    """Logarithm of a likelihood ratio; 0 where no building is near.

    centres: (c, 3) of the cameras, in the world of the facades.
    """
    height = centres[:, 2] - feet.under(centres[:, :2])
    height = height[np.isfinite(height)]
    if len(height) == 0:
        return 0.0
    off = (float(np.median(height)) - EYES_M) / EYES_SD_M
    density = np.exp(-0.5 * off**2) / (EYES_SD_M * np.sqrt(2.0 * np.pi))
    return float(np.log(ON_FOOT * density / HEIGHTS_PER_M + 1.0 - ON_FOOT))
