"""Whether the places of control points can be what their file says: degrees, or metres."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pyproj
from numpy.typing import NDArray

from veduta.run.errors import InputError


def require_plausible(path: Path, crs: str, places: Mapping[str, NDArray[np.float64]]) -> None:
    """InputError for degrees that cannot be any, and for metres that look like degrees."""
    try:
        known = pyproj.CRS.from_user_input(crs)
    except pyproj.exceptions.ProjError as error:
        remedy = "Write another CRS into the first line, such as EPSG:32632."
        raise InputError(path, f"names {crs}, which is not known", remedy) from error
    if known.is_geographic:
        _require_degrees(path, crs, places)
    elif known.is_projected:
        _require_metres(path, crs, known, places)


def _require_degrees(path: Path, crs: str, places: Mapping[str, NDArray[np.float64]]) -> None:
    for name, (x, y, _) in places.items():
        if abs(x) > 180.0 or abs(y) > 90.0:
            fault = f"has the point {name} at {x:g} {y:g}, and {crs} is in degrees"
            hint = ""
            if abs(y) <= 180.0 and abs(x) <= 90.0:
                hint = ": latitude seems to come first"
            remedy = "Write longitude, latitude and height, or the CRS of the metres."
            raise InputError(path, fault + hint, remedy)


def _require_metres(
    path: Path, crs: str, known: pyproj.CRS, places: Mapping[str, NDArray[np.float64]]
) -> None:
    """InputError where all places are numbers as degrees are, outside of where the CRS is used."""
    flat = np.array([place[:2] for place in places.values()])
    if (np.abs(flat).max(axis=1) > 180.0).any() or _is_used_at(known, flat):
        return
    name, (x, y, _) = next(iter(places.items()))
    fault = f"has the point {name} at {x:g} {y:g}, which looks like degrees, and {crs} is in metres"
    remedy = "Write WGS84 into the first line for longitude and latitude, or the points in metres."
    raise InputError(path, fault, remedy)


def _is_used_at(known: pyproj.CRS, flat: NDArray[np.float64]) -> bool:
    """Whether the middle of places lies about where a projected CRS is used."""
    area = known.area_of_use
    if area is None:
        return True
    to_world = pyproj.Transformer.from_crs(known, "EPSG:4326", always_xy=True)
    east, north = np.median(flat, axis=0).tolist()
    longitude, latitude = to_world.transform(east, north)
    return bool(area.west <= longitude <= area.east and area.south <= latitude <= area.north)
