"""Bringing the coordinates of a city model to metres of a projected CRS."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pyproj
from numpy.typing import NDArray

from veduta.geometry.crs import epsg_named, horizontal
from veduta.geometry.ecef import grid_of_crs
from veduta.geometry.utm import epsg_of, zone_of
from veduta.run.errors import InputError

_WORLD = "EPSG:4326"
MOST_STRETCH = 0.02
"""By how much a metre of a CRS may differ from one on the ground; at the rims of zones it does by
less than half a per cent."""


@dataclass(frozen=True)
class Metres:
    """How coordinates become metres of `crs`. way: None where they are that already."""

    crs: str
    way: pyproj.Transformer | None
    notes: tuple[str, ...]

    def of(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """(n, 3) in metres; heights stay as they are."""
        if self.way is None or len(points) == 0:
            return points
        east, north = self.way.transform(points[:, 0], points[:, 1])
        return np.column_stack([east, north, points[:, 2]])


def agreed_crs(path: Path, named: int | None, given: str | None) -> str:
    """The CRS that the file names or the caller gives; InputError where none or two of them do."""
    own = None if named is None else f"EPSG:{named}"
    if given is not None:
        code = epsg_named(given)
        if code is None:
            raise InputError(f"--crs {given}", "is no EPSG code", "Write it as EPSG:25832.")
        given = f"EPSG:{code}"
    if own is not None and given is not None and own != given:
        raise InputError(
            path,
            f"says that it is in {own}, and --crs says {given}",
            "Leave --crs out, or correct the file.",
        )
    found = own or given
    if found is None:
        raise InputError(
            path,
            "does not say in which coordinate reference system it is",
            "Add --crs with its EPSG code, such as --crs EPSG:25832.",
        )
    return found


def metres_of(subject: str | Path, crs: str, sample: NDArray[np.float64]) -> Metres:
    """The way of `crs` to metres; (n, 3) `sample` says where on Earth it is used.

    A projected CRS in metres stays; others (degrees, feet, maps of the web whose metres are none)
    become UTM of the middle of the sample.
    """
    if grid_of_crs(crs) is not None and not _stretches(crs, sample):
        return Metres(crs, None, ())
    try:
        if pyproj.CRS.from_user_input(crs).is_geocentric:
            raise _unusable(subject, crs)
        known = horizontal(crs)
        to_world = pyproj.Transformer.from_crs(known, _WORLD, always_xy=True, allow_ballpark=False)
    except pyproj.exceptions.ProjError as error:
        raise _unusable(subject, crs) from error
    middle = np.median(sample[:, :2], axis=0)
    longitude, latitude = to_world.transform(*middle.tolist())
    if not (np.isfinite([longitude, latitude]).all() and abs(latitude) < 80.0):
        raise _unusable(subject, crs)
    target = f"EPSG:{epsg_of(zone_of(longitude), south=latitude < 0)}"
    try:
        way = pyproj.Transformer.from_crs(known, target, always_xy=True, allow_ballpark=False)
    except pyproj.exceptions.ProjError as error:
        raise _unusable(subject, crs) from error
    note = f"coordinates were converted from {crs} to metres in {target} (WGS 84 / UTM)"
    return Metres(target, way, (note,))


def _stretches(crs: str, sample: NDArray[np.float64]) -> bool:
    """Whether a metre of the CRS is far from one on the ground: at 52 degrees a metre of the web's
    Mercator is 0.6 m.
    """
    plane = pyproj.Proj(horizontal(crs))
    east, north = np.median(sample[:, :2], axis=0).tolist()
    longitude, latitude = plane(east, north, inverse=True)
    if not np.isfinite([longitude, latitude]).all():
        return False
    scale = float(plane.get_factors(longitude, latitude).meridional_scale)
    return bool(np.isfinite(scale)) and abs(scale - 1.0) > MOST_STRETCH


def between(source: str, target: str) -> pyproj.Transformer:
    """East and north of one CRS in another; InputError where there is no known way."""
    try:
        found = pyproj.Transformer.from_crs(source, target, always_xy=True, allow_ballpark=False)
    except pyproj.exceptions.ProjError as error:
        raise InputError(
            source, f"cannot be converted to {target}", "Convert it before."
        ) from error
    return found


def _unusable(subject: str | Path, crs: str) -> InputError:
    return InputError(
        subject,
        f"is in {crs}, whose coordinates there are not known how to make metres",
        "Convert it to a projected system in metres before.",
    )
