"""Longitude and latitude to metres: the Universal Transverse Mercator projection of WGS 84.

L. Krüger's series in the third flattening n, to the sixth order, as in C. F. F. Karney, "Transverse
Mercator with an accuracy of a few nanometers", J. Geodesy 85 (2011), equations 7 to 12 and 35:
within a zone it is exact to far less than a millimetre. A library (PROJ) would bring many
projections and the data of all; this is the one that is needed.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

EQUATORIAL_RADIUS_M = 6_378_137.0
FLATTENING = 1 / 298.257223563
SCALE = 0.9996
FALSE_EASTING_M = 500_000.0
FALSE_NORTHING_M = 10_000_000.0
"""South of the equator."""
MIN_LATITUDE_DEG, MAX_LATITUDE_DEG = -80.0, 84.0

_n = FLATTENING / (2 - FLATTENING)
_RECTIFYING_RADIUS_M = EQUATORIAL_RADIUS_M / (1 + _n) * (1 + _n**2 / 4 + _n**4 / 64 + _n**6 / 256)
# Rows: the coefficients alpha_1 .. alpha_6, each as a polynomial in n from n**1 on.
_ALPHA = np.array(
    [
        [1 / 2, -2 / 3, 5 / 16, 41 / 180, -127 / 288, 7891 / 37800],
        [0, 13 / 48, -3 / 5, 557 / 1440, 281 / 630, -1983433 / 1935360],
        [0, 0, 61 / 240, -103 / 140, 15061 / 26880, 167603 / 181440],
        [0, 0, 0, 49561 / 161280, -179 / 168, 6601661 / 7257600],
        [0, 0, 0, 0, 34729 / 80640, -3418889 / 1995840],
        [0, 0, 0, 0, 0, 212378941 / 319334400],
    ]
) @ np.array([_n**power for power in range(1, 7)])


def zone_of(longitude_deg: float) -> int:
    """The zone (1 to 60) of six degrees that a longitude lies in."""
    return int((longitude_deg + 180.0) // 6) % 60 + 1


def epsg_of(zone: int, *, south: bool) -> int:
    """The EPSG code of WGS 84 / UTM in a zone."""
    return (32700 if south else 32600) + zone


def utm(lonlat_deg: NDArray[np.float64], zone: int, *, south: bool) -> NDArray[np.float64]:
    """(n, 2) longitude and latitude in degrees to (n, 2) easting and northing in metres."""
    meridian_deg = 6.0 * zone - 183.0
    lam = np.radians(lonlat_deg[:, 0] - meridian_deg)
    eccentricity = np.sqrt(FLATTENING * (2 - FLATTENING))
    sine = np.sin(np.radians(lonlat_deg[:, 1]))
    # Conformal latitude: tau' of equations 7 to 9, as the sine's own form.
    conformal = np.sinh(np.arctanh(sine) - eccentricity * np.arctanh(eccentricity * sine))
    xi = np.arctan2(conformal, np.cos(lam))
    eta = np.arcsinh(np.sin(lam) / np.hypot(conformal, np.cos(lam)))
    order = 2.0 * np.arange(1, 7)[:, None]
    north = xi + _ALPHA @ (np.sin(order * xi) * np.cosh(order * eta))
    east = eta + _ALPHA @ (np.cos(order * xi) * np.sinh(order * eta))
    radius = SCALE * _RECTIFYING_RADIUS_M
    offset = FALSE_NORTHING_M if south else 0.0
    return np.column_stack([FALSE_EASTING_M + radius * east, offset + radius * north])
