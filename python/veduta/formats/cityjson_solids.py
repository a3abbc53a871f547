"""CityJSON 2.0 of objects with solids of their own, and of things that stand in many places.

https://www.cityjson.org/specs/2.0.1/ - sections 3.1 (Solid, MultiSolid), 3.3 (semantics), 3.4
(geometry templates). Vertices are integers of a millimetre, shared by all that touch. Corners that
fall together on that grid are one; what is not closed then is written as a MultiSurface. Axes: z
up, metres.
"""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from veduta import _core
from veduta.formats import cityjson_frame as frame
from veduta.formats.cityjson_frame import Vertex

GRID_M = 1e-3
PLANE_M = 0.01
"""Vertices may lie so far off the plane of their face, as validators have it."""
LOD = "3"
"""The finest that CityJSON 2.0 has: interiors are in it, too (LoD4 is gone since CityGML 3)."""

Rings = Sequence[NDArray[np.float64]]
"""(n, 3) corners, the outline counter-clockwise seen from outside, holes clockwise."""


@dataclass(frozen=True)
class CityFace:
    """A face: its rings, and a (hashable) key of the surface that it is a piece of."""

    rings: Rings
    surface: Any


class CityDocument:
    """A CityJSON object as it grows."""

    def __init__(
        self, title: str, origin_m: NDArray[np.float64], *, lod: str = LOD, crs: str | None = None
    ) -> None:
        """origin_m: (3,) where vertices count from, such as the lower corner of all.

        crs: such as "EPSG:25832".
        """
        self._title, self._lod, self._crs = title, lod, crs
        self._origin = np.floor(origin_m)
        self._vertices = frame.Vertices()
        self._template_vertices: dict[tuple[float, float, float], int] = {}
        self._templates: list[dict[str, Any]] = []
        self.objects: dict[str, dict[str, Any]] = {}

    def add(
        self,
        name: str,
        kind: str,
        parent: str | None = None,
        attributes: Mapping[str, Any] | None = None,
        geometry: Sequence[dict[str, Any]] = (),
    ) -> str:
        """An object below another one; returns its name."""
        if name in self.objects:
            raise ValueError(f"there are two objects {name!r}")
        made: dict[str, Any] = {"type": kind}
        if attributes:
            made["attributes"] = dict(attributes)
        if parent is not None:
            made["parents"] = [parent]
            self.objects[parent].setdefault("children", []).append(name)
        if geometry:
            made["geometry"] = list(geometry)
        self.objects[name] = made
        return name

    def solid(
        self,
        shells: Sequence[Sequence[CityFace]],
        surfaces: Mapping[Any, Mapping[str, Any]],
    ) -> dict[str, Any]:
        """A Solid of one shell, a MultiSolid of several, a MultiSurface of what is not closed.

        surfaces: what each surface is, by the keys of the faces; "parent" may name another key.
        """
        rows: dict[Hashable, int] = {}
        closed = True
        boundaries: list[Any] = []
        values: list[Any] = []
        for shell in shells:
            own: list[list[list[Vertex]]] = []
            of: list[int] = []
            for face in shell:
                rings = _gridded(face.rings, self._origin)
                if rings:
                    own.append(rings)
                    of.append(rows.setdefault(face.surface, len(rows)))
            closed = closed and is_sound(own)
            boundaries.append([[self._vertices.numbers(ring) for ring in face] for face in own])
            values.append(of)
        told = _linked([dict(surfaces[key]) for key in rows], rows)
        if not closed:
            shape: dict[str, Any] = {
                "type": "MultiSurface",
                "boundaries": [face for shell in boundaries for face in shell],
            }
            numbers: list[Any] = [value for shell in values for value in shell]
        elif len(boundaries) == 1:
            shape, numbers = {"type": "Solid", "boundaries": boundaries}, values
        else:
            shape = {"type": "MultiSolid", "boundaries": [[shell] for shell in boundaries]}
            numbers = [[shell] for shell in values]
        return shape | {"lod": self._lod, "semantics": {"surfaces": told, "values": numbers}}

    def template(self, faces: Sequence[Rings]) -> int:
        """The number of a shape in a frame of its own."""
        known = self._template_vertices
        boundaries = []
        for rings in faces:
            numbered = [
                [
                    known.setdefault((x, y, z), len(known))
                    for x, y, z in (np.round(ring / GRID_M) * GRID_M).round(3).tolist()
                ]
                for ring in rings
            ]
            kept = _cleaned(numbered)
            if kept:
                boundaries.append(kept)
        self._templates.append({"type": "MultiSurface", "lod": LOD, "boundaries": boundaries})
        return len(self._templates) - 1

    def instance(
        self, template: int, at_m: NDArray[np.float64], turn: NDArray[np.float64]
    ) -> dict[str, Any]:
        """A shape at a place. turn: (3, 3), from its frame to that of the document."""
        matrix = np.eye(4)
        matrix[:3, :3] = turn
        return {
            "type": "GeometryInstance",
            "template": template,
            "boundaries": [self._vertex(at_m)],
            "transformationMatrix": (matrix.round(6) + 0.0).reshape(-1).tolist(),
        }

    def content(self, low_m: Sequence[float], high_m: Sequence[float]) -> bytes:
        """The file; low_m, high_m: the corners of the box around everything."""
        whole = frame.document(
            GRID_M,
            self._origin.tolist(),
            title=self._title,
            extent_m=[*low_m, *high_m],
            crs=self._crs,
            objects=self.objects,
            vertices=self._vertices.told(),
        )
        if self._templates:
            whole["geometry-templates"] = {
                "templates": self._templates,
                "vertices-templates": [list(vertex) for vertex in self._template_vertices],
            }
        return frame.encoded(whole)

    def _vertex(self, at_m: NDArray[np.float64]) -> int:
        steps = frame.steps_of(np.asarray(at_m).reshape(1, 3), self._origin, GRID_M)
        return self._vertices.numbers(steps.tolist())[0]


