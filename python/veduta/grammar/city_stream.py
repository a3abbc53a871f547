"""Building lots from CityJSON that is too large to be read at once, and from CityJSONSeq.

https://www.cityjson.org/specs/2.0.1/ and https://www.cityjson.org/cityjsonseq/ - of a document the
vertices go to a file on the disk, then one city object after the other is looked at; a sequence has
a feature with its own vertices in each line. Roads are looked for before all else.
"""

from __future__ import annotations

import json
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import IO, Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

from veduta.formats.cityjson_read import epsg_of
from veduta.grammar.city_lots import (
    ROADS,
    building_outlines,
    road_corners,
    road_rings,
    vertices_of,
)
from veduta.grammar.json_stream import NO_UTF8, Broken, JsonStream, refuse_constant
from veduta.grammar.outline import Found, Outlines
from veduta.run.errors import InputError

SEQUENCES = (".jsonl", ".ndjson")
"""How names of CityJSONSeq end."""
MAX_LINE = 64 << 20
AT_ONCE = 1 << 18
"""Vertices that are worked on at a time."""
_ANY = 1 << 62
_TELLING = ("CityObjects", "vertices", "transform")


def is_city(path: Path) -> bool:
    """Whether a file of JSON is CityJSON, by the first member that tells."""
    stream = JsonStream(path, "JSON")
    for name in stream.names():
        if name in _TELLING:
            return True
        if name == "features":
            return False
        if name == "type":
            return bool(stream.value() == "CityJSON")
        stream.value()
    return False


def large_city_outlines(path: Path, found: Found, folder: Path | None) -> Outlines:
    """The lots of all buildings of a document; `folder` has room for its vertices."""
    with tempfile.TemporaryFile(dir=folder) as room:
        points, rings, document = _surveyed(path, room)
        found.epsg = epsg_of(document)
        roads = road_corners(points[np.unique(np.concatenate(rings))] if rings else None)
        for name, one in _objects(path):
            subject = f"{path}: {name}"
            if isinstance(one, Broken):
                found.fail(subject, one.fault)
                continue
            yield from building_outlines(subject, name, one, points, roads, found)


def _surveyed(
    path: Path, room: IO[bytes]
) -> tuple[NDArray[np.float64], list[NDArray[np.int64]], dict[str, Any]]:
    """(n, 3) vertices in the file's CRS, those of each road, and the document without them."""
    stream = JsonStream(path, "CityJSON")
    document: dict[str, Any] = {}
    roads: list[NDArray[np.int64]] = []
    count, has_objects = 0, False
    for name in stream.names():
        if name == "vertices":
            count = _keep_vertices(path, stream, room)
        elif name == "CityObjects":
            has_objects = True
            rings = (road_rings(one, _ANY) for _, one in _members(stream))
            roads = [np.unique(np.concatenate(own)) for own in rings if own]
        else:
            document[name] = stream.value()
    if document.get("type") != "CityJSON" or not count:
        raise InputError(path, "has no vertices that can be read", "Check the file.")
    if not has_objects:
        raise InputError(path, "has no CityObjects", "Save it as CityJSON.")
    points: NDArray[np.float64] = np.memmap(room, dtype=np.float64, shape=(count, 3))
    for first in range(0, count, AT_ONCE):
        some = points[first : first + AT_ONCE]
        some[:] = vertices_of(path, document | {"vertices": some})
    return points, [road for road in roads if road[-1] < count], document


def _keep_vertices(path: Path, stream: JsonStream, room: IO[bytes]) -> int:
    """How many there are; they are in the file then, as the document has them."""
    count = 0
    for rows in stream.rows():
        try:
            some = np.array(rows)
        except ValueError:
            some = np.zeros(0)
        if some.ndim != 2 or some.shape[1] != 3 or some.dtype.kind not in "iuf":
            raise InputError(path, "has no vertices that can be read", "Check the file.")
        room.write(some.astype(np.float64).tobytes())
        count += len(some)
    room.flush()
    return count


