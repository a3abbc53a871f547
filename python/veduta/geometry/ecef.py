"""From metres of a projection to the Earth: the frame of a place in earth-centred coordinates.

Earth-centred, earth-fixed (ECEF, EPSG:4978): metres, x to longitude and latitude zero, z to the
north pole. The grid's north is not true north but at the central meridian (meridian convergence),
and its metre not quite a metre (scale): both come out of differences of the projection itself.
Heights are taken for heights above the ellipsoid; where they are above the sea, all stands tens of
metres too low or high, together.

The projections and the shifts between national datums are those of the EPSG registry, by PROJ with
the data that it brings along: no grids of corrections, and nothing is fetched. Without its grid a
national datum is known to a metre or some (`Grid.accuracy_m`).
"""

from __future__ import annotations

import re
import warnings
from dataclasses import dataclass

import numpy as np
import pyproj
from numpy.typing import NDArray
from pyproj import network

EQUATORIAL_RADIUS_M = 6_378_137.0
FLATTENING = 1 / 298.257223563
_STEP_M = 10.0
_WORLD = "EPSG:4326"
_MIRRORED = ["south", "west"]
"""Axes to the right and up of grids on which a map lies mirrored, such as Krovak's first one."""

network.set_network_enabled(active=False)  # type: ignore[attr-defined]  # it is public


@dataclass(frozen=True)
class Grid:
    """A projected CRS in metres.

    name: that of the registry. accuracy_m: of longitude and latitude (WGS 84); None where the
    registry does not say it.
    """

    name: str
    accuracy_m: float | None
    to_lonlat: pyproj.Transformer


def grid_of_crs(crs: str | None) -> Grid | None:
    """The grid of a code such as `EPSG:28992`, or the plane one of a compound CRS.

    None for other kinds of CRS, for feet, for axes to the south and the west (a map of them is
    mirrored), and where no way to WGS 84 is known.
    """
    if re.fullmatch(r"EPSG:\d{4,6}", crs or "") is None:
        return None
    try:
        known = pyproj.CRS.from_user_input(crs)
        if known.is_compound:
            known = known.sub_crs_list[0]
        units = {axis.unit_name for axis in known.axis_info}
        if not known.is_projected or units != {"metre"}:
            return None
        if [axis.direction for axis in known.axis_info[:2]] == _MIRRORED:
            return None
        way = pyproj.Transformer.from_crs(known, _WORLD, always_xy=True, allow_ballpark=False)
    except pyproj.exceptions.ProjError:
        return None
    accuracy = _accuracy(known)
    return Grid(known.name, accuracy, way)


def _accuracy(known: pyproj.CRS) -> float | None:
    """Of the best way to WGS 84 for which all is there."""
    with warnings.catch_warnings():
        # It warns that a grid would be better.
        warnings.simplefilter("ignore", UserWarning)
        ways = pyproj.transformer.TransformerGroup(
            known, _WORLD, always_xy=True, allow_ballpark=False
        ).transformers
    told = [way.accuracy for way in ways[:1] if way.accuracy >= 0]
    return told[0] if told else None


def lonlat_of(grid: Grid, points_m: NDArray[np.float64]) -> NDArray[np.float64]:
    """(n, 2) longitude and latitude (degrees, WGS 84) of (n, 2) places on the grid.

    ValueError where a place is none of the projection.
    """
    found = np.column_stack(grid.to_lonlat.transform(points_m[:, 0], points_m[:, 1]))
    if not np.isfinite(found).all():
        raise ValueError(f"{grid.name} has no place at {points_m[0].tolist()}")
    return found


def ecef(lonlat_deg: NDArray[np.float64], height_m: float) -> NDArray[np.float64]:
    """(n, 3) metres of (n, 2) places above the WGS 84 ellipsoid."""
    lon, lat = np.radians(lonlat_deg[:, 0]), np.radians(lonlat_deg[:, 1])
    squared = FLATTENING * (2 - FLATTENING)
    radius = EQUATORIAL_RADIUS_M / np.sqrt(1 - squared * np.sin(lat) ** 2)
    flat = (radius + height_m) * np.cos(lat)
    up = (radius * (1 - squared) + height_m) * np.sin(lat)
    return np.column_stack([flat * np.cos(lon), flat * np.sin(lon), up])


def ecef_from_grid(grid: Grid, point_m: tuple[float, float, float]) -> NDArray[np.float64]:
    """(4, 4) ecef_from_local: x along the grid's east, y along its north, z up, about the point.

    A metre of the grid is 1 / k metres on the ground (k is the scale of the projection there),
    which the first two columns are long.
    """
    east, north, height = point_m
    steps = _STEP_M * np.array([[0, 0], [1, 0], [-1, 0], [0, 1], [0, -1]])
    around = lonlat_of(grid, np.array([east, north]) + steps)
    ground = ecef(around, 0.0)
    lam, phi = np.radians(around[0])
    matrix = np.eye(4)
    matrix[:3, 0] = (ground[1] - ground[2]) / (2 * _STEP_M)
    matrix[:3, 1] = (ground[3] - ground[4]) / (2 * _STEP_M)
    matrix[:3, 2] = [np.cos(phi) * np.cos(lam), np.cos(phi) * np.sin(lam), np.sin(phi)]
    matrix[:3, 3] = ecef(around[:1], height)[0]
    return matrix
