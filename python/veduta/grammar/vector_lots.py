"""Building lots from the other formats of geodata that GDAL reads: Shapefile, FlatGeobuf, KML,
GeoJSON by line, MapInfo, GML, and OpenStreetMap as XML and PBF.

Features are read in blocks, so that a file may be larger than memory. Of OpenStreetMap only areas
that are buildings become lots, with all of their tags as attributes.
"""

from __future__ import annotations

import difflib
import re
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from veduta.geometry.crs import epsg_named
from veduta.grammar.outline import (
    Found,
    Outlines,
    Road,
    name_of,
    outlines_of,
    plain_attributes,
)
from veduta.grammar.rings import RingFault, closed_ring
from veduta.grammar.roads import road_of
from veduta.grammar.wkb import polygons_of_wkb
from veduta.run.errors import InputError
from veduta.run.limits import limited
from veduta.run.names import real_path

SUFFIXES = (
    ".shp", ".fgb", ".kml", ".geojsonl", ".geojsons", ".ndjson", ".osm", ".pbf", ".tab", ".mif",
    ".gml",
)  # fmt: skip
_GML = ".gml"
BLOCK = 20_000
OSM_LAYER, OSM_LINES = "multipolygons", "lines"
_NAMES = ("id", "osm_id", "gml_id", "fid", "name", "Name")
_OSM = (".osm", ".pbf")
_REMEDY = "Check that it is whole, or save it anew as GeoPackage."
_AREAS = ("Polygon", "MultiPolygon", "Unknown", "GeometryCollection", "CurvePolygon")
_TAG = re.compile(r'"((?:[^"\\]|\\.)*)"=>"((?:[^"\\]|\\.)*)"')


def vector_outlines(path: Path, layer: str | None, found: Found) -> Outlines:
    """The polygons of a layer; of the only one where none is named. InputError without any."""
    if path.suffix.lower() == _GML:
        # GDAL leaves a file beside a GML file that it reads: it sees it in a folder of its own.
        with tempfile.TemporaryDirectory() as folder:
            seen = Path(folder, path.name)
            seen.symlink_to(real_path(path))
            for outline in _of_layers(seen, layer, found):
                yield replace(outline, subject=outline.subject.replace(str(seen), str(path), 1))
        return
    yield from _of_layers(path, layer, found)


def _of_layers(path: Path, layer: str | None, found: Found) -> Outlines:
    name, crs = _layer(path, layer)
    found.epsg = None if crs is None else _epsg(path, crs)
    is_osm = path.suffix.lower() in _OSM
    if is_osm:
        found.roads += _roads(path, OSM_LINES)
    number = 0
    for geometries, columns in _blocks(path, name):
        for row, geometry in enumerate(geometries):
            number += 1
            properties = {key: _plain(values[row]) for key, values in columns.items()}
            if is_osm:
                properties = _tags(properties)
                if properties.get("building", "no") == "no":
                    found.pass_over("area without the tag building")
                    continue
            yield from _outlines(f"{path}: {name} {number}", geometry, properties, number, found)


def _outlines(
    subject: str, geometry: bytes | None, properties: dict[str, Any], number: int, found: Found
) -> Outlines:
    attributes = plain_attributes(properties)
    own = name_of(attributes, _NAMES, number)
    if geometry is None:
        found.pass_over("feature without geometry")
        return
    try:
        polygons, kind = polygons_of_wkb(geometry)
        if polygons is None:
            roads = _roads_of(shapely.from_wkb(geometry, on_invalid="ignore"), properties)
            found.roads += roads
            if not roads:
                found.pass_over(kind)
            return
        closed = ([closed_ring(ring) for ring in rings] for rings in polygons)
        yield from outlines_of(closed, len(polygons), own, subject, attributes)
    except RingFault as fault:
        found.fail(subject, str(fault))


def road_lines(path: Path) -> tuple[list[Road], int | None]:
    """The roads of all layers of lines of a file, and the EPSG code of its CRS."""
    layers, crs = limited(_line_layers, path, path, _REMEDY)
    if len(set(crs)) > 1:
        told = f"has lines in several CRSs ({', '.join(str(one) for one in dict.fromkeys(crs))})"
        raise InputError(path, told, "Save the roads as one layer, or all in one CRS.")
    roads = [road for name in layers for road in _roads(path, name)]
    if not roads:
        raise InputError(path, "has no lines that are roads", "Give it lines of roads.")
    return roads, _epsg(path, str(crs[0])) if crs and crs[0] is not None else None