def closes(faces: Sequence[Rings]) -> bool:
    """Whether faces close a solid on the grid of the file: see `is_sound`."""
    kept = [_gridded(rings, np.zeros(3)) for rings in faces]
    return is_sound([rings for rings in kept if rings])


def is_sound(shell: Sequence[Sequence[Sequence[Vertex]]]) -> bool:
    """Whether each face is a flat polygon, and each of their edges is passed once each way."""
    if not frame.closes_volume(shell):
        return False
    rings = [ring for face in shell for ring in face]
    sound = _core.sound_polygons(
        np.concatenate([np.array(ring, dtype=np.float64) for ring in rings]) * GRID_M,
        np.cumsum([0, *(len(ring) for ring in rings)]).astype(np.int64),
        np.cumsum([0, *(len(face) for face in shell)]).astype(np.int64),
        PLANE_M,
    )
    return bool(sound.all())


def _gridded(rings: Rings, origin_m: NDArray[np.float64]) -> list[list[Vertex]]:
    """The rings of a face in steps of the grid; none where it is too thin for it."""
    steps = [frame.steps_of(ring, origin_m, GRID_M).tolist() for ring in rings]
    return _cleaned([[(x, y, z) for x, y, z in ring] for ring in steps])


def _cleaned(rings: Sequence[list[Any]]) -> list[list[Any]]:
    """Rings without repeated corners and spikes; none where the outline is gone."""
    kept = [_without_spikes(ring) for ring in rings]
    if not kept or len(kept[0]) < 3:
        return []
    return [kept[0], *(ring for ring in kept[1:] if len(ring) >= 3)]


def _without_spikes(ring: list[Any]) -> list[Any]:
    left: list[Any] = []
    for corner in ring:
        left.append(corner)
        while len(left) >= 2 and left[-1] == left[-2]:
            left.pop()
        while len(left) >= 3 and left[-1] == left[-3]:
            del left[-2:]
    changed = True
    while changed and len(left) >= 3:
        changed = False
        if left[0] == left[-1]:
            left.pop()
            changed = True
        elif left[-1] == left[1]:
            del left[0], left[-1]
            changed = True
        elif left[0] == left[-2]:
            del left[-2:]
            changed = True
    return left


def _linked(surfaces: list[dict[str, Any]], rows: Mapping[Hashable, int]) -> list[dict[str, Any]]:
    """Keys of parents as numbers, with the children of each."""
    for number, surface in enumerate(surfaces):
        parent = rows.get(surface.pop("parent", None))
        if parent is not None and parent != number:
            frame.link(surfaces, number, parent)
    return surfaces
