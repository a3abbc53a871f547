"""A place as the objects of a city model: buildings, their installations, and surfaces.

What CityGML and CityJSON have in common. A part is a building; what closes a shell of its own in
it (a balcony, a chimney) is an installation. A window or a door lies in the wall that it opens.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from veduta.formats.known_values import known
from veduta.formats.rings import Face, faces_of
from veduta.formats.shapes import Look, Shape, shapes
from veduta.place.part import NO_PARENT
from veduta.place.place import Place
from veduta.place.semantics import CITYJSON_SURFACE, OPENINGS, SemanticClass
from veduta.run.errors import InputError

MOST_TRIANGLES = 3_000_000
"""Of a part: city models have an element for each polygon."""
_OF_BUILDINGS = {
    one.code
    for one in (SemanticClass.WALL, SemanticClass.ROOF, SemanticClass.WINDOW, SemanticClass.DOOR)
}
_LEVEL = 0.7
"""A face of an installation that leans at least this much up or down is a floor or a ceiling."""


@dataclass(frozen=True)
class CitySurface:
    """A semantic surface. kind: CityJSON's word. parent: the row of the wall that it opens."""

    kind: str
    id: str
    name: str
    semantic: str
    provenance: str
    faces: tuple[Face, ...]
    parent: int | None = None


@dataclass(frozen=True)
class CityThing:
    """A building, or an installation of one. looks: what the faces' looks are rows of.

    is_building: whether anything in it is a wall, a roof, a window or a door; a tree is not.
    """

    id: str
    name: str
    surfaces: tuple[CitySurface, ...]
    looks: tuple[Look, ...]
    attributes: dict[str, str | int | float] = field(default_factory=dict)
    installations: tuple[CityThing, ...] = ()
    is_building: bool = True


def city_things(place: Place) -> Iterator[CityThing]:
    """The buildings of a place one by one; a backdrop is none."""
    for shape in shapes(place, drawn_only=False):
        if shape.placed.standing.backdrop or len(shape.triangles.corners) == 0:
            continue
        if len(shape.triangles.corners) > MOST_TRIANGLES:
            raise InputError(
                shape.placed.id,
                f"has {len(shape.triangles.corners)} triangles; {MOST_TRIANGLES} are the most that"
                " a city model can have of a building",
                "Write .glb or .obj, or leave it out.",
            )
        yield _building(shape)


def _building(shape: Shape) -> CityThing:
    features = shape.features
    of_shell: dict[int, dict[tuple[int, str], list[Face]]] = {}
    for face in faces_of(shape):
        shell = int(features.shell[face.feature])
        kind = CITYJSON_SURFACE[features.semantic(face.feature)]
        if shell != 0:
            kind = _by_direction(float(face.normal[2]))
        of_shell.setdefault(shell, {}).setdefault((face.feature, kind), []).append(face)
    things = tuple(
        CityThing(
            features.id[next(iter(found))[0]],
            features.name[next(iter(found))[0]],
            _surfaces(shape, found, in_building=False),
            shape.looks,
            {"class": features.semantic(next(iter(found))[0]).value},
        )
        for shell, found in sorted(of_shell.items())
        if shell != 0
    )
    return CityThing(
        shape.placed.id,
        shape.placed.standing.name or shape.placed.id,
        _surfaces(shape, of_shell.get(0, {}), in_building=True),
        shape.looks,
        known(shape.content.attributes),
        things,
        is_building=bool(_OF_BUILDINGS & set(np.unique(features.class_code).tolist())),
    )


def _surfaces(
    shape: Shape, found: dict[tuple[int, str], list[Face]], *, in_building: bool
) -> tuple[CitySurface, ...]:
    features = shape.features
    row_of = {feature: row for row, (feature, _) in enumerate(found)}
    made = []
    for (feature, kind), faces in found.items():
        parent = int(features.parent[feature])
        while parent != NO_PARENT and features.semantic(parent) in OPENINGS:
            parent = int(features.parent[parent])
        opens = in_building and features.semantic(feature) in OPENINGS
        made.append(
            CitySurface(
                kind,
                features.id[feature],
                features.name[feature],
                features.semantic(feature).value,
                features.provenance(feature).value,
                tuple(faces),
                row_of.get(parent) if opens else None,
            )
        )
    return tuple(made)


def _by_direction(normal_z: float) -> str:
    if normal_z > _LEVEL:
        return "OuterFloorSurface"
    return "OuterCeilingSurface" if normal_z < -_LEVEL else "WallSurface"


class XmlIds:
    """Ids as XML has them (NCName), each once in the file."""

    def __init__(self) -> None:
        self._taken: dict[str, int] = {}

    def unique(self, name: str) -> str:
        """The name with what may not be in it replaced."""
        plain = re.sub(r"[^A-Za-z0-9_.-]", "_", name) or "_"
        plain = plain if plain[0].isalpha() or plain[0] == "_" else f"_{plain}"
        count = self._taken[plain] = self._taken.get(plain, 0) + 1
        return plain if count == 1 else self.unique(f"{plain}-{count}")
