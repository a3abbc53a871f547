"""Names of coordinate reference systems, as people and files write them."""

from __future__ import annotations

import functools
import re

import numpy as np
import pyproj
from numpy.typing import NDArray

from veduta.geometry.utm import epsg_of

LONGITUDE_LATITUDE = 4326
"""EPSG code of degrees on WGS 84."""

# A definition without a code is taken for one of the registry when it agrees so well (of 100).
_SURE = 70
# The longest definition that is looked at (letters).
_LONGEST = 20_000
_CODE = re.compile(
    r"(?i)(?:urn:ogc:def:crs:|https?://www\.opengis\.net/(?:def/crs/|gml/srs/))?"
    r"EPSG(?:[:/](?:[\d.]+)?(?=[:/])|\.xml)?\s*[:/#]?\s*(\d{4,6})"
)
_DEGREES = re.compile(r"(?i)WGS[\s_]?84|(?:urn:ogc:def:crs:)?(?:OGC:)?(?:[\d.]*:)?CRS:?84")
_UTM = re.compile(r"(?i)WGS[\s_]?84\s*/?\s*UTM\s*(?:zone\s*)?(\d{1,2})\s?([NS])")


def epsg_named(text: str) -> int | None:
    """The EPSG code that a name or a definition (WKT, PROJ) means; None where it means none.

    Read are `EPSG:25832`, `EPSG: 25832`, `epsg 25832`, the forms of OGC
    (`urn:ogc:def:crs:EPSG::25832` and the addresses that mean the same), `CRS84`, `WGS84`,
    `WGS 84 / UTM 32N`, and whatever PROJ knows to be near to a system of the registry. A code that
    the registry does not have is no CRS.
    """
    text = text.strip()
    if not text or len(text) > _LONGEST:
        return None
    code = _CODE.fullmatch(text)
    if code is not None:
        return _known(int(code[1]))
    if _DEGREES.fullmatch(text):
        return LONGITUDE_LATITUDE
    utm = _UTM.fullmatch(text)
    if utm is not None:
        zone = int(utm[1])
        return epsg_of(zone, south=utm[2].upper() == "S") if 1 <= zone <= 60 else None
    try:
        found = pyproj.CRS.from_user_input(text).to_epsg(min_confidence=_SURE)
    except pyproj.exceptions.ProjError:
        return None
    return None if found is None else int(found)


def _known(code: int) -> int | None:
    try:
        pyproj.CRS.from_epsg(code)
    except pyproj.exceptions.ProjError:
        return None
    return code


def moved(points: NDArray[np.float64], own: int, wanted: int) -> NDArray[np.float64]:
    """(n, 2) x and y, or longitude and latitude, from one CRS to another; infinite beyond it."""
    x, y = _between(own, wanted).transform(points[:, 0], points[:, 1])
    return np.column_stack([x, y]).astype(np.float64)


@functools.lru_cache(maxsize=64)
def _between(own: int, wanted: int) -> pyproj.Transformer:
    return pyproj.Transformer.from_crs(own, wanted, always_xy=True)


def metres_of(code: int) -> float | None:
    """How many metres a unit of a projected system is, such as 0.3048 of feet; None of degrees."""
    system = horizontal(f"EPSG:{code}")
    if not system.is_projected:
        return None
    return float(system.axis_info[0].unit_conversion_factor)


def horizontal(name: str) -> pyproj.CRS:
    """A system without its heights; pyproj's CRSError where there is none of the name."""
    known = pyproj.CRS.from_user_input(name)
    return known.sub_crs_list[0] if known.is_compound else known.to_2d()


def way_between(own: str, wanted: str) -> pyproj.Transformer | None:
    """East and north of one system in another, no ballpark; None where they are one.

    pyproj's ProjError where there is no known way.
    """
    source, target = horizontal(own), horizontal(wanted)
    if source.equals(target, ignore_axis_order=True):
        return None
    return pyproj.Transformer.from_crs(source, target, always_xy=True, allow_ballpark=False)