def _objects(path: Path) -> Iterator[tuple[str, Any]]:
    stream = JsonStream(path, "CityJSON")
    for name in stream.names():
        if name == "CityObjects":
            yield from _members(stream)
            return
        if name == "vertices":
            for _ in stream.rows():
                pass
        else:
            stream.value()


def _members(stream: JsonStream) -> Iterator[tuple[str, Any]]:
    """The city objects by their names; `Broken` for one that is no JSON."""
    for name in stream.names():
        yield name, stream.value_or_broken()


def sequence_outlines(path: Path, found: Found) -> Outlines:
    """The lots of all buildings of a sequence; a line that cannot be read is a failure."""
    first, roads = _header_and_roads(path)
    found.epsg = epsg_of(first)
    for number, feature in _features(path):
        subject = f"{path}: line {number}"
        if isinstance(feature, Broken):
            found.fail(subject, feature.fault)
            continue
        try:
            points = vertices_of(path, first | {"vertices": feature.get("vertices")})
        except InputError as error:
            found.fail(subject, error.fault)
            continue
        for name, one in _own_objects(feature):
            yield from building_outlines(f"{path}: {name}", name, one, points, roads, found)


def _header_and_roads(path: Path) -> tuple[dict[str, Any], KDTree | None]:
    """The first line, and the corners of the roads in all others."""
    header: dict[str, Any] = {}
    corners: list[NDArray[np.float64]] = []
    words = [f'"{kind}"' for kind in ROADS]
    for number, line in _lines(path):
        if number == 1:
            first = _parsed(line)
            if not isinstance(first, dict) or first.get("type") != "CityJSON":
                told = "is no CityJSONSeq: its first line is no CityJSON"
                raise InputError(path, told, "Save it as CityJSONSeq.")
            header = first
        elif any(word in line for word in words):
            feature = _parsed(line)
            if not isinstance(feature, dict):
                continue
            try:
                points = vertices_of(path, header | {"vertices": feature.get("vertices")})
            except InputError:
                continue  # told when its buildings are looked at
            objects = [one for _, one in _own_objects(feature)]
            rings = [ring for one in objects for ring in road_rings(one, len(points))]
            corners += [points[np.unique(np.concatenate(rings))]] if rings else []
    return header, road_corners(np.unique(np.concatenate(corners), axis=0) if corners else None)


def _features(path: Path) -> Iterator[tuple[int, Any]]:
    """The features with the numbers of their lines; `Broken` for what is none."""
    for number, line in _lines(path):
        if number == 1 or not line.strip():
            continue
        feature = _parsed(line)
        if isinstance(feature, Broken) and not line.endswith("\n"):
            raise InputError(path, f"ends within line {number}", "It was cut off: get it anew.")
        if not isinstance(feature, dict | Broken) or (
            isinstance(feature, dict) and feature.get("type") != "CityJSONFeature"
        ):
            feature = Broken("is no CityJSONFeature")
        yield number, feature


def _own_objects(feature: dict[str, Any]) -> list[tuple[str, Any]]:
    objects = feature.get("CityObjects")
    return list(objects.items()) if isinstance(objects, dict) else []


def _parsed(line: str) -> Any:
    """What a line says; `Broken` where it is no JSON."""
    if NO_UTF8.search(line):
        return Broken("it is no UTF-8")
    try:
        return json.loads(line, parse_constant=refuse_constant)
    except RecursionError:
        return Broken("it is nested too deep")
    except ValueError as error:
        return Broken(f"it is no JSON: {error}")


def _lines(path: Path) -> Iterator[tuple[int, str]]:
    """The lines with their numbers, no more than one in memory."""
    try:
        with path.open(encoding="utf-8-sig", errors="surrogateescape", newline="\n") as file:
            number = 0
            while line := file.readline(MAX_LINE):
                number += 1
                if len(line) == MAX_LINE:
                    told = f"has a line of more than {MAX_LINE >> 20} MB (line {number})"
                    raise InputError(path, told, "Give each building a line.")
                yield number, line
    except OSError as error:
        told = f"cannot be read ({error.strerror})"
        raise InputError(path, told, "Check its permissions.") from error
