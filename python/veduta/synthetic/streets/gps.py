"""What the receivers of a walk would say: places with errors, as degrees."""

from __future__ import annotations

import numpy as np
import pyproj
from numpy.typing import NDArray

from veduta.synthetic.seeds import stream
from veduta.synthetic.streets.house import Street

COMMON = 0.5
"""Share of the variance that all photos of a walk have in common."""


def gps_places(
    positions_m: NDArray[np.float64], seed: int, error_m: float = 5.0
) -> NDArray[np.float64]:
    """(n, 3) positions with errors: root mean square `error_m` in plan, twice as much in height."""
    rng = stream(seed, "gps")
    each = np.array([error_m / np.sqrt(2), error_m / np.sqrt(2), 2 * error_m])
    common = np.sqrt(COMMON) * each * rng.standard_normal(3)
    own = np.sqrt(1.0 - COMMON) * each * rng.standard_normal(positions_m.shape)
    return np.asarray(positions_m + common + own, np.float64)


def degrees_of(street: Street, places_m: NDArray[np.float64]) -> NDArray[np.float64]:
    """(n, 3) latitude, longitude (degrees, WGS 84) and height (m) of places in the world."""
    east, north, up = (places_m + np.array(street.origin_m)).T
    to_degrees = pyproj.Transformer.from_crs(street.crs, "EPSG:4326", always_xy=True)
    longitude, latitude = to_degrees.transform(east, north)
    return np.stack([latitude, longitude, up], axis=1)
