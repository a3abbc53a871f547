"""A mesh as levels of detail: what is far off is drawn plainly, what is near comes piece by piece."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from veduta.place.mesh import Mesh
from veduta.surfaces import simplify

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class LevelParameters:
    """leaf_triangles: a piece with fewer is shown as it is; a plainer one has so many at most.

    picture_px: longest side of a plainer piece's texture.
    """

    leaf_triangles: int = 40_000
    picture_px: int = 1024


@dataclass(frozen=True, eq=False)
class Level:
    """A piece of the mesh, and the finer pieces that take its place.

    name: of its file, without a suffix. plain: where it is plainer than the mesh, itself, coloured by
    its vertices; else None. triangles: (m,) those of the mesh that it stands for. error_m: 95 % of the vertices lie nearer.
    box: (2, 3) corners of all that is in it.
    """

    name: str
    plain: Mesh | None
    triangles: NDArray[np.intp]
    error_m: float
    box: Floats
    children: tuple[Level, ...] = ()

    def all(self) -> Iterator[Level]:
        """It and all that are in it."""
        yield self
        for child in self.children:
            yield from child.all()


def levels_of(mesh: Mesh, parameters: LevelParameters | None = None) -> Level:
    """The tree: pieces are cut in four, at the middle of their two longer sides."""
    rule = parameters or LevelParameters()
    points = mesh.positions_m.astype(np.float64)
    joined = _Joined.of(mesh, points)
    centres = points[mesh.triangles].mean(axis=1)
    return _level(mesh, joined, centres, np.arange(len(mesh.triangles)), "0", rule)


@dataclass(frozen=True, eq=False)
class _Joined:
    """The mesh without seams: vertices at one spot are one. triangles: (m, 3) of the whole mesh."""

    points: Floats
    triangles: NDArray[np.int64]
    colours: NDArray[np.uint8]

    @staticmethod
    def of(mesh: Mesh, points: Floats) -> _Joined:
        _, first, place = np.unique(
            mesh.positions_m, axis=0, return_index=True, return_inverse=True
        )
        colours = vertex_colours(mesh)[first]
        return _Joined(points[first], place.reshape(-1)[mesh.triangles], colours)


def vertex_colours(mesh: Mesh) -> NDArray[np.uint8]:
    """(v, 3) the colours of the vertices: their own, or those that the texture has there."""
    if mesh.colours is not None:
        return mesh.colours
    texture = mesh.materials[0].texture
    if texture is None or mesh.uv is None:
        return np.full((len(mesh.positions_m), 3), 200, dtype=np.uint8)
    height, width = texture.pixels.shape[:2]
    column = np.clip((mesh.uv[:, 0] * width).astype(np.intp), 0, width - 1)
    row = np.clip((mesh.uv[:, 1] * height).astype(np.intp), 0, height - 1)
    return np.asarray(texture.pixels[row, column], dtype=np.uint8)


def _level(
    mesh: Mesh,
    joined: _Joined,
    centres: Floats,
    chosen: NDArray[np.intp],
    name: str,
    rule: LevelParameters,
) -> Level:
    corners = mesh.positions_m[mesh.triangles[chosen].reshape(-1)].astype(np.float64)
    box = np.stack([corners.min(axis=0), corners.max(axis=0)])
    if len(chosen) <= rule.leaf_triangles:
        return Level(name, None, chosen, 0.0, box)
    plain, error = _plainer(mesh.id, joined, chosen, rule.leaf_triangles)
    parts = _quarters(centres[chosen], box)
    children = [
        _level(mesh, joined, centres, chosen[part], f"{name}{number}", rule)
        for number, part in enumerate(parts)
        if part.any()
    ]
    # What differs less than its pieces do is no reason to fetch them later.
    error = max(error, *(1.01 * child.error_m for child in children))
    return Level(name, plain, chosen, error, box, tuple(children))


def _quarters(centres: Floats, box: Floats) -> list[NDArray[np.bool_]]:
    axes = np.argsort(box[0] - box[1])[:2]
    above = [centres[:, axis] > np.median(centres[:, axis]) for axis in axes]
    return [(above[0] == one) & (above[1] == other) for one in (False, True) for other in (False, True)]


def _plainer(
    name: str, joined: _Joined, chosen: NDArray[np.intp], most: int
) -> tuple[Mesh, float]:
    used, place = np.unique(joined.triangles[chosen], return_inverse=True)
    points = joined.points[used]
    found = simplify(points, place.reshape(-1, 3), most=most)
    _, nearest = cKDTree(points).query(found.positions)
    colours = joined.colours[used][nearest]
    return Mesh.simple(name, found.positions, found.triangles, colours=colours), found.error_m
