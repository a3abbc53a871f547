"""Reading the buildings of CityGML 2.0 and 3.0, of LoD1 and above.

OGC 12-019 and 20-010; the two differ in namespaces and in the elements between a building and its
surfaces, not in the names that count here. Polygons are taken where they are written out; a solid
that refers to them (xlink) repeats them. The file is read as a stream. A document type is refused:
no model needs one, and entities can grow without bound.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import NoReturn
from xml.parsers import expat

import numpy as np
from numpy.typing import NDArray

from veduta.formats.building_faces import MOST_CORNERS, BuildingFaces, CityFile
from veduta.formats.cityjson_read import SURFACES
from veduta.place.semantics import SemanticClass
from veduta.run.errors import InputError
from veduta.run.inputs import require_file

LARGEST_BYTES = 2 * 2**30
MOST_DEPTH = 200
MOST_TEXT = 16 * 2**20
"""Characters of one list of coordinates."""
LATITUDE_FIRST = {4326, 4258, 4979, 4937}
"""EPSG codes whose axes are latitude and longitude, in this order."""
_AT_ONCE = 1 << 20
_BUILDINGS = ("Building", "BuildingPart")
_LOD = re.compile(r"lod([0-4])[A-Z]")
_INSIDE = ("interiorRoom", "buildingRoom", "interiorBuildingInstallation", "lod0FootPrint")
_TEXTS = ("posList", "pos", "measuredHeight", "value", "storeysAboveGround", "name")
_SAVE = "Save it anew as CityGML 2.0."
# Systems that German surveys name in words of their own (AdV).
_ADV = {"ETRS89_UTM31": 25831, "ETRS89_UTM32": 25832, "ETRS89_UTM33": 25833}
_ADV |= {f"DE_DHDN_3GK{zone}": 31464 + zone for zone in range(2, 6)}


@dataclass
class _Face:
    lod: str
    kind: SemanticClass | None
    solid: bool
    rings: list[NDArray[np.float64]] = field(default_factory=list)


@dataclass
class _Open:
    """A building whose end has not come."""

    id: str
    depth: int
    faces: list[_Face] = field(default_factory=list)
    attributes: dict[str, str | int | float] = field(default_factory=dict)
    has_parts: bool = False


class _Fault(ValueError):
    """The file cannot be used."""


def read_citygml(path: Path) -> CityFile:
    """The buildings; InputError where the file is none that can be used."""
    reader = _Reader()
    try:
        require_file(path, LARGEST_BYTES)
        with path.open("rb") as file:
            for block in iter(lambda: file.read(_AT_ONCE), b""):
                reader.parser.Parse(block, False)
        reader.parser.Parse(b"", True)
    except OSError as error:
        fault = f"cannot be read ({error.strerror})"
        raise InputError(path, fault, "Check its name and its permissions.") from error
    except expat.ExpatError as error:
        raise InputError(path, f"is no XML ({error})", _SAVE) from error
    except _Fault as fault:
        line = reader.parser.CurrentLineNumber
        raise InputError(path, f"line {line}: {fault}", _SAVE) from fault
    except (LookupError, ValueError) as error:  # of expat: encodings that it does not know
        raise InputError(path, f"has an encoding that is not known ({error})", _SAVE) from error
    if not reader.is_city:
        raise InputError(path, "is not CityGML: it has no CityModel", _SAVE)
    buildings = reader.buildings
    if reader.epsg in LATITUDE_FIRST:
        buildings = [_turned(building) for building in buildings]
    return CityFile(tuple(buildings), reader.epsg, tuple(reader.notes), tuple(reader.left))


class _Reader:
    """Follows the elements; knows what it stands in by their local names."""

    def __init__(self) -> None:
        self.parser = expat.ParserCreate(namespace_separator=" ")
        self.parser.buffer_text = True
        self.parser.StartElementHandler = self._start
        self.parser.EndElementHandler = self._end
        self.parser.CharacterDataHandler = self._text
        self.parser.StartDoctypeDeclHandler = _refuse_doctype
        self.is_city = False
        self.epsg: int | None = None
        self.buildings: list[BuildingFaces] = []
        self.left: list[tuple[str, str]] = []
        self.notes: list[str] = []
        self._path: list[str] = []
        self._open: list[_Open] = []
        self._face: _Face | None = None
        self._wanted = False
        self._words: list[str] = []
        self._length = 0
        self._corners = 0
        # Of each open element: srsDimension holds for what is in it (ISO 19136, 10.1.3.2).
        self._spatial = [True]

    def _start(self, tag: str, attributes: dict[str, str]) -> None:
        name = tag.rpartition(" ")[2]
        self._path.append(name)
        if len(self._path) > MOST_DEPTH:
            raise _Fault(f"elements are nested deeper than {MOST_DEPTH}")
        self.is_city |= name == "CityModel"
        if "srsName" in attributes:
            self._system(attributes["srsName"])
        dimension = attributes.get("srsDimension")
        self._spatial.append(self._spatial[-1] if dimension is None else dimension.strip() == "3")
        if name in _BUILDINGS:
            given = next((v for k, v in attributes.items() if k.rpartition(" ")[2] == "id"), "")
            own = given[:200] or f"building-{len(self.buildings) + len(self._open) + 1}"
            self._open.append(_Open(own, len(self._path)))
        elif name == "Polygon" and self._open and not self._is_inside():
            self._face = _Face(self._lod(), self._kind(), self._in_solid())
        elif name in ("LinearRing",) and self._face is not None:
            self._face.rings.append(np.zeros((0, 3)))
        self._wanted = bool(self._open) and name in _TEXTS
        self._words, self._length = [], 0

    def _text(self, text: str) -> None:
        if self._wanted:
            self._length += len(text)
            if self._length > MOST_TEXT:
                raise _Fault(f"a text is longer than {MOST_TEXT:,} characters")
            self._words.append(text)

    def _end(self, tag: str) -> None:
        name = tag.rpartition(" ")[2]
        if self._wanted:
            self._take(name, "".join(self._words).strip())
        self._wanted = False
        if name == "Polygon" and self._face is not None:
            self._open[-1].faces.append(self._face)
            self._face = None
        elif self._open and name in _BUILDINGS and self._open[-1].depth == len(self._path):
            self._close(self._open.pop())
            if self._open:
                self._open[-1].has_parts = True
        self._path.pop()
        self._spatial.pop()

    def _take(self, name: str, text: str) -> None:
        """What an element says that holds text alone."""
        if name in ("posList", "pos") and self._face is not None and self._face.rings:
            self._face.rings[-1] = np.concatenate([self._face.rings[-1], self._numbers(text)])
            return
        building = self._open[-1]
        own = len(self._path) == building.depth + 1
        if name == "name" and own:
            building.attributes.setdefault("name", text[:200])
        elif name in ("measuredHeight", "storeysAboveGround") and own:
            _keep_number(building.attributes, name, text)
        elif name == "value" and "Height" in self._path[building.depth :]:
            _keep_number(building.attributes, "measuredHeight", text)

    def _numbers(self, text: str) -> NDArray[np.float64]:
        try:
            found = np.array(text.split(), dtype=np.float64)
        except ValueError as error:
            raise _Fault("a list of coordinates has a word that is no number") from error
        if not self._spatial[-1] or len(found) % 3:
            raise _Fault("coordinates are not of three dimensions")
        if not np.isfinite(found).all():
            raise _Fault("a coordinate is not finite")
        self._corners += len(found) // 3
        if self._corners > MOST_CORNERS:
            raise _Fault(f"there are more than {MOST_CORNERS:,} corners")
        return found.reshape(-1, 3)

    def _close(self, building: _Open) -> None:
        """The building of the highest level of detail that is written out."""
        lods = {face.lod for face in building.faces} - {"0"}
        if not lods:
            if building.faces or not building.has_parts:
                self.left.append((building.id, "has no geometry of LoD1 or above"))
            return
        best = max(lods)
        faces = [face for face in building.faces if face.lod == best]
        rings = [tuple(_rings(face.rings)) for face in faces]
        if any(not polygon for polygon in rings):
            self.left.append((building.id, "has a surface without three corners"))
            return
        self.buildings.append(
            BuildingFaces(
                building.id,
                tuple(rings),
                tuple(face.kind for face in faces),
                building.attributes,
                best,
                solid=all(face.solid for face in faces),
            )
        )

    def _lod(self) -> str:
        for name in reversed(self._path):
            found = _LOD.match(name)
            if found:
                return found[1]
        return "1"

    def _kind(self) -> SemanticClass | None:
        for name in reversed(self._path[self._open[-1].depth :]):
            if name.removesuffix("Surface") in ("Window", "Door"):
                return SURFACES[name.removesuffix("Surface")]
            if name in SURFACES:
                return SURFACES[name]
        return None

    def _in_solid(self) -> bool:
        return "Solid" in self._path[self._open[-1].depth :]

    def _is_inside(self) -> bool:
        return any(name in _INSIDE for name in self._path[self._open[-1].depth :])

    def _system(self, text: str) -> None:
        code = epsg_of_name(text)
        if code is None:
            note = f"a reference system is not known: {text[:100]!r}"
            if note not in self.notes and len(self.notes) < 5:
                self.notes.append(note)
        elif self.epsg is None:
            self.epsg = code
        elif self.epsg != code:
            raise _Fault(f"the file is in EPSG:{self.epsg} and EPSG:{code} at once")


def epsg_of_name(text: str) -> int | None:
    """The EPSG code of a `srsName`: plain, as URN or URL, the plane one of a compound, or AdV's."""
    codes = re.findall(r"EPSG[:/#]+(?:[\d.]*[:/]+)?(\d{4,6})", text[:300])
    if codes:
        return int(codes[0])
    adv = re.search(r"urn:adv:crs:(\w+?)(?:\*|$)", text[:300])
    return _ADV.get(adv[1]) if adv else None


def _keep_number(attributes: dict[str, str | int | float], name: str, text: str) -> None:
    try:
        number = float(text)
    except ValueError:
        return
    if np.isfinite(number):
        attributes.setdefault(name, number)


def _rings(rings: list[NDArray[np.float64]]) -> Iterator[NDArray[np.float64]]:
    """Rings of three corners and more, without the repeated end."""
    for ring in rings:
        is_closed = len(ring) > 1 and bool((ring[0] == ring[-1]).all())
        open_ring = ring[:-1] if is_closed else ring
        if len(open_ring) >= 3:
            yield open_ring


def _turned(building: BuildingFaces) -> BuildingFaces:
    """Longitude first."""
    return BuildingFaces(
        building.id,
        tuple(tuple(ring[:, [1, 0, 2]] for ring in rings) for rings in building.polygons),
        building.classes,
        building.attributes,
        building.lod,
        building.solid,
    )


def _refuse_doctype(*_: object) -> NoReturn:
    raise _Fault("there is a document type (DOCTYPE), which is refused")
