"""What stays in memory of a segment once it is textured: its figures; the rest is on disk."""

from __future__ import annotations

from collections.abc import Callable, Sequence, Set
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from veduta.drive.build.coloured import coloured
from veduta.drive.build.facade_files import FACADES, Row, write_facade
from veduta.drive.build.facade_planes import FacadePlane, facade_planes, orthophoto
from veduta.drive.build.fill import Source
from veduta.drive.build.layers import PointClass
from veduta.drive.build.meshes import CLASS_COLOURS, segment_mesh
from veduta.drive.build.other_points import Others
from veduta.drive.build.pictures_of import Seen
from veduta.drive.build.raw import raw_file, raw_meshes, write_raw
from veduta.drive.build.segment import Geometry, Textured
from veduta.drive.build.views import before_after
from veduta.drive.build.vote import Pair, write_pair
from veduta.drive.document.model import DriveSegment
from veduta.place.mesh import Mesh
from veduta.place.place import Standing

_SAMPLE = 20_000
"""Points of a segment that the report draws."""


@dataclass(frozen=True, eq=False)
class Outcome:
    """load: the segment itself, from disk. taken_out: (n, 3) m, with (n, 3) colours.

    counts: (256,) points of each `PointClass`. sample: (k, 3) some of the points (m), kinds: (k,)
    their classes. lowest_m: of the ground, inf where there is none. triangles: of the meshes;
    fine: before any were joined; unseen_share: of those, error_m: by which that moved the surface.
    texels: of the atlas. looked, contradicted: filled pixels that images were asked about, and
    those where they disagree. planes: of its facades, by their names, and their rows of the list.
    raw: the parts that have a model of what was scanned. pair: the segment's pictures for a vote.
    others: what points of other sensors filled. seconds: geometry, atlas, synthesis, joining.
    """

    segment: DriveSegment
    load: Callable[[], Textured]
    taken_out: NDArray[np.float64]
    colours: NDArray[np.uint8]
    counts: NDArray[np.int64]
    sample: NDArray[np.float64]
    kinds: NDArray[np.uint8]
    lowest_m: float
    objects: int
    triangles: int
    fine: int
    unseen_share: float
    error_m: float
    texels: int
    looked: int
    contradicted: int
    planes: tuple[tuple[str, FacadePlane, Row], ...]
    raw: frozenset[str]
    pair: Pair | None
    others: Others
    seconds: tuple[float, float, float, float]


def outcome_of(
    textured: Textured,
    load: Callable[[], Textured],
    seen: Sequence[Seen],
    texel_m: float,
    most_taken_out: int,
    folder: Path,
) -> Outcome:
    """seen: images near the segment, which colour what was taken out. folder: of the place, for
    pictures of its planes and the models of it as it was scanned.
    """
    geometry, surface = textured.geometry, textured.surface
    name = geometry.segment.id
    planes = []
    for number, plane in enumerate(facade_planes(textured), 1):
        picture = orthophoto(textured, plane, texel_m)
        row = write_facade(f"{name}-{number:02d}", name, plane, picture, folder / FACADES)
        planes.append((f"{name}-{number:02d}", plane, row))
    taken_out = _some(geometry.foreground(), most_taken_out)
    points, kinds = with_filled(geometry)
    ground = surface.vertices[surface.triangles[~surface.wall]][..., 2]
    raw, pair = _as_scanned(textured, seen, folder)
    return Outcome(
        geometry.segment, load, taken_out, coloured(taken_out, seen, CLASS_COLOURS[PointClass.FOREGROUND]),
        np.bincount(kinds, minlength=256), _some(points, _SAMPLE), _some(kinds, _SAMPLE),
        float(ground.min()) if ground.size else float("inf"), geometry.object_count,
        len(surface.triangles), textured.fine_triangles, textured.unseen_share,
        textured.error_m, int(textured.atlas.surface.sum()), textured.consistency.looked,
        int(textured.consistency.contradicted.sum()), tuple(planes),
        raw, pair, geometry.others,
        (geometry.seconds, textured.atlas_s, textured.fill_s, textured.join_s),
    )  # fmt: skip


def _as_scanned(
    textured: Textured, seen: Sequence[Seen], folder: Path
) -> tuple[frozenset[str], Pair | None]:
    """Writes the raw models of a segment, and its pictures for a vote."""
    surface, segment = textured.surface, textured.geometry.segment
    if not len(surface.triangles):
        return frozenset(), None
    middle = surface.vertices.mean(axis=0)
    meshes = raw_meshes(textured.geometry, middle, seen)
    views = before_after(textured, meshes, middle)
    pair = None if views is None else write_pair(segment.id, segment.fate == "as-is", views, folder)
    return write_raw(meshes, folder), pair


def placed_meshes(
    textured: Textured, lift_m: float, raw: Set[str] = frozenset()
) -> list[tuple[Mesh, Standing]]:
    """The walls and the ground of a segment, and where they stand, `lift_m` higher. raw: the ids of
    those that have a model of what was scanned.
    """
    surface, segment = textured.surface, textured.geometry.segment
    if not len(surface.triangles):
        return []
    middle = surface.vertices.mean(axis=0)
    transform = np.eye(4)
    transform[:3, 3] = middle + [0.0, 0.0, lift_m]
    name = f"{segment.side} side, {segment.id}"
    meshes = []
    for wall in (True, False):
        mesh = segment_mesh(textured, middle, wall=wall)
        told = name if wall else f"{name}, ground"
        if mesh is not None:
            before = raw_file(mesh.id) if mesh.id in raw else None
            place = Standing(told, transform, ground=not wall, document="drive.json", raw=before)
            meshes.append((mesh, place))
    return meshes


def _some(rows: NDArray[Any], most: int) -> NDArray[Any]:
    """Each n-th row, so that no more than `most` are left."""
    return np.ascontiguousarray(rows[:: max(-(-len(rows) // most), 1)])


def with_filled(geometry: Geometry) -> tuple[NDArray[np.float64], NDArray[np.uint8]]:
    """The scan points and their classes, and after them a point for each beam that was filled."""
    background, layers = geometry.background, geometry.layers
    filled = (background.source == Source.FILLED) & np.isfinite(background.depth)
    added = geometry.frame.vertices(background.depth)[filled]
    kinds = np.full(len(added), PointClass.FILLED, dtype=np.uint8)
    return np.concatenate([layers.points.points, added]), np.concatenate([layers.kind, kinds])