def _line_layers(path: Path) -> tuple[list[str], list[str | None]]:
    """The layers of lines and the CRS of each."""
    import pyogrio

    try:
        listed = [(str(name), str(kind)) for name, kind in pyogrio.list_layers(path)]
        layers = [name for name, kind in listed if "LineString" in kind or kind == "Unknown"]
        return layers, [pyogrio.read_info(path, layer=name)["crs"] for name in layers]
    except pyogrio.errors.DataSourceError as error:
        raise _unreadable(path, error) from error


def _roads(path: Path, layer: str) -> list[Road]:
    """The roads among the lines of a layer; of OpenStreetMap those with the tag `highway`."""
    is_osm = path.suffix.lower() in _OSM
    roads: list[Road] = []
    for geometries, columns in _blocks(path, layer):
        for row, geometry in enumerate(shapely.from_wkb(geometries, on_invalid="ignore")):
            properties = {key: _plain(values[row]) for key, values in columns.items()}
            if is_osm and not (properties := _tags(properties)).get("highway"):
                continue
            roads += _roads_of(geometry, properties)
    return roads


def _roads_of(geometry: Any, properties: dict[str, Any]) -> list[Road]:
    """The roads that the lines of a feature are."""
    lines = () if geometry is None else shapely.get_parts(geometry)
    each = (
        road_of(properties, shapely.get_coordinates(line))
        for line in lines
        if line.geom_type == "LineString"
    )
    return [road for road in each if road is not None]


def _layer(path: Path, wanted: str | None) -> tuple[str, str | None]:
    """The layer's name and its CRS as GDAL has it."""
    return limited(_layer_of, (path, wanted), path, _REMEDY)


def _layer_of(asked: tuple[Path, str | None]) -> tuple[str, str | None]:
    """In a process of its own: GDAL reads some formats by code that trusts their files."""
    import pyogrio  # GDAL takes a while to load

    path, wanted = asked
    try:
        listed = [(str(name), str(kind)) for name, kind in pyogrio.list_layers(path)]
        names = [
            name for name, kind in listed if kind.split(" ")[-1] in _AREAS or "Polygon" in kind
        ]
        if wanted is None and OSM_LAYER in names and path.suffix.lower() in _OSM:
            wanted = OSM_LAYER
        if not names:
            raise InputError(path, "has no layer of polygons", "Give it polygons.")
        if wanted is not None and wanted not in names:
            near = difflib.get_close_matches(wanted, names, n=1)
            hint = f"Did you mean `{near[0]}`?" if near else f"It has: {', '.join(names[:12])}."
            raise InputError(f"--layer {wanted}", f"is no layer of polygons in {path}", hint)
        if wanted is None and len(names) > 1:
            fault = f"has {len(names)} layers of polygons"
            raise InputError(path, fault, f"Name one with --layer: {', '.join(names[:12])}.")
        chosen = names[0] if wanted is None else wanted
        crs = pyogrio.read_info(path, layer=chosen)["crs"]
    except pyogrio.errors.DataSourceError as error:
        raise _unreadable(path, error) from error
    return chosen, None if crs is None else str(crs)


def _blocks(path: Path, layer: str) -> Iterator[tuple[NDArray[Any], dict[str, NDArray[Any]]]]:
    """Geometries (WKB) and columns, so many rows at a time."""
    start = 0
    while True:
        names, geometries, columns = limited(_block, (path, layer, start), path, _REMEDY)
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
            path, layer=layer, skip_features=start, max_features=BLOCK
        )
    except (
        pyogrio.errors.DataSourceError,
        pyogrio.errors.DataLayerError,
        pyogrio.errors.FeatureError,
    ) as error:
        raise _unreadable(path, error) from error
    return [str(name) for name in told["fields"]], geometries, columns


def _unreadable(path: Path, error: Exception) -> InputError:
    told = " ".join(str(error).split())[:200]
    return InputError(path, f"cannot be read ({told})", _REMEDY)


def _epsg(path: Path, crs: str) -> int | None:
    """The code of a CRS; InputError where it has none and is not nearly one that has."""
    code = epsg_named(crs)
    if code is None:
        raise InputError(path, f"has a CRS without EPSG code ({crs[:60]})", "Give --crs.")
    return code


def _plain(value: Any) -> Any:
    """A cell as JSON has values."""
    if isinstance(value, np.generic):
        value = value.item()
    return None if isinstance(value, float) and np.isnan(value) else value


def _tags(properties: dict[str, Any]) -> dict[str, Any]:
    """All tags of an OpenStreetMap feature: GDAL puts the rarer ones into one column."""
    tags = {key: value for key, value in properties.items() if value not in (None, "")}
    rest = str(tags.pop("other_tags", ""))
    for key, value in _TAG.findall(rest):
        tags.setdefault(re.sub(r"\\(.)", r"\1", key), re.sub(r"\\(.)", r"\1", value))
    way = tags.pop("osm_way_id", None)
    tags.setdefault("osm_id", way)
    return tags
