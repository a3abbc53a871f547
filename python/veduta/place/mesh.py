"""A part of a place as an indexed triangle mesh: what scans, photos and footage become.

Where `place.part` has polygons with holes, for which each corner is a vertex of its own, triangles
share their vertices here, and may have colours, normals, shapes to morph into and a skeleton.
Local frame: metres, right-handed, z up; single precision about the part's own origin.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pydantic import JsonValue

from veduta.place.features import feature_table
from veduta.place.material import Material
from veduta.place.part import Features
from veduta.place.semantics import Provenance, SemanticClass, is_drawn_only
from veduta.place.skin import Clip, Morph, Skin

__all__ = ["Clip", "Mesh", "Morph", "Skin"]


@dataclass(frozen=True, eq=False)
class Mesh:
    """Triangles as columns, with a feature table.

    positions_m: (v, 3) float32. triangles: (m, 3) uint32, counter-clockwise seen from outside.
    triangle_feature, triangle_material: (m,) int32. normals: (v, 3) float32, unit; None: smooth
    ones are made where they are needed. uv, uv_second: (v, 2) float32, glTF's: origin at the
    texture's upper left. colours: (v, 3) uint8 sRGB, which multiply the material's colour.
    values: further numbers of the vertices, (v,) float32 by name (in the file `_NAME`).
    extras: what a verb has to tell its player in the studio, under names of its own.
    pictures: by a material's name, a WebP file beside the model that is its texture.
    """

    id: str
    positions_m: NDArray[np.float32]
    triangles: NDArray[np.uint32]
    features: Features
    materials: tuple[Material, ...]
    triangle_feature: NDArray[np.int32]
    triangle_material: NDArray[np.int32]
    normals: NDArray[np.float32] | None = None
    uv: NDArray[np.float32] | None = None
    uv_second: NDArray[np.float32] | None = None
    colours: NDArray[np.uint8] | None = None
    morphs: tuple[Morph, ...] = ()
    skin: Skin | None = None
    clips: tuple[Clip, ...] = ()
    attributes: Mapping[str, str | int | float] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    extras: Mapping[str, JsonValue] = field(default_factory=dict)
    values: Mapping[str, NDArray[np.float32]] = field(default_factory=dict)
    pictures: Mapping[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        vertices, faces = len(self.positions_m), len(self.triangles)
        if self.positions_m.shape != (vertices, 3) or self.triangles.shape != (faces, 3):
            raise ValueError(f"mesh {self.id!r}: positions and triangles must have three columns")
        if not np.isfinite(self.positions_m).all():
            raise ValueError(f"mesh {self.id!r}: a position is no number")
        if faces and int(self.triangles.max()) >= vertices:
            raise ValueError(f"mesh {self.id!r}: a triangle has a vertex that is not there")
        columns = (
            (self.triangle_feature, len(self.features)),
            (
                self.triangle_material,
                len(self.materials),
            ),
        )
        for column, rows in columns:
            if column.shape != (faces,) or (
                faces and not 0 <= int(column.min()) <= int(column.max()) < rows
            ):
                raise ValueError(f"mesh {self.id!r}: a triangle names a row that is not there")
        self._require_vertices(vertices)

    def _require_vertices(self, count: int) -> None:
        """ValueError where a column of the vertices has another length."""
        columns: list[NDArray[Any] | None]
        columns = [self.normals, self.uv, self.uv_second, self.colours]
        columns += [*self.values.values()]
        columns += [morph.positions_m for morph in self.morphs]
        columns += [] if self.skin is None else [self.skin.joints]
        if any(column is not None and len(column) != count for column in columns):
            raise ValueError(f"mesh {self.id!r}: a column has not one row for each vertex")

    @staticmethod
    def simple(
        id: str,
        positions_m: NDArray[np.floating],
        triangles: NDArray[np.integer],
        semantic: SemanticClass = SemanticClass.OTHER,
        provenance: Provenance = Provenance.MEASURED,
        *,
        name: str = "surface",
        colours: NDArray[np.uint8] | None = None,
        normals: NDArray[np.floating] | None = None,
        uv: NDArray[np.floating] | None = None,
        material: Material | None = None,
    ) -> Mesh:
        """A mesh that is one thing, of one material (white, where none is given)."""
        faces = len(triangles)
        return Mesh(
            id=id,
            positions_m=np.asarray(positions_m, dtype=np.float32),
            triangles=np.asarray(triangles, dtype=np.uint32).reshape(-1, 3),
            features=feature_table(id, [(semantic, provenance, name)]),
            materials=(material or Material(name),),
            triangle_feature=np.zeros(faces, dtype=np.int32),
            triangle_material=np.zeros(faces, dtype=np.int32),
            normals=None if normals is None else np.asarray(normals, dtype=np.float32),
            uv=None if uv is None else np.asarray(uv, dtype=np.float32),
            colours=colours,
        )

    @cached_property
    def triangle_area_m2(self) -> NDArray[np.float64]:
        """(m,) the area of each triangle."""
        return np.asarray(0.5 * np.linalg.norm(self._cross, axis=1), dtype=np.float64)

    @cached_property
    def _cross(self) -> NDArray[np.float64]:
        corners = self.positions_m.astype(np.float64)[self.triangles]
        return np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])

    @cached_property
    def feature_area_m2(self) -> NDArray[np.float64]:
        """(f,) the summed area of each feature's triangles; 0 where drawn only."""
        area = np.bincount(
            self.triangle_feature, weights=self.triangle_area_m2, minlength=len(self.features)
        )
        return np.where(is_drawn_only(self.features.class_code), 0.0, area)

    @cached_property
    def vertex_normals(self) -> NDArray[np.float32]:
        """(v, 3) unit normals: those that are given, else weighted by the areas around a vertex."""
        if self.normals is not None:
            return self.normals
        summed = np.zeros((len(self.positions_m), 3))
        for axis in range(3):
            weights = np.repeat(self._cross[:, axis], 3)
            summed[:, axis] = np.bincount(
                self.triangles.reshape(-1), weights=weights, minlength=len(summed)
            )
        length = np.linalg.norm(summed, axis=1, keepdims=True)
        upwards = np.array([0.0, 0.0, 1.0])
        # A vertex between triangles without area has no direction: any unit vector serves.
        return np.where(length > 0.0, summed / np.where(length > 0.0, length, 1.0), upwards).astype(
            np.float32
        )

    @property
    def bounds_m(self) -> tuple[tuple[float, float, float], tuple[float, float, float]]:
        """Lower and upper corner of the box around all vertices (m); zeros where there are none."""
        if not len(self.positions_m):
            return (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
        low = self.positions_m.min(axis=0).astype(float).tolist()
        high = self.positions_m.max(axis=0).astype(float).tolist()
        return (low[0], low[1], low[2]), (high[0], high[1], high[2])
