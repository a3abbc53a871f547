"""A part of a place: polygons, triangles and features as columns, in one local frame.

Local frame: metres, right-handed, z up; single precision about the part's own origin. There is
no object per surface: a part of a million faces is a few dozen arrays.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from veduta import _core
from veduta.place.instances import Instances
from veduta.place.lamp import Lamp
from veduta.place.material import Material
from veduta.place.mover import Mover
from veduta.place.semantics import Provenance, SemanticClass, is_drawn_only

# A vertex may lie this far off its polygon's plane (m): single precision at a kilometre.
PLANE_TOLERANCE_M = 1e-3

NO_PARENT = -1


@dataclass(frozen=True)
class Features:
    """The feature table: row i describes all polygons whose feature is i.

    class_code, provenance_code: (f,) uint8, codes of the enums in `place.semantics`.
    parent: (f,) int32, the feature that this one lies in (a window's wall), or -1.
    shell: (f,) int32, the closed surface that it belongs to; 0 is the body.
    width_m, height_m: (f,) float64, size along and up the surface, NaN where it has none.
    photo_px: (f, 4) float64, x, y, width, height in the rectified photo; NaN where unseen.
    seen_height_m: (f,) float64, how much of height_m was seen, from the top, where a rule makes
    the surface reach further down; NaN elsewhere.
    score: (f,) float64, how sure it was, 0..1, where what read the record says it; NaN elsewhere.
    """

    id: tuple[str, ...]
    name: tuple[str, ...]
    class_code: NDArray[np.uint8]
    provenance_code: NDArray[np.uint8]
    parent: NDArray[np.int32]
    shell: NDArray[np.int32]
    width_m: NDArray[np.float64]
    height_m: NDArray[np.float64]
    photo_px: NDArray[np.float64]
    seen_height_m: NDArray[np.float64]
    score: NDArray[np.float64]

    def __len__(self) -> int:
        return len(self.id)

    def semantic(self, row: int) -> SemanticClass:
        """The class of one feature."""
        return SemanticClass.of_code(int(self.class_code[row]))

    def provenance(self, row: int) -> Provenance:
        """Where one feature comes from."""
        return Provenance.of_code(int(self.provenance_code[row]))


@dataclass(frozen=True)
class Triangles:
    """What is derived from the polygons.

    indices: (m, 3) uint32 into the part's vertices, counter-clockwise seen from outside.
    polygon: (m,) uint32, the polygon of each triangle.
    polygon_normal: (p, 3) float64, unit. polygon_area_m2: (p,) float64.
    """

    indices: NDArray[np.uint32]
    polygon: NDArray[np.uint32]
    polygon_normal: NDArray[np.float64]
    polygon_area_m2: NDArray[np.float64]


@dataclass(frozen=True)
class Part:
    """Polygons with holes as columns; a vertex belongs to exactly one ring.

    positions_m: (v, 3) float32. uv: (v, 2) float32, glTF's: origin at the texture's upper left.
    ring_offsets: (r + 1,) int64, first vertex of each ring. polygon_offsets: (p + 1,) int64,
    first ring of each polygon, whose first ring is the outline.
    polygon_feature, polygon_material: (p,) int32.
    attributes: what is known of the whole, under CityJSON's names where it has them.
    notes: what was adjusted or left out, and why.
    instances: meshes that stand in the part many times, besides its polygons; None without any.
    movers: polygons of the part that move together, such as the leaves of doors.
    lamps: points of the part that shine.
    """

    id: str
    positions_m: NDArray[np.float32]
    uv: NDArray[np.float32]
    ring_offsets: NDArray[np.int64]
    polygon_offsets: NDArray[np.int64]
    polygon_feature: NDArray[np.int32]
    polygon_material: NDArray[np.int32]
    features: Features
    materials: tuple[Material, ...]
    attributes: Mapping[str, str | int | float] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    instances: Instances | None = None
    movers: tuple[Mover, ...] = ()
    lamps: tuple[Lamp, ...] = ()

    def __post_init__(self) -> None:
        if not np.isfinite(self.positions_m).all():
            raise ValueError(f"part {self.id!r}: a position is no number")

    @cached_property
    def triangles(self) -> Triangles:
        """Triangles of all polygons; raises `_core.PolygonFault` on a polygon that is none."""
        return Triangles(
            *_core.triangulate_polygons(
                self.positions_m.astype(np.float64),
                self.ring_offsets,
                self.polygon_offsets,
                PLANE_TOLERANCE_M,
            )
        )

    @property
    def bounds_m(self) -> tuple[tuple[float, float, float], tuple[float, float, float]]:
        """Lower and upper corner of the axis-parallel box around all that is seen."""
        ends = [self.positions_m.astype(np.float64)]
        if self.instances is not None:
            ends.append(np.stack(self.instances.bounds_m()))
        every = np.concatenate(ends)
        low, high = every.min(axis=0).tolist(), every.max(axis=0).tolist()
        return (low[0], low[1], low[2]), (high[0], high[1], high[2])

    @cached_property
    def feature_area_m2(self) -> NDArray[np.float64]:
        """(f,) the summed area of each feature's polygons, holes taken off; 0 where drawn only."""
        area = np.zeros(len(self.features))
        np.add.at(area, self.polygon_feature, self.triangles.polygon_area_m2)
        if self.instances is not None:
            area += self.instances.feature_area_m2(len(self.features))
        area[is_drawn_only(self.features.class_code)] = 0.0
        return area

    def polygons_of_shell(self, shell: int) -> NDArray[np.int64]:
        """The polygons that close one shell, in order."""
        return np.flatnonzero(self.features.shell[self.polygon_feature] == shell)
