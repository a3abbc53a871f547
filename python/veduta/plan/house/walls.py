"""The walls of a storey: one solid less its openings, whose faces know the rooms that they face."""

from __future__ import annotations

from dataclasses import dataclass

import manifold3d
import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from shapely import STRtree
from shapely.geometry import Point
from shapely.geometry.base import BaseGeometry
from shapely.geometry.polygon import orient

from veduta import _core
from veduta.place.semantics import Provenance, SemanticClass
from veduta.plan.document import Room
from veduta.plan.house.frame import Sculptor, Surface, level
from veduta.plan.house.hole import Hole
from veduta.plan.house.looks import wall_look
from veduta.plan.house.space import Space, pieces_of

_BEYOND_M = 0.01
"""How far cutters reach beyond what they cut."""
_IN_PLANE = 1.0 - 1e-9
_STEP_M = 0.02
_NEAR_M = 1e-6


@dataclass(frozen=True)
class Shell:
    """Triangles of a closed solid. points_m: (v, 3). faces: (m, 3). plane: (m,) which triangles lie
    in one plane and hang together.
    """

    points_m: NDArray[np.float64]
    faces: NDArray[np.int64]
    plane: NDArray[np.int64]

    @property
    def normals(self) -> NDArray[np.float64]:
        """(m, 3) area vectors, twice as long as the area."""
        corners = self.points_m[self.faces]
        crossed: NDArray[np.float64] = np.cross(
            corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
        )
        return crossed


def extruded(region: BaseGeometry, low_m: float, high_m: float) -> manifold3d.Manifold:
    """The solid above a region, from one height to another."""
    rings = []
    for piece in pieces_of(region):
        shape = orient(piece)
        rings += [np.array(ring.coords)[:-1] for ring in (shape.exterior, *shape.interiors)]
    section = manifold3d.CrossSection(rings, manifold3d.FillRule.Positive)
    return section.extrude(high_m - low_m).translate([0.0, 0.0, low_m])


def wall_solid(space: Space, height_m: float) -> manifold3d.Manifold:
    """The walls of a storey with their openings cut; the floor is at 0."""
    solid = extruded(space.walls, 0.0, height_m)
    cutters = [
        extruded(hole.outline, -_BEYOND_M if hole.reaches_floor else hole.low_m, hole.high_m)
        for hole in space.holes
    ]
    if cutters:
        solid = solid - manifold3d.Manifold.batch_boolean(cutters, manifold3d.OpType.Add)
    return solid


def shell_of(solid: manifold3d.Manifold) -> Shell:
    """The triangles of a solid, those of one flat face together."""
    mesh = solid.to_mesh64()
    points = np.asarray(mesh.vert_properties, dtype=np.float64)[:, :3]
    faces = np.asarray(mesh.tri_verts, dtype=np.int64)
    shell = Shell(points, faces, np.zeros(len(faces), dtype=np.int64))
    return Shell(points, faces, _planes(shell))


def add_walls(space: Space, height_m: float, sculptor: Sculptor) -> None:
    """The walls as surfaces: one for each wall and the room that it faces, and for each reveal."""
    if space.walls.is_empty:
        return
    shell = shell_of(wall_solid(space, height_m))
    surfaces, names = _Surfaces(sculptor), WallNames(space)
    by_plane = [
        surfaces.of(*names.of(*middle_of(shell, plane))) for plane in range(shell.plane.max() + 1)
    ]
    frame = level(space.storey.elevation_m)
    for plane, rings in flat_faces(shell):
        sculptor.face(rings, frame, by_plane[plane])


class _Surfaces:
    """The features of walls, each made when it is first met."""

    def __init__(self, sculptor: Sculptor) -> None:
        self._sculptor = sculptor
        self._features: dict[str, int] = {}
        self._shell = sculptor.builder.new_shell()

    def of(self, name: str, look: str) -> Surface:
        """The surface of this name."""
        if name not in self._features:
            self._features[name] = self._sculptor.builder.feature(
                SemanticClass.WALL, Provenance.INFERRED, name, shell=self._shell
            )
        return Surface(self._features[name], look)


