"""Solids whose faces say what they are, through all that is added to them and cut from them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Literal

import manifold3d
import numpy as np
from numpy.typing import NDArray
from shapely.geometry.base import BaseGeometry

from veduta import _core
from veduta.plan.house.walls import extruded, middle_of, shell_of

Kind = Literal[
    "wall", "slab", "ground", "floor", "outer floor", "ceiling", "roof", "window", "door", "open"
]
LEAST_EDGE_M = 1e-3
"""Shorter edges than this are collapsed: validators take their ends for one point."""
LEAST_M3 = 1e-3
_NEAR_M = 1e-6


@dataclass(frozen=True)
class Mark:
    """What a face is. name: the feature of the part that it is of; "" for an opening's air."""

    kind: Kind
    name: str = ""


@dataclass(frozen=True)
class Face:
    """A flat face of a solid: (n, 3) rings, counter-clockwise seen from outside, holes clockwise.

    normal: (3,) unit vector to the outside.
    """

    mark: Mark
    rings: tuple[NDArray[np.float64], ...]
    normal: NDArray[np.float64]


MarkOf = Callable[[NDArray[np.float64], NDArray[np.float64]], Mark]
"""The mark of a flat face, by a point on it and its unit normal."""
OPEN = Mark("open")


class Marks:
    """The marks of all solids that were made with it."""

    def __init__(self) -> None:
        self._of: dict[int, list[Mark]] = {}

    def marked(self, solid: manifold3d.Manifold, mark_of: MarkOf) -> manifold3d.Manifold:
        """The same solid with marked faces."""
        shell = shell_of(solid)
        own = int(manifold3d.Manifold.reserve_ids(1))
        self._of[own] = [
            mark_of(*middle_of(shell, plane)) for plane in range(int(shell.plane.max()) + 1)
        ]
        return manifold3d.Manifold(
            manifold3d.Mesh64(
                shell.points_m.copy(),
                shell.faces.astype(np.uint64, order="C"),
                run_index=np.array([0, 3 * len(shell.faces)], dtype=np.uint64),
                run_original_id=np.array([own], dtype=np.uint32),
                face_id=shell.plane.astype(np.uint64),
            )
        )

    def prism(
        self, region: BaseGeometry, low_m: float, high_m: float, low: Mark, high: Mark, side: Mark
    ) -> manifold3d.Manifold:
        """The solid above a region, with the marks of its lower, upper and upright faces."""

        def mark_of(_: NDArray[np.float64], normal: NDArray[np.float64]) -> Mark:
            return side if abs(normal[2]) < 0.5 else high if normal[2] > 0.0 else low

        return self.marked(extruded(region, low_m, high_m), mark_of)

    def faces(self, solid: manifold3d.Manifold) -> list[Face]:
        """The faces of a solid: triangles of one mark in one plane as one."""
        mesh = solid.to_mesh64()
        points = np.asarray(mesh.vert_properties, dtype=np.float64)[:, :3]
        corners = points[np.asarray(mesh.tri_verts, dtype=np.int64)].reshape(-1, 3)
        marks, group = self._groups(mesh)
        count = len(corners) // 3
        places, _, rings, polygons, groups = _core.dissolve_polygons(
            corners,
            np.zeros((len(corners), 2)),
            np.arange(0, 3 * count + 1, 3, dtype=np.int64),
            np.arange(count + 1, dtype=np.int64),
            group,
            np.zeros(count, dtype=np.uint32),
            _NEAR_M,
        )
        found = []
        for number, mark in enumerate(groups.tolist()):
            own = range(int(polygons[number]), int(polygons[number + 1]))
            outlines = tuple(places[rings[ring] : rings[ring + 1]] for ring in own)
            found.append(Face(marks[mark], outlines, _normal(outlines[0])))
        return found

    def _groups(self, mesh: manifold3d.Mesh64) -> tuple[list[Mark], NDArray[np.uint32]]:
        """The marks of a mesh, and the number of that of each triangle."""
        ends = np.asarray(mesh.run_index, dtype=np.int64) // 3
        owner = np.repeat(np.asarray(mesh.run_original_id, dtype=np.int64), np.diff(ends))
        plane = np.asarray(mesh.face_id, dtype=np.int64)
        numbers: dict[Mark, int] = {}
        keys, which = np.unique(np.stack([owner, plane]), axis=1, return_inverse=True)
        group = [
            numbers.setdefault(self._of[own][face], len(numbers)) for own, face in keys.T.tolist()
        ]
        return list(numbers), np.array(group, dtype=np.uint32)[which.reshape(-1)]


def one_mark(mark: Mark) -> MarkOf:
    """The same mark for all faces."""

    def mark_of(_middle: NDArray[np.float64], _normal: NDArray[np.float64]) -> Mark:
        return mark

    return mark_of


def joined(solids: Sequence[manifold3d.Manifold]) -> manifold3d.Manifold:
    """All of them as one."""
    return manifold3d.Manifold.batch_boolean(list(solids), manifold3d.OpType.Add)


def bodies(
    solid: manifold3d.Manifold, least_edge_m: float = LEAST_EDGE_M
) -> list[manifold3d.Manifold]:
    """Each connected piece without the hollows in it, the largest first; crumbs are left out."""
    simple = solid.simplify(least_edge_m)
    pieces = [piece for piece in simple.decompose() if piece.volume() > LEAST_M3]
    return sorted(pieces, key=lambda piece: -piece.volume())


def _normal(ring: NDArray[np.float64]) -> NDArray[np.float64]:
    about = ring - ring[0]
    area = np.cross(about, np.roll(about, -1, axis=0)).sum(axis=0)
    unit: NDArray[np.float64] = area / max(float(np.linalg.norm(area)), 1e-300)
    return unit
