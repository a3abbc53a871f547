"""The faces of a city model: what lies in one plane and touches is one rectangle of texture.

Faces of classes that no photo shows from outside (the ground below a building) are left out.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from veduta.photos.city.model import CityModel
from veduta.place.part import Part
from veduta.place.semantics import SemanticClass

SMALLEST_M2 = 0.25
"""Faces below this get no texture: a strip of a few texels."""
_SAME_NORMAL = 1e-3
_SAME_PLANE_M = 0.02
_TOUCH_M = 1e-3
_LEVEL = 0.999
_SUBPIXEL = 4
_UNSEEN = (SemanticClass.GROUND.code,)


@dataclass(frozen=True)
class Face:
    """A rectangle in the world (m, about the model's origin) around polygons of one building.

    building: its row. polygons: (k,) rows of its part. corner: (3,) upper left, as one sees it
    from outside. right, down: (3,) unit. normal: (3,) unit, outward. size_m: width and height.
    outlines: (n, 2) each, of all rings: metres right of and below the corner.
    """

    building: int
    polygons: NDArray[np.int64]
    corner: NDArray[np.float64]
    right: NDArray[np.float64]
    down: NDArray[np.float64]
    normal: NDArray[np.float64]
    size_m: tuple[float, float]
    area_m2: float
    outlines: tuple[NDArray[np.float64], ...]

    def points(self, places: NDArray[np.float64]) -> NDArray[np.float64]:
        """(n, 3) in the world of (n, 2) metres right of and below the corner."""
        found: NDArray[np.float64] = self.corner + places @ np.stack([self.right, self.down])
        return found

    def corners(self) -> NDArray[np.float64]:
        """(4, 3) the rectangle's, clockwise from the upper left as seen from outside."""
        width, height = self.size_m
        return self.points(np.array([[0, 0], [width, 0], [width, height], [0, height]]))

    def inside(self, shape: tuple[int, int], pitch_m: float) -> NDArray[np.bool_]:
        """(rows, columns) which squares of this pitch have their middle in a polygon, or nearly."""
        scale = (1 << _SUBPIXEL) / pitch_m
        mask = np.zeros(shape, dtype=np.uint8)
        rings = [
            np.round(ring * scale - (1 << _SUBPIXEL) / 2).astype(np.int32) for ring in self.outlines
        ]
        cv2.fillPoly(mask, rings, 1, cv2.LINE_8, _SUBPIXEL)
        return mask > 0


def faces_of(city: CityModel, buildings: Iterable[int] | None = None) -> list[Face]:
    """All faces that may be textured, building by building; of these buildings (rows), or all."""
    rows = range(len(city.buildings)) if buildings is None else buildings
    return [
        face
        for row in rows
        for face in _faces(row, city.buildings[row].part, np.array(city.buildings[row].offset_m))
    ]


def _faces(number: int, part: Part, offset: NDArray[np.float64]) -> Iterator[Face]:
    triangles = part.triangles
    world = part.positions_m.astype(np.float64) + offset
    shown = ~np.isin(part.features.class_code[part.polygon_feature], _UNSEEN)
    shown &= triangles.polygon_area_m2 > 0
    groups = _groups(part, world, triangles.polygon_normal)
    rows = np.flatnonzero(shown)
    rows = rows[np.argsort(groups[rows], kind="stable")]
    for polygons in np.split(rows, np.flatnonzero(np.diff(groups[rows])) + 1):
        area = float(triangles.polygon_area_m2[polygons].sum())
        if len(polygons) and area >= SMALLEST_M2:
            largest = polygons[triangles.polygon_area_m2[polygons].argmax()]
            normal = triangles.polygon_normal[largest]
            yield _face(number, part, world, polygons, normal, area)


def _groups(
    part: Part, world: NDArray[np.float64], normals: NDArray[np.float64]
) -> NDArray[np.int64]:
    """(p,) a number per polygon, the same for those in one plane that share a corner."""
    first = part.ring_offsets[part.polygon_offsets]
    of_vertex = np.repeat(np.arange(len(normals)), np.diff(first))
    keys = np.round((world - world.min(axis=0)) / _TOUCH_M).astype(np.int64)
    _, place = np.unique(keys, axis=0, return_inverse=True)
    order = np.argsort(place.reshape(-1), kind="stable")
    same = np.diff(place.reshape(-1)[order]) == 0
    pairs = np.stack([of_vertex[order][:-1][same], of_vertex[order][1:][same]])
    # A corner belongs to several planes: each polygon is compared with the next few around it.
    wide = [pairs]
    for step in (2, 3, 4, 5):
        both = place.reshape(-1)[order][step:] == place.reshape(-1)[order][:-step]
        wide.append(np.stack([of_vertex[order][:-step][both], of_vertex[order][step:][both]]))
    first_of, second_of = np.concatenate(wide, axis=1)
    offset = (normals * world[first[:-1]]).sum(axis=1)
    agree = (normals[first_of] * normals[second_of]).sum(axis=1) > 1 - _SAME_NORMAL
    agree &= np.abs(offset[first_of] - offset[second_of]) < _SAME_PLANE_M
    edges = (np.ones(int(agree.sum())), (first_of[agree], second_of[agree]))
    graph = coo_array(edges, shape=(len(normals), len(normals)))
    return np.asarray(connected_components(graph, directed=False)[1], dtype=np.int64)


def _face(
    number: int,
    part: Part,
    world: NDArray[np.float64],
    polygons: NDArray[np.int64],
    normal: NDArray[np.float64],
    area: float,
) -> Face:
    """The rectangle along the horizontal of its plane; a level face has north above."""
    level = abs(normal[2]) > _LEVEL
    right = np.array([1.0, 0.0, 0.0]) if level else np.cross([0.0, 0.0, 1.0], normal)
    right = right - normal * (right @ normal)
    right /= np.linalg.norm(right)
    down = np.cross(right, normal)
    rings = []
    for polygon in polygons.tolist():
        for ring in range(part.polygon_offsets[polygon], part.polygon_offsets[polygon + 1]):
            corners = world[part.ring_offsets[ring] : part.ring_offsets[ring + 1]]
            rings.append(corners @ np.stack([right, down], axis=1))
    every = np.concatenate(rings)
    low, high = every.min(axis=0), every.max(axis=0)
    plane = float(normal @ world[part.ring_offsets[part.polygon_offsets[polygons[0]]]])
    return Face(
        building=number,
        polygons=polygons,
        corner=low[0] * right + low[1] * down + plane * normal,
        right=right,
        down=down,
        normal=normal,
        size_m=(float(high[0] - low[0]), float(high[1] - low[1])),
        area_m2=area,
        outlines=tuple(ring - low for ring in rings),
    )
