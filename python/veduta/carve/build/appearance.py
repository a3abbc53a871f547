"""Colours of the vertices, and which triangles are the hull's and which the colours carved."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta import _core
from veduta.carve.build.consistency import Consistency
from veduta.carve.views import View, camera_rows

Floats = NDArray[np.float64]
Triangles = NDArray[np.uint32]


@dataclass(frozen=True)
class ColourRule:
    """How photos give a vertex its colour: see `_core.vertex_colours`."""

    least_cosine: float = 0.15
    power: float = 4.0
    views: int = 3


@dataclass(frozen=True, eq=False)
class Coloured:
    """colours: (v, 3) uint8 sRGB. views: (v,) that see each vertex; 0: its colour is invented."""

    colours: NDArray[np.uint8]
    views: NDArray[np.uint16]


def colour_vertices(
    views: Sequence[View],
    positions: Floats,
    triangles: Triangles,
    spacing_m: float,
    rule: ColourRule | None = None,
) -> Coloured:
    """The colours of vertices that lie `spacing_m` apart."""
    rule = rule or ColourRule()
    colours, seen = _core.vertex_colours(
        camera_rows([view.camera for view in views]),
        [np.ascontiguousarray(view.pixels) for view in views],
        positions,
        vertex_normals(positions, triangles),
        triangles,
        spacing_m=spacing_m,
        least_cosine=rule.least_cosine,
        power=rule.power,
        views=rule.views,
    )
    return Coloured(colours, seen)


def vertex_normals(positions: Floats, triangles: Triangles) -> Floats:
    """(v, 3) unit normals, weighted by the areas of the triangles around."""
    corners = positions[triangles]
    cross = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    summed = np.stack(
        [
            np.bincount(triangles.ravel(), np.repeat(cross[:, axis], 3), len(positions))
            for axis in range(3)
        ],
        axis=1,
    )
    length = np.linalg.norm(summed, axis=1, keepdims=True)
    return np.asarray(summed / np.where(length > 0.0, length, 1.0))


def carved_triangles(
    positions: Floats, triangles: Triangles, consistency: Consistency
) -> NDArray[np.bool_]:
    """(m,) whether a triangle lies in what the colours carved."""
    root = consistency.root
    middles = positions[triangles].mean(axis=1)
    at = np.floor((middles - root.low_m) / root.voxel_m).astype(np.int64)
    count = 2**root.levels
    found = np.zeros(len(triangles), dtype=bool)
    for step in ((0, 0, 0), (1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)):
        x, y, z = np.clip(at + step, 0, count - 1).T
        found |= consistency.carved[x, y, z]
    return found