class WallNames:
    """What the faces of a storey's walls are called, by where they lie (m, above its floor)."""

    def __init__(self, space: Space) -> None:
        self._space = space
        self._outlines = STRtree([hole.outline.buffer(_NEAR_M) for hole in space.holes])

    def of(self, middle: NDArray[np.float64], normal: NDArray[np.float64]) -> tuple[str, str]:
        """The name of a face's feature and its look, by a point on it and its unit normal."""
        storey = self._space.storey.name
        hole = self._hole_at(middle)
        if hole is not None:
            look = "inner wall" if hole.left and hole.right else "facade"
            return f"{storey} reveal {hole.opening.id}", look
        if abs(normal[2]) > 0.5:
            return f"{storey} wall edges", "wall core"
        room = self._room_at(middle[:2] + _STEP_M * normal[:2])
        wall = self._wall_at(middle[:2])
        side = "outside" if room is None else f"in {room.id}"
        return f"{storey} wall {wall} {side}", wall_look(room)

    def _hole_at(self, middle: NDArray[np.float64]) -> Hole | None:
        at = Point(middle[:2])
        for row in sorted(self._outlines.query(at, predicate="covered_by").tolist()):
            hole: Hole = self._space.holes[row]
            upright = hole.low_m - _NEAR_M <= middle[2] <= hole.high_m + _NEAR_M
            if upright and _is_inside(hole, at):
                return hole
        return None

    def _room_at(self, point: NDArray[np.float64]) -> Room | None:
        """The room, or the nearest within a step: outlines may be a little off the walls."""
        found = self._space.room_at(point)
        if found is not None:
            return found
        at = Point(point)
        if not self._space.built.covers(at):
            return None
        near = [(shape.distance(at), room) for room, shape in self._space.rooms]
        return min(near, key=lambda one: one[0], default=(0.0, None))[1]

    def _wall_at(self, point: NDArray[np.float64]) -> str:
        at = Point(point)
        lines = self._space.lines
        return min(lines, key=lambda name: abs(lines[name].line.distance(at) - lines[name].half_m))


def _is_inside(hole: Hole, at: Point) -> bool:
    """Whether a point of the opening's outline is not on the wall's own faces."""
    return bool(hole.line.line.distance(at) < hole.line.half_m - _NEAR_M)


def _planes(shell: Shell) -> NDArray[np.int64]:
    """(m,) numbers of flat faces: triangles that share an edge and a normal."""
    normals = shell.normals
    length = np.linalg.norm(normals, axis=1)
    unit = normals / np.maximum(length, 1e-300)[:, None]
    edges = np.sort(shell.faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    order = np.lexsort((edges[:, 1], edges[:, 0]))
    first, second = order[0::2] // 3, order[1::2] // 3  # closed: each edge is there twice
    same = (unit[first] * unit[second]).sum(axis=1) > _IN_PLANE
    count = len(shell.faces)
    links = coo_array((np.ones(same.sum()), (first[same], second[same])), shape=(count, count))
    return connected_components(links, directed=False)[1].astype(np.int64)


def middle_of(shell: Shell, plane: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The middle of the largest triangle of a flat face, and its unit normal."""
    chosen = np.flatnonzero(shell.plane == plane)
    normals = shell.normals[chosen]
    length = np.linalg.norm(normals, axis=1)
    largest = int(length.argmax())
    corners = shell.points_m[shell.faces[chosen[largest]]]
    return corners.mean(axis=0), normals[largest] / max(float(length[largest]), 1e-300)


def flat_faces(shell: Shell) -> list[tuple[int, list[NDArray[np.float64]]]]:
    """Each flat face's number and the rings of its polygons."""
    corners = shell.points_m[shell.faces].reshape(-1, 3)
    count = len(shell.faces)
    places, _, rings, polygons, groups = _core.dissolve_polygons(
        corners,
        np.zeros((len(corners), 2)),
        np.arange(0, 3 * count + 1, 3, dtype=np.int64),
        np.arange(count + 1, dtype=np.int64),
        shell.plane.astype(np.uint32),
        np.zeros(count, dtype=np.uint32),
        _NEAR_M,
    )
    return [
        (
            int(group),
            [
                places[rings[ring] : rings[ring + 1]]
                for ring in range(polygons[number], polygons[number + 1])
            ],
        )
        for number, group in enumerate(groups.tolist())
    ]
