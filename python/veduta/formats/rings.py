"""Polygons with holes from triangles: what a triangulation took apart is put together again.

Triangles of one feature and one look that share an edge and lie in one plane are a polygon. A
vertex is known by where it is, to a tenth of a millimetre. What is no plain polygon (it touches
itself) stays as triangles.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from veduta.formats.shapes import Shape

GRID_M = 1e-4
_FLAT = 1.0 - 1e-6
"""Cosine of the angle within which two triangles are in one plane (0.08 degrees)."""


@dataclass(frozen=True, eq=False)
class Face:
    """A polygon. rings: (n, 3) corners each (m, world), the outline counter-clockwise seen from
    outside, holes clockwise. uv: (n, 2) for each ring, glTF's.
    """

    feature: int
    look: int
    rings: tuple[NDArray[np.float64], ...]
    uv: tuple[NDArray[np.float64], ...]
    normal: NDArray[np.float64]


def faces_of(shape: Shape) -> Iterator[Face]:
    """The polygons of a part, in the order of their features."""
    own = shape.triangles
    corners = own.positions_m[own.corners]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(normal, axis=1)
    kept = np.flatnonzero(length > GRID_M * GRID_M)
    normal = normal[kept] / length[kept, None]
    steps = np.round(own.positions_m / GRID_M).astype(np.int64)
    _, vertex_of = np.unique(steps, axis=0, return_inverse=True)
    welded = vertex_of.reshape(-1)[own.corners[kept]]
    kind = own.feature[kept].astype(np.int64) * max(1, len(shape.looks)) + shape.look[kept]
    piece = _pieces(welded, kind, normal)
    order = np.argsort(kind * (len(kept) + 1) + piece, kind="stable")
    starts = np.flatnonzero(np.diff(piece[order], prepend=-1))
    for rows in np.split(order, starts[1:]) if len(order) else []:
        first = kept[rows[0]]
        feature, look = int(own.feature[first]), int(shape.look[first])
        for rings in _rings(
            welded[rows], own.corners[kept[rows]], normal[rows[0]], own.positions_m
        ):
            yield Face(
                feature,
                look,
                tuple(own.positions_m[ring] for ring in rings),
                tuple(own.uv[ring] for ring in rings),
                normal[rows[0]],
            )


def _pieces(
    welded: NDArray[np.int64], kind: NDArray[np.int64], normal: NDArray[np.float64]
) -> NDArray[np.int64]:
    """(m,) the polygon of each triangle: those of one kind that meet in an edge and are flat."""
    count = len(welded)
    if count == 0:
        return np.zeros(0, dtype=np.int64)
    ends = np.concatenate([welded[:, [0, 1]], welded[:, [1, 2]], welded[:, [2, 0]]])
    triangle = np.tile(np.arange(count), 3)
    keys = np.column_stack([np.sort(ends, axis=1), kind[triangle]])
    order = np.lexsort(keys.T)
    same = (keys[order[1:]] == keys[order[:-1]]).all(axis=1)
    one, two = triangle[order[:-1]][same], triangle[order[1:]][same]
    flat = np.einsum("ij,ij->i", normal[one], normal[two]) > _FLAT
    graph = coo_matrix((np.ones(flat.sum()), (one[flat], two[flat])), shape=(count, count))
    return connected_components(graph, directed=False)[1].astype(np.int64)


def _rings(
    welded: NDArray[np.int64],
    corners: NDArray[np.int64],
    normal: NDArray[np.float64],
    positions: NDArray[np.float64],
) -> list[list[NDArray[np.int64]]]:
    """Polygons, each a list of rings of vertices: one, or each triangle by itself."""
    if len(welded) > 1:
        traced = _traced(welded, corners)
        if traced is not None:
            areas = [_area(positions[ring], normal) for ring in traced]
            if sum(area > 0.0 for area in areas) == 1:
                order = np.argsort(areas)[::-1]
                return [[traced[row] for row in order.tolist()]]
    return [[ring] for ring in corners]


def _traced(
    welded: NDArray[np.int64], corners: NDArray[np.int64]
) -> list[NDArray[np.int64]] | None:
    """The boundary's rings; None where one touches another or itself."""
    starts, ends = welded.reshape(-1), np.roll(welded, -1, axis=1).reshape(-1)
    vertices = corners.reshape(-1)
    edges = {}
    inner = set(zip(ends.tolist(), starts.tolist(), strict=True))
    for start, end, vertex in zip(starts.tolist(), ends.tolist(), vertices.tolist(), strict=True):
        if (start, end) in inner:
            continue
        if start in edges:
            return None
        edges[start] = (end, vertex)
    rings = []
    while edges:
        first = at = next(iter(edges))
        ring: list[int] = []
        while at in edges:
            after, vertex = edges.pop(at)
            ring.append(vertex)
            at = after
        if at != first or len(ring) < 3:
            return None
        rings.append(np.array(ring, dtype=np.int64))
    return rings


def _area(ring: NDArray[np.float64], normal: NDArray[np.float64]) -> float:
    """The ring's area, positive where it runs counter-clockwise about the normal."""
    about = ring - ring[0]
    return float(np.cross(about[:-1], about[1:]).sum(axis=0) @ normal) / 2.0
