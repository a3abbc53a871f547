"""Where the coordinates of a lots file are on Earth, and the origin that they are told from.

A file says its CRS in the member `crs` (GeoJSON of 2008, which desktop systems still write), or
nothing: then the coordinates are longitude and latitude (RFC 7946) where they can only be that, and
otherwise metres of a frame that nobody knows. Longitude and latitude become metres of the UTM zone
in which most of the lots lie; so do systems that count in feet, or in degrees of other datums.
"""

from __future__ import annotations

import bisect
import itertools
import math
from array import array
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from veduta.geometry.crs import LONGITUDE_LATITUDE, epsg_named, metres_of, moved
from veduta.geometry.utm import MAX_LATITUDE_DEG, MIN_LATITUDE_DEG, epsg_of, utm, zone_of
from veduta.grammar.rings import RingFault
from veduta.run.errors import InputError

GEOGRAPHIC = {4326, 4258, 4269, 4979, 4937}
"""EPSG codes of longitude and latitude about datums that are WGS 84 to a metre or two."""
TINY = 0.01
"""A lot this small is a degree's hundredth wide, or a centimetre: it is no lot in metres."""
MAX_METRES = 1e8
UNIT_TOLERANCE = 1e-9
"""Units that differ less from a metre are metres."""
MAX_ZONE_WIDTH_DEG = 9.0
FOOT_M = 0.3048
TOGETHER = 4096
"""Outlines that are projected at once."""
_ZONES = 61
"""Of six degrees each; the last is that of the longitude 180 alone."""
_BANDS = (MIN_LATITUDE_DEG, 0.0, np.nextafter(MAX_LATITUDE_DEG, 90.0))
"""Latitudes at which it changes what is done with them."""


