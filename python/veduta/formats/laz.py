"""Points with colours as LAZ 1.4 (ASPRS LAS, compressed), which survey software reads.

LAS stores coordinates as 32-bit integers times a scale plus an offset; both are fitted to the
points. COPC, which lays LAZ out as an octree, is not written: no library that installs from wheels
writes it; `untwine` or PDAL make it of this file.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from datetime import date
from pathlib import Path
from typing import IO, Any

import laspy
import numpy as np
from numpy.typing import NDArray
from pyproj import CRS
from pyproj.exceptions import CRSError

from veduta.run.errors import InputError

POINT_FORMAT = 7
"""Of LAS 1.4: with 16-bit colours, and a CRS as WKT."""
SURVEYED_SCALE_M = 0.001
"""Steps of coordinates in a CRS."""
FREE_STEPS = 1e6
"""Steps over the spread of the middle half of the points, where the unit is not known."""
_LARGEST = 2**31 - 2
_AT_ONCE = 500_000
"""Points that are turned into the format at a time."""
_MADE = date(1970, 1, 1)
"""The format asks for a day; always the same one, so that the same points give the same bytes."""


def write_laz(
    points: NDArray[np.float64],
    colours: NDArray[np.uint8],
    path: Path,
    *,
    crs: str | None = None,
    origin_m: tuple[float, float, float] = (0.0, 0.0, 0.0),
    classes: NDArray[np.uint8] | None = None,
    extra: Mapping[str, NDArray[np.float32]] | None = None,
) -> None:
    """Write (n, 3) points and their (n, 3) sRGB colours.

    classes: (n,) ASPRS's numbers (2 ground, 6 building; from 64 on the user's); None: not known.
    extra: (n,) each: further columns by their names (32 letters at most), as extra bytes.

    crs: what `pyproj` understands (`EPSG:25832`), with metres along the axes; None where the place
    in the world is not known. origin_m: what is added to the points, in that CRS.

    InputError where `crs` is none.
    """
    places = points + np.asarray(origin_m)
    offset = np.floor(np.median(places, axis=0)) if len(places) else np.zeros(3)
    scale = _scale(places, offset, surveyed=crs is not None)
    header = _header(offset, scale, crs)
    columns = extra or {}
    header.add_extra_dims([laspy.ExtraBytesParams(name, np.float32) for name in columns])
    with path.open("wb") as file, _writer(file, header) as writer:
        for first in range(0, len(places), _AT_ONCE):
            some = slice(first, first + _AT_ONCE)
            rows = laspy.ScaleAwarePointRecord.zeros(len(places[some]), header=header)
            _fill(rows, places[some], colours[some], None if classes is None else classes[some])
            for name, values in columns.items():
                rows[name] = values[some]
            writer.write_points(rows)


def write_laz_parts(
    parts: Iterable[tuple[NDArray[np.float64], NDArray[np.uint8], NDArray[np.uint8] | None]],
    path: Path,
    middle: tuple[float, float, float],
    *,
    crs: str | None = None,
    origin_m: tuple[float, float, float] = (0.0, 0.0, 0.0),
) -> int:
    """Write points, colours and classes (as `write_laz` takes them) part after part, of which one
    is in memory at a time; how many points there are.

    middle: a place among the points (m): none lies more than 2000 km from it. InputError where
    `crs` is none.
    """
    header = _header(np.floor(np.asarray(middle) + np.asarray(origin_m)), SURVEYED_SCALE_M, crs)
    count = 0
    with path.open("wb") as file, _writer(file, header) as writer:
        for points, colours, classes in parts:
            rows = laspy.ScaleAwarePointRecord.zeros(len(points), header=header)
            _fill(rows, points + np.asarray(origin_m), colours, classes)
            writer.write_points(rows)
            count += len(points)
    return count


def _writer(file: IO[bytes], header: laspy.LasHeader) -> Any:
    return laspy.open(
        file, mode="w", header=header, do_compress=True, laz_backend=laspy.LazBackend.Lazrs,
        closefd=False,
    )  # fmt: skip


def _header(offset: NDArray[np.float64], scale: float, crs: str | None) -> laspy.LasHeader:
    header = laspy.LasHeader(point_format=POINT_FORMAT, version="1.4")
    header.generating_software = "veduta"
    header.creation_date = _MADE
    header.offsets, header.scales = offset, np.full(3, scale)
    header.global_encoding.wkt = True
    if crs is not None:
        header.add_crs(_crs(crs))
    return header


def _fill(
    cloud: Any,
    places: NDArray[np.float64],
    colours: NDArray[np.uint8],
    classes: NDArray[np.uint8] | None,
) -> None:
    cloud.x, cloud.y, cloud.z = places.T
    # The format asks for the full range of 16 bits.
    cloud.red, cloud.green, cloud.blue = colours.T.astype(np.uint16) * 257
    if classes is not None:
        cloud.classification = classes
    cloud.return_number = np.ones(len(places), dtype=np.uint8)
    cloud.number_of_returns = np.ones(len(places), dtype=np.uint8)


def _scale(places: NDArray[np.float64], offset: NDArray[np.float64], *, surveyed: bool) -> float:
    """A power of ten: fine enough for the points, and such that the furthest fits 32 bits."""
    if not len(places):
        return SURVEYED_SCALE_M
    low, high = np.quantile(places, [0.25, 0.75], axis=0)
    spread, reach = float((high - low).max()), float(np.abs(places - offset).max())
    wanted = SURVEYED_SCALE_M if surveyed or spread == 0.0 else _tens(spread / FREE_STEPS)
    return max(wanted, _tens(reach / _LARGEST))


def _tens(value: float) -> float:
    """The smallest power of ten that is not less."""
    return float(10.0 ** math.ceil(math.log10(value))) if value > 0.0 else 0.0


def _crs(name: str) -> CRS:
    try:
        return CRS.from_user_input(name)
    except CRSError as error:
        raise InputError(
            name, "is not a coordinate reference system", "Give it as EPSG:code."
        ) from error
