"""Rows of the geodata that GDAL reads, in a process of their own, and what their CRS is."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from veduta.geometry.crs import epsg_named
from veduta.run.errors import InputError
from veduta.run.limits import limited

BLOCK = 20_000
OSM = (".osm", ".pbf")
REMEDY = "Check that it is whole, or save it anew as GeoPackage."
_TAG = re.compile(r'"((?:[^"\\]|\\.)*)"=>"((?:[^"\\]|\\.)*)"')
_TABLE = {
    "AUTODETECT_TYPE": "YES",
    "GEOM_POSSIBLE_NAMES": "WKT,wkt,geom,GEOM,geometry,GEOMETRY,the_geom,wkt_geom,shape",
    "KEEP_GEOM_COLUMNS": "NO",
}
"""How a table as text is read: geometry in one column, as WKT."""


def options_of(path: Path) -> dict[str, str]:
    """What GDAL is told of a file of this kind."""
    return _TABLE if path.suffix.lower() == ".csv" else {}


def blocks(path: Path, layer: str) -> Iterator[tuple[NDArray[Any], dict[str, NDArray[Any]]]]:
    """Geometries (WKB) and columns, so many rows at a time."""
    start = 0
    while True:
        names, geometries, columns = limited(_block, (path, layer, start), path, REMEDY)
        yield geometries, dict(zip(names, columns, strict=True))
        start += len(geometries)
        if len(geometries) < BLOCK:
            return


def _block(
    asked: tuple[Path, str, int],
) -> tuple[list[str], NDArray[Any], Sequence[NDArray[Any]]]:
    """Names of columns, geometries and columns of the rows from one on."""
    import pyogrio

    path, layer, start = asked
    try:
        told, _, geometries, columns = pyogrio.raw.read(
            path, layer=layer, skip_features=start, max_features=BLOCK, **options_of(path)
        )
    except (
        pyogrio.errors.DataSourceError,
        pyogrio.errors.DataLayerError,
        pyogrio.errors.FeatureError,
    ) as error:
        raise unreadable(path, error) from error
    if geometries is None:  # a table without places
        geometries = np.full(len(columns[0]) if len(columns) else 0, None, dtype=object)
    return [str(name) for name in told["fields"]], geometries, columns


def unreadable(path: Path, error: Exception) -> InputError:
    """The error for a file that GDAL cannot read."""
    told = " ".join(str(error).partition("; It might help")[0].split())[:200]
    return InputError(path, f"cannot be read ({told})", REMEDY)


def required_epsg(path: Path, crs: str, remedy: str = "Give --crs.") -> int:
    """The code of a CRS; InputError where it has none and is not nearly one that has."""
    code = epsg_named(crs)
    if code is None:
        raise InputError(path, f"has a CRS without EPSG code ({crs[:60]})", remedy)
    return code


def plain(value: Any) -> Any:
    """A cell as JSON has values."""
    if isinstance(value, np.datetime64):
        return None if np.isnat(value) else str(value)
    if isinstance(value, np.generic):
        value = value.item()
    return None if isinstance(value, float) and np.isnan(value) else value


def tags(properties: dict[str, Any]) -> dict[str, Any]:
    """All tags of an OpenStreetMap feature: GDAL puts the rarer ones into one column."""
    found = {key: value for key, value in properties.items() if value not in (None, "")}
    rest = str(found.pop("other_tags", ""))
    for key, value in _TAG.findall(rest):
        found.setdefault(re.sub(r"\\(.)", r"\1", key), re.sub(r"\\(.)", r"\1", value))
    way = found.pop("osm_way_id", None)
    found.setdefault("osm_id", way)
    return found
