"""Colours of the vertices, and which triangles are the hull's and which the colours carved."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta import _core
from veduta.carve.build.consistency import Consistency
from veduta.carve.views import Pixels, View, camera_rows

Floats = NDArray[np.float64]
Triangles = NDArray[np.uint32]


@dataclass(frozen=True)
class ColourRule:
    """How photos give a vertex its colour: see `_core.vertex_colours`.

    edge_px: so near to the outline a photo mixes the object with what is behind it; there the colour
    is that of the nearest pixel further in.
    """

    edge_px: int = 2
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
        [colours_of_object(view, rule.edge_px) for view in views],
        positions,
        vertex_normals(positions, triangles),
        triangles,
        spacing_m=spacing_m,
        least_cosine=rule.least_cosine,
        power=rule.power,
        views=rule.views,
    )
    return Coloured(colours, seen)


def colours_of_object(view: View, edge_px: int) -> Pixels:
    """(h, w, 3) the photo, and around the object the colours of its border instead of what is there."""
    reach = np.ones((2 * edge_px + 1,) * 2, np.uint8)
    inner = cv2.erode(view.mask.astype(np.uint8), reach)
    inner = np.where(inner.any(), inner, view.mask).astype(np.uint8)
    if not inner.any():
        return np.ascontiguousarray(view.pixels)
    _, nearest = cv2.distanceTransformWithLabels(
        1 - inner, cv2.DIST_L2, cv2.DIST_MASK_5, labelType=cv2.DIST_LABEL_PIXEL
    )
    table = np.zeros((int(nearest.max()) + 1, 3), dtype=np.uint8)
    table[nearest[inner > 0]] = view.pixels[inner > 0]
    return np.ascontiguousarray(table[nearest])


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
