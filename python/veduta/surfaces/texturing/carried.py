"""The texture of a mesh on a plainer surface of the same thing."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from veduta.place.mesh import Mesh
from veduta.surfaces.normals import vertex_normals
from veduta.surfaces.texturing.islands import Islands, islands_of

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class CarryParameters:
    """beside: vertices of the mesh around a plainer one whose places in the texture it goes by.
    at_once: corners at a time, so that it takes little memory. calm: weight of no slope at all,
    against 1 for the spread of these vertices. beyond_px: so far beyond what an island of the
    texture has, at most.
    """

    beside: int = 10
    at_once: int = 20_000
    calm: float = 1e-3
    beyond_px: float = 3.0


def carry_texture(
    mesh: Mesh,
    positions_m: NDArray[np.floating],
    triangles: NDArray[np.integer],
    parameters: CarryParameters | None = None,
) -> Mesh:
    """A plainer surface, (v, 3) and (m, 3), with the texture of the mesh.

    Each plainer triangle is shown by that island of the texture whose surface is nearest to its
    middle; where its corners lie in it, the island's nearest vertices say, by the even map that
    fits them best. Vertices are doubled where islands meet. ValueError where the mesh has no
    texture.
    """
    rule = parameters or CarryParameters()
    found = islands_of(mesh)
    points = np.asarray(positions_m, dtype=np.float64)
    faces = np.asarray(triangles, dtype=np.int64)
    if not len(faces):
        raise ValueError("the plainer surface has no triangle")
    nearest = _nearest(mesh, points[faces].mean(axis=1))
    island = found.of_vertex[mesh.triangles[nearest, 0]]
    keys, corner = np.unique(faces * len(found.lows) + island[:, None], return_inverse=True)
    vertex, own = keys // len(found.lows), keys % len(found.lows)
    places = _places(mesh, found, points[vertex], own, rule)
    height, width = found.texture.pixels.shape[:2]
    normals = vertex_normals(points, faces)[vertex]
    return replace(
        Mesh.simple(
            mesh.id,
            points[vertex],
            corner.reshape(-1, 3),
            uv=places / [width, height],
            normals=normals,
            material=mesh.materials[0],
        ),
        features=mesh.features,
        triangle_feature=mesh.triangle_feature[nearest],
    )


def _nearest(mesh: Mesh, middles: Floats) -> NDArray[np.intp]:
    """(m,) for each of (m, 3) points the triangle of the mesh with the nearest middle."""
    from scipy.spatial import cKDTree  # here, as few calls need it

    own = mesh.positions_m.astype(np.float64)[mesh.triangles].mean(axis=1)
    _, nearest = cKDTree(own).query(middles)
    return np.asarray(nearest, dtype=np.intp)


def _places(
    mesh: Mesh, found: Islands, points: Floats, island: NDArray[np.int64], rule: CarryParameters
) -> Floats:
    """(n, 2) px in the texture of (n, 3) points, each in its own island."""
    from scipy.spatial import cKDTree

    given = mesh.positions_m.astype(np.float64)
    apart = 4.0 * max(float(np.ptp(given, axis=0).max()), float(np.ptp(points, axis=0).max()), 1e-9)
    # Islands are apart along a fourth axis: what is nearest is of the same one.
    tree = cKDTree(np.column_stack([given, apart * found.of_vertex]))
    many = min(rule.beside, len(given))
    places = np.empty((len(points), 2))
    for first in range(0, len(points), rule.at_once):
        some = slice(first, first + rule.at_once)
        asked = np.column_stack([points[some], apart * island[some]])
        reach, index = tree.query(asked, k=many)
        near = np.asarray(index).reshape(-1, many)
        own = np.asarray(reach).reshape(-1, many) < 0.75 * apart
        places[some] = _mapped(points[some], given[near], found.places[near], own, rule.calm)
    lows, highs = found.lows[island] - rule.beyond_px, found.highs[island] + rule.beyond_px
    return np.clip(places, lows, highs)


def _mapped(
    points: Floats, around: Floats, places: Floats, own: NDArray[np.bool_], calm: float
) -> Floats:
    """(n, 2) what the even map says of (n, 3) points that fits (n, k, 3) at (n, k, 2) best.

    own: (n, k) which of them count.
    """
    reach = np.linalg.norm(around - points[:, None], axis=2)
    middle = np.where(own, reach, 0.0).sum(axis=1) / own.sum(axis=1)
    weight = own / (1e-12 + (reach / np.maximum(middle, 1e-12)[:, None]) ** 2 + 0.05)
    weight /= weight.sum(axis=1)[:, None]
    centre = np.einsum("nk,nki->ni", weight, around)
    mean = np.einsum("nk,nki->ni", weight, places)
    spread, slope = around - centre[:, None], places - mean[:, None]
    square = np.einsum("nk,nki,nkj->nij", weight, spread, spread)
    both = np.einsum("nk,nki,nkj->nij", weight, spread, slope)
    size = np.trace(square, axis1=1, axis2=2)
    square += (calm * size + 1e-18)[:, None, None] * np.eye(3)
    turned = np.linalg.solve(square, both)
    return np.asarray(mean + np.einsum("ni,nij->nj", points - centre, turned))
