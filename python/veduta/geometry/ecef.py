"""From metres of a projection to the Earth: the frame of a place in earth-centred coordinates.

Earth-centred, earth-fixed (ECEF, EPSG:4978): metres, x to longitude and latitude zero, z to the
north pole. The grid's north is not true north but at the central meridian (meridian convergence),
and its metre not quite a metre (scale): both come out of differences of the projection itself.
Heights are taken for heights above the ellipsoid; where they are above the sea, all stands tens of
metres too low or high, together.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.geometry.utm import EQUATORIAL_RADIUS_M, FLATTENING, utm

_STEP_DEG = 1e-4
_ROUNDS = 8


@dataclass(frozen=True)
class UtmZone:
    """A zone of UTM about WGS 84 (or ETRS89, which is the same to a metre)."""

    number: int
    south: bool


def zone_of_crs(crs: str | None) -> UtmZone | None:
    """The zone of an EPSG code; None for other projections."""
    match = re.fullmatch(r"EPSG:(326|327|258)(\d\d)", crs or "")
    if match is None or not 1 <= int(match[2]) <= 60:
        return None
    if match[1] == "258" and not 28 <= int(match[2]) <= 38:
        return None
    return UtmZone(int(match[2]), match[1] == "327")


def lonlat_of(zone: UtmZone, east_m: float, north_m: float) -> tuple[float, float]:
    """Longitude and latitude (degrees) of a place on the grid, by Newton's method."""
    target = np.array([east_m, north_m])
    guess = np.array([6.0 * zone.number - 183.0, (north_m - 1e7 * zone.south) / 111_000.0])
    for _ in range(_ROUNDS):
        around = guess + _STEP_DEG * np.array([[0, 0], [1, 0], [-1, 0], [0, 1], [0, -1]])
        at = utm(around, zone.number, south=zone.south)
        slope = np.column_stack([at[1] - at[2], at[3] - at[4]]) / (2 * _STEP_DEG)
        guess = guess + np.linalg.solve(slope, target - at[0])
    return float(guess[0]), float(guess[1])


def ecef(lon_deg: float, lat_deg: float, height_m: float) -> NDArray[np.float64]:
    """(3,) metres of a place above the WGS 84 ellipsoid."""
    lon, lat = np.radians(lon_deg), np.radians(lat_deg)
    squared = FLATTENING * (2 - FLATTENING)
    radius = EQUATORIAL_RADIUS_M / np.sqrt(1 - squared * np.sin(lat) ** 2)
    flat = (radius + height_m) * np.cos(lat)
    up = (radius * (1 - squared) + height_m) * np.sin(lat)
    return np.array([flat * np.cos(lon), flat * np.sin(lon), up])


def ecef_from_grid(zone: UtmZone, point_m: tuple[float, float, float]) -> NDArray[np.float64]:
    """(4, 4) ecef_from_local: x along the grid's east, y along its north, z up, about the point.

    A metre of the grid is 1 / k metres on the ground (k is the scale of the projection there),
    which the first two columns are long.
    """
    east, north, height = point_m
    lon, lat = lonlat_of(zone, east, north)
    around = np.array([[lon + _STEP_DEG, lat], [lon - _STEP_DEG, lat]])
    ahead, behind = utm(around, zone.number, south=zone.south)
    convergence = float(np.arctan2(*(ahead - behind)[::-1]))
    ground = ecef(lon + _STEP_DEG, lat, 0.0) - ecef(lon - _STEP_DEG, lat, 0.0)
    scale = float(np.linalg.norm(ahead - behind) / np.linalg.norm(ground))
    lam, phi = np.radians(lon), np.radians(lat)
    to_east = np.array([-np.sin(lam), np.cos(lam), 0.0])
    up = np.array([np.cos(phi) * np.cos(lam), np.cos(phi) * np.sin(lam), np.sin(phi)])
    to_north = np.cross(up, to_east)
    # True east lies at the angle of convergence in the grid, counter-clockwise from its east.
    cos, sin = np.cos(convergence), np.sin(convergence)
    matrix = np.eye(4)
    matrix[:3, 0] = (cos * to_east - sin * to_north) / scale
    matrix[:3, 1] = (sin * to_east + cos * to_north) / scale
    matrix[:3, 2] = up
    matrix[:3, 3] = ecef(lon, lat, height)
    return matrix
