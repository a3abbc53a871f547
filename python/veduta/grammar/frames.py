"""Where the coordinates of a lots file are on Earth, and the origin that they are told from.

A file says its CRS in the member `crs` (GeoJSON of 2008, which desktop systems still write), or
nothing: then the coordinates are longitude and latitude (RFC 7946) where they can only be that, and
otherwise metres of a frame that nobody knows. Longitude and latitude become metres of the UTM zone
in which most of the lots lie.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from veduta.geometry.utm import MAX_LATITUDE_DEG, MIN_LATITUDE_DEG, epsg_of, utm, zone_of
from veduta.grammar.rings import RingFault
from veduta.run.errors import InputError

GEOGRAPHIC = {4326, 4258, 4269, 4979, 4937}
"""EPSG codes of longitude and latitude about datums that are WGS 84 to a metre or two."""
TINY = 0.01
"""A lot this small is a degree's hundredth wide, or a centimetre: it is no lot in metres."""
MAX_METRES = 1e8
MAX_ZONE_WIDTH_DEG = 9.0


@dataclass(frozen=True)
class Frame:
    """How a file's coordinates become metres about an origin.

    crs: EPSG code of the metres, None where it is not known. zone: (number, south) of UTM where
    the file has longitude and latitude.
    """

    crs: str | None
    origin_m: tuple[float, float, float]
    zone: tuple[int, bool] | None = None
    notes: tuple[str, ...] = ()

    def local(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """(n, 3) of the file as metres from the origin; RingFault where it cannot be."""
        metres = points
        if self.zone is not None:
            metres = np.column_stack([_projected(points, *self.zone), points[:, 2]])
        about: NDArray[np.float64] = metres - np.array(self.origin_m)
        return about


def named_crs(path: Path, document: dict[str, Any]) -> int | None:
    """The EPSG code in the member `crs`; None where there is none."""
    crs = document.get("crs")
    if crs is None:
        return None
    properties = crs.get("properties") if isinstance(crs, dict) else None
    name = properties.get("name") if isinstance(properties, dict) else None
    text = str(name)[:200]
    if re.search(r"CRS:?:?(1\.3:)?84$", text):
        return 4326
    code = re.fullmatch(r"(?:urn:ogc:def:crs:)?EPSG:(?:[\d.]*:)?(\d{4,6})", text)
    if code is None:
        raise InputError(
            path,
            f"has a crs that is not read: {text!r}",
            'Name it as "EPSG:25832", or leave it out.',
        )
    return int(code[1])


def find_frame(path: Path, epsg: int | None, outlines: Sequence[NDArray[np.float64]]) -> Frame:
    """The frame of a file with these outlines, (n, 3) each in the file's coordinates."""
    points = np.concatenate(outlines)
    could_be_degrees = bool(
        (np.abs(points[:, 0]) <= 180.0).all() and (np.abs(points[:, 1]) <= 90.0).all()
    )
    sizes = [float(np.ptp(outline[:, :2], axis=0).max()) for outline in outlines]
    is_tiny = could_be_degrees and float(np.median(sizes)) < TINY
    if epsg in GEOGRAPHIC or (epsg is None and is_tiny):
        if not could_be_degrees:
            raise InputError(
                path,
                f"says EPSG:{epsg}, but its coordinates are no longitudes and latitudes",
                "Name the CRS that they are in.",
            )
        return _utm_frame(path, points)
    if is_tiny:
        raise InputError(
            path,
            f"says EPSG:{epsg}, but its coordinates look like longitudes and latitudes",
            "Name the CRS that they are in.",
        )
    if float(np.abs(points[:, :2]).max()) > MAX_METRES:
        raise InputError(
            path, "has coordinates that are no metres on Earth", "Check its coordinates."
        )
    return Frame(None if epsg is None else f"EPSG:{epsg}", _origin(points))


def _utm_frame(path: Path, points: NDArray[np.float64]) -> Frame:
    if float(np.ptp(points[:, 0])) > MAX_ZONE_WIDTH_DEG:
        raise InputError(path, "spans more than a zone of UTM in longitude", "Cut it into several.")
    middle = np.median(points, axis=0)
    if not MIN_LATITUDE_DEG <= middle[1] <= MAX_LATITUDE_DEG:
        raise InputError(
            path, "lies in the polar regions, where UTM ends", "Project it to metres before."
        )
    zone, south = zone_of(float(middle[0])), bool(middle[1] < 0)
    metres = np.column_stack([utm(points[:, :2], zone, south=south), points[:, 2]])
    code = f"EPSG:{epsg_of(zone, south=south)}"
    note = f"longitude and latitude were projected to metres in {code} (WGS 84 / UTM)"
    return Frame(code, _origin(metres), (zone, south), (note,))


def _projected(points: NDArray[np.float64], zone: int, south: bool) -> NDArray[np.float64]:
    metres = utm(points[:, :2], zone, south=south)
    if not np.isfinite(metres).all():
        raise RingFault("a coordinate cannot be projected")
    return metres


def _origin(metres: NDArray[np.float64]) -> tuple[float, float, float]:
    """The lower corner of all, in whole metres but for the height: the lowest lies on the plane."""
    low = metres.min(axis=0)
    x, y = np.floor(low[:2]).tolist()
    return (x, y, height_origin(float(low[2])))


def height_origin(lowest_m: float) -> float:
    """From where heights count: whole millimetres, as CityJSON has them."""
    return math.floor(1000 * lowest_m) / 1000