@dataclass(frozen=True)
class Frame:
    """How a file's coordinates become metres about an origin.

    crs: EPSG code of the metres, None where it is not known. zone: (number, south) of UTM where
    the file has longitude and latitude. source: EPSG code of a file that counts in other units, and
    how many metres one of its heights is.
    """

    crs: str | None
    origin_m: tuple[float, float, float]
    zone: tuple[int, bool] | None = None
    notes: tuple[str, ...] = ()
    source: tuple[int, float] | None = None

    def local(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """(n, 3) of the file as metres from the origin; RingFault where it cannot be."""
        metres = points
        if self.zone is not None:
            metres = np.column_stack([_projected(points, *self.zone), points[:, 2]])
        elif self.source is not None and self.crs is not None:
            code, unit_m = self.source
            flat = moved(points[:, :2], code, int(self.crs.removeprefix("EPSG:")))
            if not np.isfinite(flat).all():
                raise RingFault("a coordinate cannot be projected")
            metres = np.column_stack([flat, points[:, 2] * unit_m])
        about: NDArray[np.float64] = metres - np.array(self.origin_m)
        return about


def named_crs(path: Path, document: dict[str, Any]) -> int | None:
    """The EPSG code in the member `crs`; None where there is none."""
    crs = document.get("crs")
    if crs is None:
        return None
    properties = crs.get("properties") if isinstance(crs, dict) else None
    name, code = None, None
    if isinstance(properties, dict):
        name, code = properties.get("name"), properties.get("code")
    # The form of drafts before GeoJSON 1.0, which exports still have: {"type": "EPSG", "code": ...}
    text = f"EPSG:{code}"[:200] if name is None and code is not None else str(name)[:200]
    found = epsg_named(text)
    if found is None:
        raise InputError(
            path,
            f"has a crs that is not read: {text!r}",
            'Name it as "EPSG:25832", leave it out, or give --crs.',
        )
    return found


def given_crs(text: str) -> int:
    """The EPSG code of `--crs`; InputError where it is none."""
    code = epsg_named(text)
    if code is None:
        raise InputError(f"--crs {text}", "is no CRS with an EPSG code", "Write --crs EPSG:2154.")
    return code


class Survey:
    """What the outlines of a file are together, seen one after the other.

    could_be_degrees: whether all of them lie where longitudes and latitudes do.
    """

    def __init__(self) -> None:
        self.could_be_degrees = True
        self.low: tuple[float, ...] = (math.inf,) * 3
        self.high: tuple[float, ...] = (-math.inf,) * 3
        self._sizes = array("d")
        self._east, self._north = array("d"), array("d")
        self._zones = [_Bin() for _ in range(_ZONES)]
        self._bands = [_Bin() for _ in range(len(_BANDS) + 1)]

    def add(self, outline: NDArray[np.float64]) -> None:
        """Look at (n, 3) corners in the file's coordinates."""
        x, y, z = outline.T.tolist()  # outlines are short: lists are faster than arrays
        low = (min(x), min(y), min(z))
        high = (max(x), max(y), max(z))
        self._sizes.append(max(high[0] - low[0], high[1] - low[1]))
        self._east.append(low[0])
        self._north.append(low[1])
        self.low = tuple(map(min, self.low, low))
        self.high = tuple(map(max, self.high, high))
        self.could_be_degrees &= max(-low[0], high[0]) <= 180.0 and max(-low[1], high[1]) <= 90.0
        if self.could_be_degrees:
            for longitude, latitude in zip(x, y, strict=True):
                self._zones[int((longitude + 180.0) // 6)].add(longitude)
                self._bands[bisect.bisect_right(_BANDS, latitude)].add(latitude)

    @property
    def median_size(self) -> float:
        """Of the longer sides of the boxes around them."""
        return float(np.median(np.frombuffer(self._sizes)))

    @property
    def median_corner(self) -> NDArray[np.float64]:
        """(2,) the medians of the lower corners of the boxes around them, in the file's units."""
        return np.array([np.median(np.frombuffer(one)) for one in (self._east, self._north)])

    @property
    def middle(self) -> tuple[float, float]:
        """A longitude and a latitude in the same zone and band as the medians of all corners."""
        return _middle(self._zones), _middle(self._bands)


@dataclass
class _Bin:
    count: int = 0
    least: float = math.inf
    most: float = -math.inf

    def add(self, value: float) -> None:
        self.count += 1
        self.least, self.most = min(self.least, value), max(self.most, value)


def _middle(bins: Sequence[_Bin]) -> float:
    """A value in the bin of the median: the median itself where it lies between two bins."""
    total, passed = sum(one.count for one in bins), 0
    for number, one in enumerate(bins):
        passed += one.count
        if 2 * passed == total:
            following = next(other for other in bins[number + 1 :] if other.count)
            return (one.most + following.least) / 2
        if 2 * passed > total:
            return one.least
    raise ValueError("no corners were seen")


def find_frame(
    path: Path,
    epsg: int | None,
    survey: Survey,
    outlines: Callable[[], Iterable[NDArray[np.float64]]],
) -> Frame:
    """The frame of a file with these outlines, (n, 3) each in the file's coordinates.

    outlines: all of them once more; asked for where they have to be projected.
    """
    is_tiny = survey.could_be_degrees and survey.median_size < TINY
    if epsg in GEOGRAPHIC or (epsg is None and is_tiny):
        if not survey.could_be_degrees:
            raise InputError(
                path,
                f"says EPSG:{epsg}, but its coordinates are no longitudes and latitudes",
                "Name the CRS that they are in.",
            )
        _require_heights(path, survey)
        return _utm_frame(path, survey, outlines())
    unit_m = 1.0 if epsg is None else metres_of(epsg)
    if epsg is not None and (unit_m is None or abs(unit_m - 1.0) > UNIT_TOLERANCE):
        _require_heights(path, survey)
        return _moved_frame(path, (epsg, unit_m or 1.0), survey, outlines())
    if is_tiny:
        raise InputError(
            path,
            f"says EPSG:{epsg}, but its coordinates look like longitudes and latitudes",
            "Name the CRS that they are in.",
        )
    _require_heights(path, survey)
    if max(map(abs, survey.low[:2] + survey.high[:2])) > MAX_METRES:
        raise InputError(
            path, "has coordinates that are no metres on Earth", "Check its coordinates."
        )
    return Frame(None if epsg is None else f"EPSG:{epsg}", _origin(survey.low))


def _require_heights(path: Path, survey: Survey) -> None:
    if max(abs(survey.low[2]), abs(survey.high[2])) > MAX_METRES:
        fault = "has heights that are no metres on Earth"
        raise InputError(path, fault, "Check its coordinates.")


def _require_one_zone(path: Path, width_deg: float) -> None:
    if width_deg > MAX_ZONE_WIDTH_DEG:
        raise InputError(path, "spans more than a zone of UTM in longitude", "Cut it into several.")


def _utm_frame(path: Path, survey: Survey, outlines: Iterable[NDArray[np.float64]]) -> Frame:
    _require_one_zone(path, survey.high[0] - survey.low[0])
    longitude, latitude = survey.middle
    if not MIN_LATITUDE_DEG <= latitude <= MAX_LATITUDE_DEG:
        raise InputError(
            path, "lies in the polar regions, where UTM ends", "Project it to metres before."
        )
    zone, south = zone_of(longitude), latitude < 0
    low = np.array([math.inf, math.inf, survey.low[2]])
    for group in _grouped(outlines):
        low[:2] = np.minimum(low[:2], utm(group[:, :2], zone, south=south).min(axis=0))
    code = f"EPSG:{epsg_of(zone, south=south)}"
    note = f"longitude and latitude were projected to metres in {code} (WGS 84 / UTM)"
    return Frame(code, _origin(low), (zone, south), (note,))


def _moved_frame(
    path: Path,
    source: tuple[int, float],
    survey: Survey,
    outlines: Iterable[NDArray[np.float64]],
) -> Frame:
    """The zone of UTM in which most lots lie, of a file that counts in feet, or in degrees about
    another datum.
    """
    epsg, unit_m = source
    ends = np.array([survey.low[:2], survey.high[:2]])
    longitude, latitude = moved(survey.median_corner[None], epsg, LONGITUDE_LATITUDE)[0].tolist()
    if not (math.isfinite(longitude) and MIN_LATITUDE_DEG <= latitude <= MAX_LATITUDE_DEG):
        fault = f"says EPSG:{epsg}, but its coordinates lie beyond it"
        raise InputError(path, fault, "Name the CRS that they are in, with --crs.")
    _require_one_zone(path, float(np.ptp(moved(ends, epsg, LONGITUDE_LATITUDE)[:, 0])))
    code = epsg_of(zone_of(longitude), south=latitude < 0)
    low = np.array([math.inf, math.inf, survey.low[2] * unit_m])
    for group in _grouped(outlines):
        low[:2] = np.minimum(low[:2], moved(group[:, :2], epsg, code).min(axis=0))
    if not np.isfinite(low).all():
        fault = f"says EPSG:{epsg}, but its coordinates lie beyond it"
        raise InputError(path, fault, "Name the CRS that they are in, with --crs.")
    note = f"EPSG:{epsg} does not count in metres: lots were moved to EPSG:{code} (WGS 84 / UTM)"
    if abs(unit_m - FOOT_M) < 1e-3:
        note += "; heights without a unit are taken for metres (--map height=NAME[ft]: for feet)"
    return Frame(f"EPSG:{code}", _origin(low), notes=(note,), source=source)


def _grouped(outlines: Iterable[NDArray[np.float64]]) -> Iterator[NDArray[np.float64]]:
    """Some outlines at a time, as the corners of all."""
    every = iter(outlines)
    while group := list(itertools.islice(every, TOGETHER)):
        yield np.concatenate(group)


def _projected(points: NDArray[np.float64], zone: int, south: bool) -> NDArray[np.float64]:
    metres = utm(points[:, :2], zone, south=south)
    if not np.isfinite(metres).all():
        raise RingFault("a coordinate cannot be projected")
    return metres


def _origin(lowest: ArrayLike) -> tuple[float, float, float]:
    """The lower corner of all, in whole metres but for the height: the lowest lies on the plane."""
    east, north, low = np.asarray(lowest, dtype=np.float64).tolist()
    return (float(math.floor(east)), float(math.floor(north)), height_origin(low))


def height_origin(lowest_m: float) -> float:
    """From where heights count: whole millimetres, as CityJSON has them."""
    return math.floor(1000 * lowest_m) / 1000
