"""CityJSON's words for the faces of a house, seen from outside and from its rooms.

CityJSON 2.0, section 3.3: semantic surfaces of Building and BuildingRoom. Normals point out of the
solid: out of the house, and out of the air of a room, into its walls.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Any

import numpy as np

from veduta.formats.cityjson import surface_entry
from veduta.formats.cityjson_solids import CityFace
from veduta.place.part import Part
from veduta.plan.city.marked import Face
from veduta.plan.house.space import Space

LEVEL = 0.5
"""A normal that leans at least so much up or down is that of a floor or a ceiling."""
_SLANTED = 0.05
_NEAR_M = 0.01
_WALLS = {"WallSurface", "InteriorWallSurface"}
SurfaceKey = tuple[str, str]
"""CityJSON's word, and the name of the feature."""


def outer_kind(face: Face) -> str:
    """A face of the house's shell."""
    kind, up = face.mark.kind, float(face.normal[2])
    if kind in {"window", "door"}:
        return kind.capitalize()
    if kind == "wall":
        return "WallSurface"
    if kind == "roof" and up > _SLANTED:
        return "RoofSurface"
    if kind in {"open", "floor", "ceiling"}:
        return "ClosureSurface"
    if abs(up) < LEVEL:
        return "WallSurface"
    if up > 0.0:
        outdoors = kind == "outer floor" or face.mark.name == "ground slab"
        return "OuterFloorSurface" if outdoors else "RoofSurface"
    return "GroundSurface" if kind == "ground" else "OuterCeilingSurface"


def inner_kind(face: Face) -> str:
    """A face of a room's air."""
    kind, out = face.mark.kind, float(face.normal[2])
    if kind in {"window", "door"}:
        return kind.capitalize()
    if kind == "open":
        return "ClosureSurface"
    if kind in {"floor", "ceiling"}:
        return "FloorSurface" if kind == "floor" else "CeilingSurface"
    if kind == "wall" or abs(out) < LEVEL:
        return "InteriorWallSurface"
    return "FloorSurface" if out < 0.0 else "CeilingSurface"


def installed_kind(face: Face) -> str:
    """A face of stairs and rails: by where it looks."""
    up = float(face.normal[2])
    if abs(up) < LEVEL:
        return "InteriorWallSurface"
    return "FloorSurface" if up > 0.0 else "CeilingSurface"


class SurfaceTable:
    """What the surfaces of a part are called and come from, by the names of its features."""

    def __init__(self, part: Part, spaces: Sequence[Space]) -> None:
        self._part = part
        self._row = {name: row for row, name in enumerate(part.features.name)}
        self._hole_of = {
            f"{space.storey.name} {hole.opening.kind} {hole.opening.id}": (space, hole)
            for space in spaces
            for hole in space.holes
        }

    def faces(self, faces: Iterable[Face], kind_of: Callable[[Face], str]) -> list[CityFace]:
        """Faces for a document, keyed by surface."""
        return [CityFace(face.rings, (kind_of(face), face.mark.name)) for face in faces]

    def surfaces(self, shells: Sequence[Sequence[CityFace]]) -> dict[Any, dict[str, Any]]:
        """What is said of each surface; windows and doors name the wall that they open."""
        faces = [face for shell in shells for face in shell]
        keys: dict[Any, None] = dict.fromkeys(face.surface for face in faces)
        walls = [face for face in faces if face.surface[0] in _WALLS]
        return {key: self._entry(key, walls) for key in keys}

    def _entry(self, key: SurfaceKey, walls: Sequence[CityFace]) -> dict[str, Any]:
        kind, name = key
        if name not in self._row:
            return {"type": kind}
        found = surface_entry(self._part, self._row[name], kind)
        if name in self._hole_of:
            parent = next((p for p in map(self._opened(name), walls) if p is not None), None)
            if parent is not None:
                found["parent"] = parent
        return found

    def _opened(self, name: str) -> Callable[[CityFace], SurfaceKey | None]:
        """Tells of a face whether an opening is cut into it: its surface, or None."""
        space, hole = self._hole_of[name]
        up = space.storey.elevation_m + (hole.low_m + hole.high_m) / 2.0
        sides = [
            np.array([*(hole.middle + side * hole.line.half_m * hole.leftward), up])
            for side in (1.0, -1.0)
        ]
        across = np.array([*hole.leftward, 0.0])

        def surface_of(face: CityFace) -> SurfaceKey | None:
            ring = face.rings[0]
            low, high = ring.min(axis=0) - _NEAR_M, ring.max(axis=0) + _NEAR_M
            for at in sides:
                flat = np.abs((ring - at) @ across).max() < _NEAR_M
                if flat and (low <= at).all() and (at <= high).all():
                    own: SurfaceKey = face.surface
                    return own
            return None

        return surface_of
