"""Reading the buildings of CityJSON 1.0 to 2.0, and of CityJSONSeq.

https://www.cityjson.org/specs/2.0.1/ - of each Building and BuildingPart the geometry of the
highest level of detail is taken that has walls or a body (LoD1 and above). Geometry templates are
not read: buildings have none in practice.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, NoReturn

import numpy as np
from numpy.typing import NDArray

from veduta.formats.building_faces import (
    MOST_CORNERS,
    BuildingFaces,
    CityFile,
    FaceLook,
    Rings,
    SurfaceTold,
)
from veduta.formats.cityjson_looks import Appearance
from veduta.place.semantics import CLASS_NAMED, SemanticClass
from veduta.run.errors import InputError
from veduta.run.inputs import require_file

LARGEST_BYTES = 512 * 2**20
SEQUENCES = (".jsonl", ".ndjson", ".cityjsonl")
BUILDINGS = ("Building", "BuildingPart")
SURFACES = {
    "WallSurface": SemanticClass.WALL,
    "InteriorWallSurface": SemanticClass.WALL,
    "RoofSurface": SemanticClass.ROOF,
    "GroundSurface": SemanticClass.GROUND,
    "Window": SemanticClass.WINDOW,
    "Door": SemanticClass.DOOR,
    "OuterFloorSurface": SemanticClass.ROOF,
    "OuterCeilingSurface": SemanticClass.OTHER,
    "ClosureSurface": SemanticClass.OTHER,
}
_SAVE = "Save it anew as CityJSON 2.0."
_DEPTH = {"MultiSurface": 1, "CompositeSurface": 1, "Solid": 2, "MultiSolid": 3}
_DEPTH["CompositeSolid"] = 3


class _Fault(ValueError):
    """A building that cannot be used."""


def read_cityjson(path: Path, *, installations: bool = False) -> CityFile:
    """The buildings; InputError where the file is none that can be used.

    installations: whether balconies, chimneys and their like are taken with their buildings.
    """
    documents = _documents(path)
    head = next(documents, None)
    if not isinstance(head, dict) or head.get("type") != "CityJSON":
        raise InputError(path, "is not CityJSON", _SAVE)
    buildings: list[BuildingFaces] = []
    left: list[tuple[str, str]] = []
    corners = 0
    for document in _with_first(head, documents):
        points = _vertices(path, head, document)
        appearance = Appearance(document.get("appearance"))
        objects = document.get("CityObjects", {})
        if not isinstance(objects, dict):
            raise InputError(path, "has no CityObjects", _SAVE)
        parts = _installations(objects) if installations else {}
        for name, one in objects.items():
            if not isinstance(one, dict) or one.get("type") not in BUILDINGS:
                continue
            if not one.get("geometry") and name not in parts:
                continue
            try:
                building = _building(
                    str(name)[:200], one, (points, appearance), parts.get(name, ()), left
                )
            except _Fault as fault:
                left.append((str(name)[:200], str(fault)))
                continue
            corners += sum(len(ring) for rings in building.polygons for ring in rings)
            if corners > MOST_CORNERS:
                raise InputError(path, f"has more than {MOST_CORNERS:,} corners", "Cut it.")
            buildings.append(building)
    return CityFile(tuple(buildings), epsg_of(head), left=tuple(left))


def _with_first(head: dict[str, Any], rest: Iterator[Any]) -> Iterator[dict[str, Any]]:
    if "vertices" in head:
        yield head
    for document in rest:
        if isinstance(document, dict) and document.get("type") == "CityJSONFeature":
            yield document


def _documents(path: Path) -> Iterator[Any]:
    """The one object of a file, or that of each line of a sequence."""
    try:
        require_file(path, LARGEST_BYTES)
        if path.suffix.lower() not in SEQUENCES:
            yield json.loads(path.read_bytes(), parse_constant=_refuse)
            return
        with path.open(encoding="utf-8") as file:
            for line in file:
                if line.strip():
                    yield json.loads(line, parse_constant=_refuse)
    except OSError as error:
        fault = f"cannot be read ({error.strerror})"
        raise InputError(path, fault, "Check its name and its permissions.") from error
    except RecursionError as error:
        raise InputError(path, "is nested too deep", _SAVE) from error
    except ValueError as error:
        raise InputError(path, f"is not JSON ({error})", _SAVE) from error


def _refuse(word: str) -> NoReturn:
    raise ValueError(f"{word} is no number of JSON")


def epsg_of(head: dict[str, Any]) -> int | None:
    """The code in `metadata.referenceSystem`: a URL, or a URN in version 1.0; None without one."""
    metadata = head.get("metadata")
    name = metadata.get("referenceSystem") if isinstance(metadata, dict) else None
    code = re.search(r"EPSG[:/]+(?:[\d.]*[:/]+)?(\d{4,6})$", str(name)[:200])
    return int(code[1]) if code else None


def _vertices(path: Path, head: dict[str, Any], document: dict[str, Any]) -> NDArray[np.float64]:
    """(n, 3) in the file's CRS."""
    transform = head.get("transform")
    move = transform if isinstance(transform, dict) else {"scale": [1] * 3, "translate": [0] * 3}
    try:
        points = np.array(document["vertices"])
        scale, translate = np.array(move["scale"]), np.array(move["translate"])
        if len(points) == 0:
            points = np.zeros((0, 3))
        sound = points.ndim == 2 and points.shape[1] == 3
        sound &= scale.shape == translate.shape == (3,)
        if not sound or any(part.dtype.kind not in "iuf" for part in (points, scale, translate)):
            raise ValueError("not numbers")
        found: NDArray[np.float64] = points.astype(np.float64) * scale + translate
    except (KeyError, ValueError) as error:
        raise InputError(path, "has no vertices that can be read", _SAVE) from error
    if not np.isfinite(found).all():
        raise InputError(path, "has vertices that are not finite", _SAVE)
    return found


