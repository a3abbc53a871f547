"""Building lots from GeoJSON: the polygons of its features, each with the properties of its own."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

from veduta.grammar.json_stream import Broken
from veduta.grammar.outline import Attribute, Found, Outlines, outlines_of, plain_attributes
from veduta.grammar.rings import RingFault, numbers_of
from veduta.grammar.roads import lines_of, road_of
from veduta.run.errors import InputError

_MAX_ID = 200


def features_of(path: Path, document: dict[str, Any]) -> Iterator[Any]:
    """The features of a collection; a lone feature or polygon counts as one."""
    kind = document.get("type")
    if kind == "FeatureCollection":
        features = document.get("features")
        if not isinstance(features, list):
            raise InputError(path, "has no list of features", "Save it as GeoJSON.")
        yield from features
    elif kind == "Feature":
        yield document
    elif kind in ("Polygon", "MultiPolygon"):
        yield {"type": "Feature", "geometry": document, "properties": {}}
    else:
        raise InputError(
            path,
            f"is not GeoJSON of polygons: its type is {str(kind)[:40]!r}",
            "Give a FeatureCollection of polygons, CityJSON, GeoPackage or OBJ.",
        )


def feature_outlines(path: Path, features: Iterable[Any], found: Found) -> Outlines:
    """The polygons of all features; the faults of bad ones, and what is none, go to `found`."""
    for number, feature in enumerate(features, 1):
        subject = f"{path}: feature {number}"
        try:
            polygons, kind = _polygons(feature)
            if polygons is None:
                if not _add_roads(feature, found):
                    found.pass_over(kind)
                continue
            attributes = plain_attributes(feature.get("properties"))
            name = _name(feature, attributes, number)
            rings = ([numbers_of(ring) for ring in polygon] for polygon in polygons)
            yield from outlines_of(rings, len(polygons), name, subject, attributes)
        except RingFault as fault:
            found.fail(subject, str(fault))


def _add_roads(feature: dict[str, Any], found: Found) -> bool:
    """Whether a feature that is no polygon is a road; it is then one of those found."""
    geometry = feature.get("geometry")
    if not isinstance(geometry, dict):
        return False
    each = (road_of(feature.get("properties"), line) for line in lines_of(geometry))
    roads = [road for road in each if road is not None]
    found.roads += roads
    return bool(roads)


def _polygons(feature: Any) -> tuple[list[list[Any]] | None, str]:
    """The polygons of a feature, each a list of rings; None and the kind of something else."""
    if isinstance(feature, Broken):
        raise RingFault(feature.fault)
    if not isinstance(feature, dict):
        raise RingFault("is no object")
    geometry = feature.get("geometry")
    if geometry is None:
        return None, "feature without geometry"
    if not isinstance(geometry, dict):
        raise RingFault("its geometry is no object")
    kind, coordinates = geometry.get("type"), geometry.get("coordinates")
    if kind not in ("Polygon", "MultiPolygon"):
        return None, str(kind)[:40]
    polygons = [coordinates] if kind == "Polygon" else coordinates
    if not isinstance(polygons, list) or not polygons:
        raise RingFault("has no coordinates")
    for polygon in polygons:
        if not isinstance(polygon, list) or not polygon:
            raise RingFault("has a polygon without rings")
    return polygons, str(kind)


def _name(feature: dict[str, Any], attributes: dict[str, Attribute], number: int) -> str:
    """What the file calls the feature, or its number."""
    for value in (feature.get("id"), attributes.get("id"), attributes.get("name")):
        if isinstance(value, float) and value.is_integer():
            value = int(value)
        if isinstance(value, str | int) and not isinstance(value, bool) and str(value).strip():
            text = str(value).strip()
            is_plain = text.isprintable()
            return (text if is_plain else "".join(filter(str.isprintable, text)))[:_MAX_ID]
    return f"lot-{number}"
