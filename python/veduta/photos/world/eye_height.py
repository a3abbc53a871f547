"""What the height of the cameras says: photos of a street are mostly taken by who stands in it.

With a placement of the right scale and height the cameras are at the height of eyes above the feet
of the buildings beside them; by chance they may be anywhere up or down. They hang together, so that
all of them say it once.
"""

from __future__ import annotations

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


def eye_height_nats(centres: NDArray[np.float64], facades: Facades) -> float:
    """Logarithm of a likelihood ratio; 0 where no building is near.

    centres: (c, 3) of the cameras, in the world of the facades.
    """
    places, row = facades.samples()
    if len(places) == 0 or len(centres) == 0:
        return 0.0
    found = KDTree(places).query(centres[:, :2])
    away, nearest = np.asarray(found[0]), np.asarray(found[1])
    near = away <= NEAR_M
    if not near.any():
        return 0.0
    height = float(np.median(centres[near, 2] - facades.bottom[row[nearest[near]]]))
    density = np.exp(-0.5 * ((height - EYES_M) / EYES_SD_M) ** 2)
    density /= EYES_SD_M * np.sqrt(2.0 * np.pi)
    return float(np.log(ON_FOOT * density / HEIGHTS_PER_M + 1.0 - ON_FOOT))