def _installations(objects: dict[str, Any]) -> dict[str, list[tuple[str, dict[str, Any]]]]:
    """Those of each building with their names, by its name."""
    found: dict[str, list[tuple[str, dict[str, Any]]]] = {}
    for name, one in objects.items():
        if isinstance(one, dict) and one.get("type") == "BuildingInstallation":
            parents = one.get("parents")
            if isinstance(parents, list) and parents and one.get("geometry"):
                found.setdefault(str(parents[0]), []).append((str(name)[:200], one))
    return found


def _building(
    name: str,
    one: dict[str, Any],
    read: tuple[NDArray[np.float64], Appearance],
    installations: Sequence[tuple[str, dict[str, Any]]],
    left: list[tuple[str, str]],
) -> BuildingFaces:
    """left: is told which installations cannot be used; the building stands without them."""
    polygons: list[Rings] = []
    looks: list[FaceLook | None] = []
    surfaces: list[SurfaceTold] = []
    surface: list[int] = []
    lod, solid = "", False
    if one.get("geometry") or not installations:
        geometry = _finest(one["geometry"])
        depth = _DEPTH[geometry["type"]]
        lod, solid = str(geometry.get("lod", ""))[:8], depth > 1
        semantics = geometry.get("semantics")
        values = semantics.get("values") if isinstance(semantics, dict) else None
        surfaces = _surfaces(semantics)
        for rings, look, value in _seen(geometry, values, *read):
            polygons.append(rings)
            looks.append(look)
            known = isinstance(value, int) and 0 <= value < len(surfaces)
            surface.append(value if known else -1)
    for own_name, part in installations:
        try:
            found = list(_seen(_finest(part["geometry"]), None, *read))
        except _Fault as fault:
            left.append((own_name, f"an installation of {name} that {fault}"))
            continue
        polygons += [rings for rings, _, _ in found]
        looks += [look for _, look, _ in found]
        surface += [len(surfaces)] * len(found)
        surfaces.append(_told(part.get("attributes"), None))
    if not polygons:
        raise _Fault("has no surfaces")
    classes = [surfaces[row].semantic if row >= 0 else None for row in surface]
    given = one.get("attributes")
    attributes = {
        str(key)[:200]: value
        for key, value in (given.items() if isinstance(given, dict) else ())
        if isinstance(value, str | int | float) and not isinstance(value, bool)
    }
    own = tuple(surfaces), tuple(surface), tuple(looks) if any(looks) else ()
    return BuildingFaces(name, tuple(polygons), tuple(classes), attributes, lod, solid, *own)


