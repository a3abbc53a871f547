"""Roads among the lines of geodata that GDAL reads: of a file of roads, and beside lots."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import shapely

from veduta.geometry.crs import epsg_named
from veduta.grammar.outline import Found, Road
from veduta.grammar.roads import road_of
from veduta.grammar.vector_read import OSM, REMEDY, blocks, plain, required_epsg, tags, unreadable
from veduta.run.errors import InputError
from veduta.run.limits import limited

_ROADS = re.compile(
    r"road|street|highway|rout|\brues?\b|voie|voirie|chauss|stra(?:ss|ß)e|weg|calle|camino|carretera|"
    r"strad[ae]|vej|väg|carriageway|道路",
    re.IGNORECASE,
)
"""What layers of roads are called."""
_OTHERS = re.compile(r"rail|water|contour|power|pipe|bord|fence|zaun|boundar", re.IGNORECASE)


def road_lines(path: Path, settled: int | None = None) -> tuple[list[Road], int | None]:
    """The roads of all layers of lines of a file, and the EPSG code of its CRS.

    settled: the code that is taken where its CRS has none.
    """
    layers = limited(line_layers, path, path, REMEDY)
    crs = list(dict.fromkeys(own for _, own in layers))
    if len(crs) > 1:
        told = f"has lines in several CRSs ({', '.join(str(one) for one in crs)})"
        raise InputError(path, told, "Save the roads as one layer, or all in one CRS.")
    roads = [road for name, _ in layers for road in roads_of_layer(path, name)]
    if not roads:
        raise InputError(path, "has no lines that are roads", "Give it lines of roads.")
    if not crs or crs[0] is None:
        return roads, None
    if settled is not None and epsg_named(crs[0]) is None:
        return roads, settled
    remedy = "Save the roads in a CRS that has one, or give --crs where they and the lots share it."
    return roads, required_epsg(path, crs[0], remedy)


def add_roads_beside(path: Path, layer: str, crs: str | None, found: Found) -> None:
    """The roads of the other layers of a file of lots, as far as they are called so.

    layer, crs: of the lots. Layers of lines that are not taken for roads are told, and such as lie
    in another CRS.
    """
    if found.has_roads:
        return
    untaken = []
    for name, own in limited(line_layers, path, path, REMEDY):
        if name == layer:
            continue
        if own != crs or not _ROADS.search(name) or _OTHERS.search(name):
            untaken.append(name)
        else:
            found.roads += roads_of_layer(path, name)
    if untaken:
        told = ", ".join(untaken[:6])
        found.notes.append(
            f"{path}: lines of {told} were not taken for roads: --roads names a file of them"
        )


def line_layers(path: Path) -> list[tuple[str, str | None]]:
    """The layers that may have lines, and the CRS of each."""
    import pyogrio

    try:
        listed = [(str(name), str(kind)) for name, kind in pyogrio.list_layers(path)]
        layers = [
            name for name, kind in listed if "LineString" in kind or "Curve" in kind.split(" ")[-1]
            or kind == "Unknown"
        ]  # fmt: skip
        return [(name, pyogrio.read_info(path, layer=name)["crs"]) for name in layers]
    except pyogrio.errors.DataSourceError as error:
        raise unreadable(path, error) from error


def roads_of_layer(path: Path, layer: str) -> list[Road]:
    """The roads among the lines of a layer; of OpenStreetMap those with the tag `highway`."""
    is_osm = path.suffix.lower() in OSM
    roads: list[Road] = []
    for geometries, columns in blocks(path, layer):
        for row, geometry in enumerate(shapely.from_wkb(geometries, on_invalid="ignore")):
            properties = {key: plain(values[row]) for key, values in columns.items()}
            if is_osm and not (properties := tags(properties)).get("highway"):
                continue
            roads += roads_of(geometry, properties)
    return roads


def roads_of(geometry: Any, properties: dict[str, Any]) -> list[Road]:
    """The roads that the lines of a feature are."""
    return list(_each_road(geometry, properties))


def _each_road(geometry: Any, properties: dict[str, Any]) -> Iterator[Road]:
    for line in () if geometry is None else shapely.get_parts(geometry):
        if line.geom_type == "LineString":
            points = shapely.get_coordinates(line)
            road = road_of(properties, np.asarray(points, dtype=np.float64))
            if road is not None:
                yield road


def crs_of_layer(path: Path, layer: str) -> str | None:
    """The CRS of a layer as GDAL has it, to be compared with those of others."""
    return limited(_crs_of, (path, layer), path, REMEDY)


def _crs_of(asked: tuple[Path, str]) -> str | None:
    import pyogrio

    path, layer = asked
    try:
        crs = pyogrio.read_info(path, layer=layer)["crs"]
    except pyogrio.errors.DataSourceError as error:
        raise unreadable(path, error) from error
    return None if crs is None else str(crs)
