"""Polygons of a building as a part: what each of them is, and which of them are one surface."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from veduta import _core
from veduta.formats.building_faces import Rings
from veduta.photos.city.model import CityBuilding
from veduta.place.builder import PartBuilder
from veduta.place.material import Colour, Material
from veduta.place.part import PLANE_TOLERANCE_M
from veduta.place.semantics import Provenance, SemanticClass

MOST_BEND_M = 0.5
"""A polygon whose corners lie further off a plane is not taken."""
STEEP = 0.5
"""z of a unit normal up to which a surface is a wall: roofs are not steeper than 60 degrees."""
SAME_NORMAL, SAME_OFFSET_M = 0.995, 0.05
"""Polygons of one class that lie in one plane so nearly are one surface."""
_COLOURS: dict[SemanticClass, Colour] = {
    SemanticClass.WALL: (0.82, 0.79, 0.73),
    SemanticClass.ROOF: (0.62, 0.36, 0.29),
    SemanticClass.GROUND: (0.55, 0.55, 0.52),
}
_OTHER: Colour = (0.7, 0.7, 0.7)


_Known = dict[tuple[SemanticClass, int], list[tuple[int, NDArray[np.float64], float]]]
"""Surfaces by class and offset, in slabs of `SAME_OFFSET_M`: row, normal, offset. A town may be one
object with a hundred thousand faces."""


class NoBuildingError(ValueError):
    """The polygons give no building."""


def building_of(
    name: str,
    polygons: Sequence[Rings],
    classes: Sequence[SemanticClass | None],
    attributes: Mapping[str, str | int | float],
    *,
    solid: bool,
) -> tuple[CityBuilding, int]:
    """The building of polygons in metres about the model's origin, and how many were left out.

    Polygons that are not plane become triangles. Polygons of a solid that all look inwards are
    turned round. NoBuildingError where nothing is left.
    """
    offset = np.floor(min_corner(polygons))
    local: list[Rings] = [tuple(ring - offset for ring in rings) for rings in polygons]
    plane, plane_classes, left = _plane(local, list(classes))
    if not plane:
        raise NoBuildingError("none of its surfaces is a polygon")
    normals, areas, offsets = _planes(plane)
    if solid and float((areas * offsets).sum()) < 0.0:
        plane = [tuple(ring[::-1] for ring in rings) for rings in plane]
        normals, offsets = -normals, -offsets
    kinds = [
        kind or _by_normal(float(normal[2]))
        for kind, normal in zip(plane_classes, normals, strict=True)
    ]
    builder = PartBuilder(name)
    builder.attributes |= dict(attributes)
    materials = {
        kind: builder.material(Material(kind.value, _COLOURS.get(kind, _OTHER)))
        for kind in dict.fromkeys(kinds)
    }
    features: list[int] = []
    known: _Known = {}
    for kind, rings, normal, along in zip(kinds, plane, normals, offsets, strict=True):
        row = _same_surface(known, kind, normal, float(along))
        if row is None:
            row = len(features)
            known.setdefault((kind, _slab(float(along))), []).append((row, normal, float(along)))
            number = builder.count(kind) + 1
            title = f"{kind.value} {number}"
            features.append(builder.feature(kind, Provenance.INFERRED, title))
        builder.polygon(rings, features[row], materials[kind])
    x, y, z = offset.tolist()
    return CityBuilding(name, builder.build(), (x, y, z)), left


def min_corner(polygons: Sequence[Rings]) -> NDArray[np.float64]:
    """(3,) the lower corner of the box around polygons."""
    lows = [ring.min(axis=0) for rings in polygons for ring in rings[:1]]
    found: NDArray[np.float64] = np.min(lows, axis=0)
    return found


def _plane(
    polygons: list[Rings], classes: list[SemanticClass | None]
) -> tuple[list[Rings], list[SemanticClass | None], int]:
    """The plane polygons, bent ones as triangles; how many are neither."""
    single = [tuple(ring.astype(np.float32).astype(np.float64) for ring in r) for r in polygons]
    columns = _columns(single)
    fine = _core.sound_polygons(*columns, PLANE_TOLERANCE_M)
    rough = _core.sound_polygons(*columns, MOST_BEND_M) & ~fine
    found = [rings for rings, sound in zip(single, fine, strict=True) if sound]
    kinds = [kind for kind, sound in zip(classes, fine, strict=True) if sound]
    rows = np.flatnonzero(rough)
    if len(rows):
        bent = _columns([single[row] for row in rows])
        corners, polygon, _, _ = _core.triangulate_polygons(*bent, MOST_BEND_M)
        for triangle, own in zip(bent[0][corners], polygon.tolist(), strict=True):
            normal = np.cross(triangle[1] - triangle[0], triangle[2] - triangle[0])
            if float(np.linalg.norm(normal)) > 1e-4:
                found.append((triangle,))
                kinds.append(classes[int(rows[own])])
    return found, kinds, int((~fine & ~rough).sum())


def _columns(
    polygons: Sequence[Rings],
) -> tuple[NDArray[np.float64], NDArray[np.int64], NDArray[np.int64]]:
    rings = [ring for rings in polygons for ring in rings]
    sizes = [len(ring) for ring in rings]
    counts = [len(rings) for rings in polygons]
    return (
        np.concatenate(rings),
        np.concatenate([[0], np.cumsum(sizes)]).astype(np.int64),
        np.concatenate([[0], np.cumsum(counts)]).astype(np.int64),
    )


def _planes(
    polygons: Sequence[Rings],
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """(p, 3) unit normals, (p,) areas and (p,) offsets along the normals, of the outlines."""
    doubled = np.array([_doubled_area(rings[0]) for rings in polygons])
    length = np.linalg.norm(doubled, axis=1)
    normals = doubled / np.maximum(length, 1e-12)[:, None]
    middles = np.array([rings[0].mean(axis=0) for rings in polygons])
    return normals, length / 2.0, np.einsum("ij,ij->i", normals, middles)


def _doubled_area(ring: NDArray[np.float64]) -> NDArray[np.float64]:
    """(3,) twice the area, along the normal (Newell)."""
    about = ring - ring[0]
    found: NDArray[np.float64] = np.cross(about, np.roll(about, -1, axis=0)).sum(axis=0)
    return found


def _by_normal(up: float) -> SemanticClass:
    if abs(up) <= STEEP:
        return SemanticClass.WALL
    return SemanticClass.ROOF if up > 0 else SemanticClass.GROUND


def _same_surface(
    known: _Known, kind: SemanticClass, normal: NDArray[np.float64], offset: float
) -> int | None:
    """The first row of the surfaces in the same plane, None where there is none."""
    slab = _slab(offset)
    rows = [
        row
        for near in (slab - 1, slab, slab + 1)
        for row, its, along in known.get((kind, near), ())
        if abs(along - offset) < SAME_OFFSET_M and float(its @ normal) > SAME_NORMAL
    ]
    return min(rows, default=None)


def _slab(offset: float) -> int:
    return math.floor(offset / SAME_OFFSET_M)