def _seen(
    geometry: dict[str, Any], values: Any, points: NDArray[np.float64], appearance: Appearance
) -> Iterator[tuple[Rings, FaceLook | None, Any]]:
    """The faces of a geometry with their looks and semantic values."""
    boundaries, depth = geometry.get("boundaries"), _DEPTH[geometry["type"]]
    materials = appearance.values(geometry, "material")
    textures = appearance.values(geometry, "texture")
    each = zip(
        _faces(boundaries, values, depth),
        _faces(boundaries, materials, depth),
        _faces(boundaries, textures, depth),
        strict=True,
    )
    for (face, value), (_, material), (_, texture) in each:
        rings = _rings(face, points)
        sizes = tuple(len(ring) for ring in rings)
        of_all = materials if isinstance(materials, int) else material
        yield rings, appearance.look(of_all, texture, sizes), value


def _finest(geometries: Any) -> dict[str, Any]:
    """That of the highest level of detail, a body before surfaces; not the outlines of LoD0."""
    usable = [
        geometry
        for geometry in (geometries if isinstance(geometries, list) else [])
        if isinstance(geometry, dict)
        and str(geometry.get("type")) in _DEPTH
        and not str(geometry.get("lod", "1")).startswith("0")
    ]
    if not usable:
        raise _Fault("has no geometry of LoD1 or above")
    return max(usable, key=lambda found: (str(found.get("lod", "1"))[:8], _DEPTH[found["type"]]))


def _surfaces(semantics: Any) -> list[SurfaceTold]:
    surfaces = semantics.get("surfaces") if isinstance(semantics, dict) else None
    return [
        _told(surface, SURFACES.get(str(surface.get("type"))))
        if isinstance(surface, dict)
        else SurfaceTold(None)
        for surface in (surfaces if isinstance(surfaces, list) else [])
    ]


def _told(said: Any, kind: SemanticClass | None) -> SurfaceTold:
    """What a semantic surface or the attributes of an installation say; as Veduta writes them, they
    have a class of their own, the rule and the colour.
    """
    told = said if isinstance(said, dict) else {}
    own = CLASS_NAMED.get(str(told.get("class")))
    colour = re.fullmatch(r"#([0-9a-f]{6})", str(told.get("colour")))
    shares = None
    if colour is not None:
        red, green, blue = bytes.fromhex(colour[1])
        shares = (red / 255, green / 255, blue / 255)
    name = told.get("rule")
    return SurfaceTold(own or kind, name[:200] if isinstance(name, str) else "", shares)


def _faces(boundaries: Any, values: Any, depth: int) -> Iterator[tuple[Any, Any]]:
    """The faces with their semantic values; of a body only the outer shell."""
    if not isinstance(boundaries, list):
        raise _Fault("has no surfaces")
    spread = values if isinstance(values, list) else []
    inner = boundaries[:1] if depth == 2 else boundaries
    for number, part in enumerate(inner):
        value = spread[number] if number < len(spread) else None
        if depth == 1:
            yield part, value
        else:
            yield from _faces(part, value, depth - 1)


def _rings(face: Any, points: NDArray[np.float64]) -> Rings:
    if not isinstance(face, list) or not face:
        raise _Fault("has a surface without rings")
    rings = []
    for ring in face:
        try:
            numbers = np.array(ring)
        except ValueError as error:
            raise _Fault("has a ring that is no list of numbers") from error
        if numbers.ndim != 1 or numbers.dtype.kind != "i" or len(numbers) < 3:
            raise _Fault("has a ring that is no list of three vertices and more")
        if numbers.min() < 0 or numbers.max() >= len(points):
            raise _Fault("names a vertex that is not there")
        rings.append(points[numbers])
    return tuple(rings)
