"""Where lots lie on Earth, as rules ask for it (`getGeoCoord`)."""

from __future__ import annotations

import functools
from dataclasses import dataclass

import numpy as np
import pyproj

from veduta.geometry.crs import LONGITUDE_LATITUDE
from veduta.grammar.lot import Lot

NAME = "/onEarth"
"""Of what the engine is given."""
STEP_M = 50.0
"""Over which longitude and latitude are taken to grow evenly."""


@dataclass(frozen=True)
class OnEarth:
    """The frame of all lots. crs: EPSG code of its metres. origin_m: of all lots, in that CRS."""

    crs: str
    origin_m: tuple[float, float, float]

    def about(self, lot: Lot) -> dict[str, list[float]]:
        """x and y of the lot's anchor, its longitude and latitude (degrees), and how much each
        grows with a metre to the east and to the north.
        """
        x, y = (self.origin_m[axis] + lot.anchor_m[axis] for axis in range(2))
        points = np.array(
            [(x, y), (x - STEP_M, y), (x + STEP_M, y), (x, y - STEP_M), (x, y + STEP_M)]
        )
        longitude, latitude = _to_degrees(self.crs).transform(points[:, 0], points[:, 1])
        both = np.column_stack([longitude, latitude])
        if not np.isfinite(both).all():
            return {}
        by_east, by_north = (both[2] - both[1]) / (2 * STEP_M), (both[4] - both[3]) / (2 * STEP_M)
        grown = [by_east[0], by_north[0], by_east[1], by_north[1]]
        return {NAME: [x, y, *both[0].tolist(), *(float(one) for one in grown)]}


@functools.lru_cache(maxsize=4)
def _to_degrees(crs: str) -> pyproj.Transformer:
    return pyproj.Transformer.from_crs(crs, LONGITUDE_LATITUDE, always_xy=True)


def on_earth(crs: str | None, origin_m: tuple[float, float, float]) -> OnEarth | None:
    """Where a frame lies; None where nobody knows."""
    return None if crs is None else OnEarth(crs, origin_m)
