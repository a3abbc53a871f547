"""A city model from a file: CityJSON, CityGML, OBJ, or outlines with heights."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from veduta.formats.building_faces import BuildingFaces, CityFile
from veduta.formats.citygml_read import read_citygml
from veduta.formats.cityjson_read import SEQUENCES, read_cityjson
from veduta.formats.obj_read import ReadMesh, read_obj
from veduta.grammar.city_stream import is_city
from veduta.photos.city.crs import Metres, agreed_crs, metres_of
from veduta.photos.city.model import CityBuilding, CityModel
from veduta.photos.city.outlines import read_outlines
from veduta.photos.city.parts import NoBuildingError, building_of
from veduta.photos.options import ModelOptions
from veduta.run.errors import InputError
from veduta.run.inputs import require_file

Kind = Literal["an OBJ mesh", "CityGML", "CityJSON", "a file of outlines"]
MOST_EXTENT_M = 100_000.0
MOST_NAMED = 3
_OUTLINES = (".geojson", ".json", ".gpkg")
_PACKAGE = b"SQLite format 3"


def read_city_model(path: Path, options: ModelOptions) -> CityModel:
    """The buildings of a file in metres; InputError where it has none that can be used."""
    try:
        require_file(path)
        head = _head(path)
    except OSError as error:
        fault = f"cannot be read ({error.strerror})"
        raise InputError(path, fault, "Check its name and its permissions.") from error
    kind = _kind(path, head)
    _require_effect(path, kind, options)
    match kind:
        case "an OBJ mesh":
            file = _of_mesh(path, options)
        case "CityGML":
            file = read_citygml(path)
        case "CityJSON":
            file = read_cityjson(path)
        case "a file of outlines":
            file = read_outlines(path, options)
    if not file.buildings:
        reason = f" ({file.left[0][0]}: {file.left[0][1]})" if file.left else ""
        raise InputError(path, f"has no building that can be used{reason}", "Give another model.")
    crs = agreed_crs(path, file.epsg, options.crs)
    return _model(path, file, crs)


def _head(path: Path) -> bytes:
    with path.open("rb") as file:
        return file.read(1024).removeprefix(b"\xef\xbb\xbf")


def _kind(path: Path, head: bytes) -> Kind:
    suffix = path.suffix.lower()
    if suffix == ".obj":
        return "an OBJ mesh"
    if suffix in (".gml", ".xml", ".citygml") or head.lstrip().startswith(b"<"):
        return "CityGML"
    if suffix in SEQUENCES or (head.lstrip().startswith(b"{") and is_city(path)):
        return "CityJSON"
    if suffix not in _OUTLINES and not head.lstrip().startswith((b"{", _PACKAGE)):
        remedy = "Give CityJSON, CityGML, OBJ, or outlines as GeoJSON or GeoPackage."
        raise InputError(path, "is no city model that can be read", remedy)
    return "a file of outlines"


def _require_effect(path: Path, kind: Kind, options: ModelOptions) -> None:
    """InputError for an option that is about models of another kind than this."""
    about: tuple[tuple[str, object, Kind], ...] = (
        ("--model-up", None if options.model_up == "auto" else options.model_up, "an OBJ mesh"),
        ("--height-attribute", options.height_attribute, "a file of outlines"),
        ("--layer", options.layer, "a file of outlines"),
    )
    for name, value, wanted in about:
        if value is not None and kind != wanted:
            fault = f"has no effect: it is about {wanted}, and {path} is {kind}"
            raise InputError(name, fault, "Leave it out, or give another --model.")


def _model(path: Path, file: CityFile, crs: str) -> CityModel:
    """All buildings about the lower corner of the model."""
    sample = np.concatenate([rings[0][:1] for one in file.buildings for rings in one.polygons])
    metres = metres_of(path, crs, sample)
    moved = [_moved(one, metres) for one in file.buildings]
    corners = np.concatenate([rings[0] for one in moved for rings in one.polygons])
    low, high = corners.min(axis=0), corners.max(axis=0)
    if float((high - low).max()) > MOST_EXTENT_M:
        raise InputError(
            path,
            f"reaches over {(high - low).max() / 1000:.3g} km, more than"
            f" {MOST_EXTENT_M / 1000:.0f} km",
            "Cut it to the part of the town that the photos show.",
        )
    origin = np.array([np.floor(low[0]), np.floor(low[1]), np.floor(1000 * low[2]) / 1000])
    buildings, left, dropped = _buildings(moved, origin)
    left = [*file.left, *left]
    if not buildings:
        fault = f"has no building that can be used ({left[0][0]}: {left[0][1]})"
        raise InputError(path, fault, "Give another model.")
    x, y, z = origin.tolist()
    notes = [*file.notes, *metres.notes, _lods(file.buildings)]
    if dropped:
        notes.append(f"{dropped} surfaces of the model are no plane polygons: they are left out")
    if left:
        some = "; ".join(f"{name} {reason}" for name, reason in left[:MOST_NAMED])
        notes.append(f"{len(left)} buildings of the model are left out: {some}")
    return CityModel(tuple(buildings), metres.crs, (x, y, z), tuple(notes))


def _moved(one: BuildingFaces, metres: Metres) -> BuildingFaces:
    if metres.way is None:
        return one
    polygons = tuple(tuple(metres.of(ring) for ring in rings) for rings in one.polygons)
    return BuildingFaces(one.id, polygons, one.classes, one.attributes, one.lod, one.solid)


def _buildings(
    files: Sequence[BuildingFaces], origin: NDArray[np.float64]
) -> tuple[list[CityBuilding], list[tuple[str, str]], int]:
    buildings: list[CityBuilding] = []
    left: list[tuple[str, str]] = []
    dropped = 0
    names: set[str] = set()
    for one in files:
        name = _unique(one.id or "building", names)
        polygons = [tuple(ring - origin for ring in rings) for rings in one.polygons]
        try:
            building, lost = building_of(
                name, polygons, one.classes, _finite(one.attributes), solid=one.solid
            )
        except NoBuildingError as error:
            left.append((one.id, str(error)))
            continue
        buildings.append(building)
        dropped += lost
    return buildings, left, dropped


def _finite(attributes: Mapping[str, str | int | float]) -> dict[str, str | int | float]:
    """Without numbers that JSON cannot hold: 1e999 is read as infinity."""
    return {
        name: value
        for name, value in attributes.items()
        if not isinstance(value, float) or math.isfinite(value)
    }


def _unique(name: str, taken: set[str]) -> str:
    """The name, with a number where another building has it; it is then taken."""
    found, number = name, 1
    while found in taken:
        number += 1
        found = f"{name}#{number}"
    taken.add(found)
    return found


def _lods(buildings: Sequence[BuildingFaces]) -> str:
    counts = Counter(one.lod or "not told" for one in buildings)
    told = ", ".join(f"{count} of LoD {lod}" for lod, count in sorted(counts.items()))
    return f"buildings of the model: {told}"


def _of_mesh(path: Path, options: ModelOptions) -> CityFile:
    """Each object or group of an OBJ file as a building."""
    mesh = read_obj(path, path.parent)
    up = options.model_up if options.model_up != "auto" else _up_of(mesh)
    points = mesh.points if up == "z" else mesh.points[:, [0, 2, 1]] * (1.0, -1.0, 1.0)
    given = "as told" if options.model_up != "auto" else "for the model is least high so"
    buildings = []
    for number, group in enumerate(mesh.groups):
        rows = np.flatnonzero(mesh.face_group == number).tolist()
        polygons = tuple(
            (points[mesh.corners[mesh.offsets[row] : mesh.offsets[row + 1]]],) for row in rows
        )
        name = group[:200] or f"object-{number + 1}"
        buildings.append(
            BuildingFaces(name, polygons, (None,) * len(polygons), lod="not told", solid=True)
        )
    note = f"OBJ: {up} is up ({given}), the unit is taken for metres"
    return CityFile(tuple(buildings), None, (note,))


def _up_of(mesh: ReadMesh) -> str:
    """The axis along which the model reaches least: towns are wider than high."""
    size = np.ptp(mesh.points, axis=0)
    return "z" if size[2] <= size[1] else "y"
