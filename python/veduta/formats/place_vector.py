"""The outlines of a place for the map, with what is known of each part: GeoJSON and GeoPackage.

GeoJSON (RFC 7946) is in degrees, longitude first; a place that is in no CRS is written in its own
metres with `"crs": null`, as the format's first edition (2008) has it. A GeoPackage (OGC 12-128) is
in the place's own CRS. Heights are attributes.
"""

from __future__ import annotations

import json
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import shapely
from shapely.geometry import MultiPolygon, mapping

from veduta.formats.known_values import plain
from veduta.formats.outlines import Outline, outlines
from veduta.place.place import Place
from veduta.run.atomic import atomic_write, write_bytes
from veduta.run.errors import InputError

LAYER = "outlines"
_DEGREES = "EPSG:4326"
_DIGITS = 8
"""Of a degree: a millimetre."""


def write_geojson(place: Place, path: Path) -> None:
    """Write a FeatureCollection of the parts."""
    features = []
    for one in _placed(place, path):
        polygon = one.polygon
        if place.crs is not None:
            polygon = _in_degrees(polygon, place, path)
        features.append(
            {
                "type": "Feature",
                "id": one.id,
                "properties": one.attributes,
                "geometry": _rounded(mapping(polygon), _DIGITS if place.crs else 4),
            }
        )
    document: dict[str, Any] = {"type": "FeatureCollection"}
    if place.title:
        document["title"] = place.title
    if place.crs is None:
        document["crs"] = None
    document["features"] = features
    text = json.dumps(document, ensure_ascii=False, allow_nan=False)
    write_bytes(path, text.encode("utf-8", "replace"))


def write_gpkg(place: Place, path: Path) -> None:
    """Write a layer of the parts."""
    import pyogrio

    found = list(_placed(place, path))
    if not found:
        raise InputError(path, "the place has no part with an outline", "Choose another place.")
    names = list(dict.fromkeys(name for one in found for name in one.attributes))
    columns = [_column([one.attributes.get(name) for one in found]) for name in names]
    fields = np.array(_fields(names), dtype=object)
    shapes = np.array([shapely.to_wkb(one.polygon) for one in found], dtype=object)
    with atomic_write(path) as temporary:
        temporary.unlink()
        fresh = temporary.with_suffix(".gpkg")
        # The same place gives the same bytes, whenever it is written.
        pyogrio.set_gdal_config_options({"OGR_CURRENT_DATE": "1970-01-01T00:00:00.000Z"})
        try:
            with warnings.catch_warnings():
                # A place in no CRS is known to be in none.
                warnings.filterwarnings("ignore", "'crs' was not provided", UserWarning)
                pyogrio.raw.write(
                    str(fresh),
                    geometry=shapes,
                    field_data=columns,
                    fields=fields,
                    layer=LAYER,
                    driver="GPKG",
                    geometry_type="MultiPolygon",
                    crs=place.crs,
                )
            fresh.replace(temporary)
        except (pyogrio.errors.DataSourceError, pyogrio.errors.FieldError) as error:
            told = " ".join(str(error).split())[:200]
            raise InputError(path, f"cannot be written ({told})", "Write a GeoJSON.") from error
        finally:
            fresh.unlink(missing_ok=True)


def _placed(place: Place, path: Path) -> list[Outline]:
    """The outlines in the place's CRS; of one in none, from its origin."""
    if place.scale == "unknown":
        raise InputError(path, "the place has no known scale", "Give it its scale first.")
    _require_crs(place, path)
    east, north, up = place.origin_m
    made = []
    for one in outlines(place):
        moved = shapely.affinity.translate(one.polygon, east, north)
        ground = one.attributes["ground_m"]
        above = round(ground + up, 2) if isinstance(ground, (int, float)) else None
        told = {name: plain(value) for name, value in one.attributes.items()}
        made.append(Outline(one.id, moved, told | {"ground_m": above}))
    return made


def _in_degrees(polygon: MultiPolygon, place: Place, path: Path) -> MultiPolygon:
    from pyproj import Transformer

    turn = Transformer.from_crs(place.crs, _DEGREES, always_xy=True)

    def degrees(points: Any) -> Any:
        return np.column_stack(turn.transform(points[:, 0], points[:, 1]))

    turned = shapely.transform(polygon, degrees)
    if not np.isfinite(shapely.get_coordinates(turned)).all():
        fault = f"the place lies outside of its coordinate system {place.crs}"
        raise InputError(path, fault, "Give its origin in that system, or the right one.")
    return turned


def _rounded(value: Any, digits: int) -> Any:
    if isinstance(value, float):
        return round(value, digits)
    if isinstance(value, (list, tuple)):
        return [_rounded(one, digits) for one in value]
    if isinstance(value, dict):
        return {name: _rounded(one, digits) for name, one in value.items()}
    return value


def _require_crs(place: Place, path: Path) -> None:
    """InputError where the place's CRS is none that is known."""
    from pyproj import CRS
    from pyproj.exceptions import CRSError

    if place.crs is None:
        return
    try:
        CRS.from_user_input(place.crs)
    except CRSError as error:
        fault = f"the place is in {place.crs[:100]!r}, which is no coordinate reference system"
        raise InputError(path, fault, "Give it as EPSG:code.") from error


def _fields(names: list[str]) -> list[str]:
    """The columns' names, no two alike but for their case: a database knows no case.

    `fid` and `geom` are the format's own. A later name like an earlier one gets `_` at its end.
    """
    taken = {"fid", "geom"}
    found = []
    for name in names:
        free = _clean(name)
        while free.casefold() in taken:
            free += "_"
        taken.add(free.casefold())
        found.append(free)
    return found


def _clean(name: str) -> str:
    """A column's name without control characters, which would end or break it."""
    return "".join(one if one.isprintable() else "?" for one in name) or "_"


def _column(values: list[Any]) -> Any:
    """Numbers as numbers, all else as text; what is not known is null.

    Integers that a column of 64 bits cannot hold are written as text, with all their digits.
    """
    known = [value for value in values if value is not None]
    if any(isinstance(value, int) and not -(2**63) <= value < 2**63 for value in known):
        return np.array([None if value is None else str(value) for value in values], dtype=object)
    if known and all(isinstance(value, int) for value in known) and len(known) == len(values):
        return np.array(values, dtype=np.int64)
    if known and all(isinstance(value, (int, float)) for value in known):
        return np.array([np.nan if value is None else value for value in values], dtype=np.float64)
    return np.array([None if value is None else str(value) for value in values], dtype=object)
