"""What is kept of a segment once it is textured: its meshes, its points, and its figures."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.drive.build.consistency import Consistency
from veduta.drive.build.facade_planes import (
    FacadePlane,
    Orthophoto,
    facade_planes,
    orthophoto,
)
from veduta.drive.build.fill import Source
from veduta.drive.build.layers import PointClass
from veduta.drive.build.meshes import CLASS_COLOURS, segment_mesh
from veduta.drive.build.pictures_of import Seen
from veduta.drive.build.segment import Geometry, Textured
from veduta.drive.document.model import DriveSegment
from veduta.place.mesh import Mesh
from veduta.place.place import Standing

_HIDDEN_M = 1.0
"""A point so far behind what hides it is not seen."""


@dataclass(frozen=True, eq=False)
class Outcome:
    """meshes: its walls and ground with their places. taken_out: (n, 3) m, with (n, 3) colours.

    points: (m, 3) all scan points (m), and those of filled holes, kinds: (m,) their `PointClass`.
    triangles: of the meshes;
    fine: before any were joined; unseen_share: of those, error_m: by which that moved the surface.
    texels: of the atlas. planes: (name, plane, its orthophoto where images show enough of it).
    """

    segment: DriveSegment
    meshes: tuple[tuple[Mesh, Standing], ...]
    taken_out: NDArray[np.float64]
    colours: NDArray[np.uint8]
    points: NDArray[np.float64]
    kinds: NDArray[np.uint8]
    objects: int
    triangles: int
    fine: int
    unseen_share: float
    error_m: float
    texels: int
    consistency: Consistency
    planes: tuple[tuple[str, FacadePlane, Orthophoto | None], ...]


def outcome_of(textured: Textured, seen: Sequence[Seen], texel_m: float) -> Outcome:
    """seen: images near the segment, which colour what was taken out."""
    geometry, surface = textured.geometry, textured.surface
    meshes = []
    if len(surface.triangles):
        middle = surface.vertices.mean(axis=0)
        transform = np.eye(4)
        transform[:3, 3] = middle
        name = f"{geometry.segment.side} side, {geometry.segment.id}"
        for wall in (True, False):
            mesh = segment_mesh(textured, middle, wall=wall)
            told = name if wall else f"{name}, ground"
            if mesh is not None:
                place = Standing(told, transform, ground=not wall, document="drive.json")
                meshes.append((mesh, place))
    planes = tuple(
        (f"{geometry.segment.id}-{number:02d}", plane, orthophoto(textured, plane, texel_m))
        for number, plane in enumerate(facade_planes(textured), 1)
    )
    taken_out = geometry.foreground()
    points, kinds = _with_filled(geometry)
    return Outcome(
        geometry.segment, tuple(meshes), taken_out, coloured(taken_out, seen),
        points, kinds, geometry.object_count,
        len(surface.triangles), textured.fine_triangles, textured.unseen_share,
        textured.error_m, int(textured.atlas.surface.sum()), textured.consistency, planes,
    )  # fmt: skip


def _with_filled(geometry: Geometry) -> tuple[NDArray[np.float64], NDArray[np.uint8]]:
    """The scan points and their classes, and after them a point for each beam that was filled."""
    background, layers = geometry.background, geometry.layers
    filled = (background.source == Source.FILLED) & np.isfinite(background.depth)
    added = geometry.frame.vertices(background.depth)[filled]
    kinds = np.full(len(added), PointClass.FILLED, dtype=np.uint8)
    return np.concatenate([layers.points.points, added]), np.concatenate([layers.kind, kinds])


def coloured(points: NDArray[np.float64], seen: Sequence[Seen]) -> NDArray[np.uint8]:
    """(n, 3) the colours of foreground points in the image that shows each from nearest."""
    plain = np.array(CLASS_COLOURS[PointClass.FOREGROUND], dtype=np.uint8)
    colours = np.tile(plain, (len(points), 1))
    nearest = np.full(len(points), np.inf)
    for one in seen:
        pixels, depth = one.shot.project(points)
        height, width = one.hidden_m.shape
        at = np.floor(np.clip(pixels, -1, 1e6)).astype(np.int64)
        inside = (depth > 1.0) & (at >= 0).all(axis=1) & (at[:, 0] < width) & (at[:, 1] < height)
        at = np.where(inside[:, None], at, 0)
        inside &= (depth < one.hidden_m[at[:, 1], at[:, 0]] + _HIDDEN_M) & (depth < nearest)
        colours[inside] = one.pixels[at[inside, 1], at[inside, 0]]
        nearest[inside] = depth[inside]
    return colours
