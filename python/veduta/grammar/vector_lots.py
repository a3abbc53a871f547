"""Building lots from the other formats of geodata that GDAL reads: Shapefile (also as ZIP archive),
FlatGeobuf, KML and KMZ, GeoJSON by line, TopoJSON, file geodatabases, MapInfo, GML and CityGML, CSV
with WKT, closed lines of DXF, and OpenStreetMap as XML and PBF.

Features are read in blocks, so that a file may be larger than memory. Of OpenStreetMap only areas
that are buildings become lots, with all of their tags as attributes.
"""

from __future__ import annotations

import difflib
import tempfile
from dataclasses import replace
from pathlib import Path
from typing import Any

import shapely

from veduta.grammar.line_layers import add_roads_beside, roads_of, roads_of_layer
from veduta.grammar.outline import (
    Found,
    Outlines,
    name_of,
    outlines_of,
    plain_attributes,
)
from veduta.grammar.rings import RingFault, closed_ring
from veduta.grammar.vector_read import (
    OSM,
    REMEDY,
    blocks,
    options_of,
    plain,
    required_epsg,
    tags,
    unreadable,
)
from veduta.grammar.wkb import polygons_of_wkb
from veduta.run.errors import InputError
from veduta.run.limits import limited
from veduta.run.names import real_path

SUFFIXES = (
    ".shp", ".zip", ".fgb", ".kml", ".kmz", ".geojsonl", ".geojsons", ".ndjson", ".topojson",
    ".gdb", ".osm", ".pbf", ".tab", ".mif", ".gml", ".citygml", ".xml", ".csv",
    ".dxf",
)  # fmt: skip
FOLDERS = (".gdb",)
"""What is no file, but a folder."""
_GML = ".gml"
_SEVERAL = (".kml", ".kmz", ".gdb", ".zip", ".topojson", _GML)
"""Formats that may have roads in a layer of their own beside that of the lots."""
OSM_LAYER, OSM_LINES = "multipolygons", "lines"
_DRAWN = ".dxf"
_NAMES = ("id", "osm_id", "gml_id", "fid", "name", "Name")
_AREAS = ("Polygon", "MultiPolygon", "Unknown", "GeometryCollection", "CurvePolygon")


def vector_outlines(path: Path, layer: str | None, found: Found) -> Outlines:
    """The polygons of a layer; of the only one where none is named. InputError without any."""
    kind = _kind_of(path)
    if kind == path.suffix.lower() != _GML:
        yield from _of_layers(path, layer, found)
        return
    # GDAL leaves a file beside a GML file that it reads: it sees it in a folder of its own.
    with tempfile.TemporaryDirectory() as folder:
        seen = Path(folder, path.name).with_suffix(kind)
        seen.symlink_to(real_path(path))
        own, given = str(seen), str(path)
        try:
            for outline in _of_layers(seen, layer, found):
                yield replace(outline, subject=outline.subject.replace(own, given, 1))
        except InputError as error:
            subject, fault = (one.replace(own, given) for one in (str(error.subject), error.fault))
            raise InputError(subject, fault, error.remedy) from error


def _kind_of(path: Path) -> str:
    """The ending that says what a file is; of XML its first element says it."""
    suffix = path.suffix.lower()
    if suffix != ".xml":
        return _GML if suffix == ".citygml" else suffix
    with path.open("rb") as file:
        head = file.read(4096)
    kinds = {b"<osm": ".osm", b"<kml": ".kml", b"CityModel": _GML, b"opengis.net/gml": _GML}
    for sign, kind in kinds.items():
        if sign in head:
            return kind
    remedy = "Read are OpenStreetMap, KML, GML and CityGML."
    raise InputError(path, "is XML, but of no kind that is read", remedy)


def _of_layers(path: Path, layer: str | None, found: Found) -> Outlines:
    name, crs = _layer(path, layer)
    found.epsg = None if crs is None or found.is_settled else required_epsg(path, crs)
    suffix = path.suffix.lower()
    is_osm = suffix in OSM
    if is_osm:
        found.roads += roads_of_layer(path, OSM_LINES)
    elif suffix in _SEVERAL:
        add_roads_beside(path, name, crs, found)
    number = 0
    for geometries, columns in blocks(path, name):
        for row, geometry in enumerate(geometries):
            number += 1
            properties = {key: plain(values[row]) for key, values in columns.items()}
            if is_osm:
                properties = tags(properties)
                if properties.get("building", "no") == "no":
                    found.pass_over("area without the tag building")
                    continue
            shape = _drawn(geometry) if suffix == _DRAWN else geometry
            if suffix == _DRAWN and shape is None:
                found.pass_over("open line, point or text")
                continue
            yield from _outlines(f"{path}: {name} {number}", shape, properties, number, found)


def _drawn(geometry: bytes | None) -> bytes | None:
    """The area of a drawing's shape, which knows hatches and closed lines; None of what is none."""
    shape = shapely.from_wkb(geometry, on_invalid="ignore")
    if shape is None or shape.geom_type in ("Polygon", "MultiPolygon"):
        return geometry
    if not isinstance(shape, shapely.LineString) or not shape.is_closed or len(shape.coords) < 4:
        return None
    closed: bytes = shapely.to_wkb(shapely.Polygon(shape))
    return closed


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
            roads = roads_of(shapely.from_wkb(geometry, on_invalid="ignore"), properties)
            found.roads += roads
            if not roads:
                found.pass_over(kind)
            return
        closed = ([closed_ring(ring) for ring in rings] for rings in polygons)
        yield from outlines_of(closed, len(polygons), own, subject, attributes)
    except RingFault as fault:
        found.fail(subject, str(fault))


def _layer(path: Path, wanted: str | None) -> tuple[str, str | None]:
    """The layer's name and its CRS as GDAL has it."""
    return limited(_layer_of, (path, wanted), path, REMEDY)


def _layer_of(asked: tuple[Path, str | None]) -> tuple[str, str | None]:
    """In a process of its own: GDAL reads some formats by code that trusts their files."""
    import pyogrio  # GDAL takes a while to load

    path, wanted = asked
    try:
        listed = [(str(name), str(kind)) for name, kind in pyogrio.list_layers(path)]
        is_table = path.suffix.lower() == ".csv"  # the kind of its geometry stands in no head
        names = [
            name
            for name, kind in listed
            if kind.split(" ")[-1] in _AREAS or "Polygon" in kind or is_table
        ]
        if wanted is None and OSM_LAYER in names and path.suffix.lower() in OSM:
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
        crs = pyogrio.read_info(path, layer=chosen, **options_of(path))["crs"]
    except pyogrio.errors.DataSourceError as error:
        raise unreadable(path, error) from error
    return chosen, None if crs is None else str(crs)
