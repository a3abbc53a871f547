"""The outline of each part on the map: its ground, or what one sees of it from above."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely.geometry import MultiPolygon, Polygon

from veduta.formats.shapes import Shape, shapes
from veduta.place.place import Place
from veduta.place.semantics import SemanticClass

How = Literal["ground", "silhouette", "hull"]
MOST_TRIANGLES = 200_000
"""A silhouette of more triangles than this is told by the hull of its corners alone."""
GRID_M = 0.001
_AT_ONCE = 500
_GAP_M = 0.02
"""Slivers and cracks narrower than twice this are closed."""
_SLENDER_M2 = 1e-4
_HULL_CELL_M = 0.25
_HULL_RATIO = 0.05


@dataclass(frozen=True)
class Outline:
    """A part on the map. polygon: x east, y north (m, from the place's origin). how: what it is.

    "ground": the surfaces of its ground. "silhouette": all its triangles seen from above. "hull": a
    concave hull of its corners. attributes: what is known of it, ready for a table.
    """

    id: str
    polygon: MultiPolygon
    attributes: dict[str, str | int | float | None]


def outlines(place: Place) -> Iterator[Outline]:
    """The outlines of the parts one by one; one without area, or a backdrop, has none."""
    for shape in shapes(place, drawn_only=False):
        if shape.placed.standing.backdrop or len(shape.triangles.corners) == 0:
            continue
        polygon, how = _outline(shape)
        if polygon is None:
            continue
        yield Outline(shape.placed.id, polygon, _attributes(shape, polygon, how))


def _outline(shape: Shape) -> tuple[MultiPolygon | None, How]:
    own = shape.triangles
    flat = own.positions_m[:, :2]
    classes = shape.features.class_code[own.feature]
    ground = classes == SemanticClass.GROUND.code
    if ground.any():
        found = _union(flat[own.corners[ground]])
        if found is not None:
            return found, "ground"
    if len(own.corners) > MOST_TRIANGLES:
        cells = np.unique(np.round(flat / _HULL_CELL_M).astype(np.int64), axis=0) * _HULL_CELL_M
        hull = shapely.concave_hull(shapely.MultiPoint(cells), ratio=_HULL_RATIO)
        return _many(hull), "hull"
    return _union(flat[own.corners]), "silhouette"


def _union(triangles: NDArray[np.float64]) -> MultiPolygon | None:
    """The area that triangles (n, 3, 2) cover, cracks closed; None where it is none."""
    one, two = triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    area = np.abs(one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0]) / 2.0
    kept = triangles[area > _SLENDER_M2]
    if len(kept) == 0:
        return None
    closed = np.concatenate([kept, kept[:, :1]], axis=1)
    # The largest first: most of the others lie within them, which is quickly seen.
    left: NDArray[Any] = np.asarray(
        shapely.polygons(closed[np.argsort(-area[area > _SLENDER_M2], kind="stable")])
    )
    joined: shapely.Geometry = Polygon()
    while len(left):
        joined = shapely.union_all([joined, *left[:_AT_ONCE]], grid_size=GRID_M)
        # Outwards and back again: cracks between storeys and the like are no courtyards.
        joined = joined.buffer(_GAP_M, join_style="mitre").buffer(-_GAP_M, join_style="mitre")
        shapely.prepare(joined)
        left = left[_AT_ONCE:]
        left = left[~shapely.covers(joined, left)]
    return _many(joined)


def _many(shape: shapely.Geometry) -> MultiPolygon | None:
    pieces = [
        shapely.geometry.polygon.orient(piece)
        for piece in getattr(shape, "geoms", [shape])
        if isinstance(piece, Polygon) and piece.area > _SLENDER_M2
    ]
    return MultiPolygon(pieces) if pieces else None


def _attributes(
    shape: Shape, polygon: MultiPolygon, how: How
) -> dict[str, str | int | float | None]:
    heights = shape.triangles.positions_m[np.unique(shape.triangles.corners), 2]
    codes = shape.features.class_code
    told: dict[str, str | int | float | None] = {
        "id": shape.placed.id,
        "name": shape.placed.standing.name or shape.placed.id,
        "outline": how,
        "area_m2": round(polygon.area, 2),
        "height_m": round(float(heights.max() - heights.min()), 2),
        "ground_m": round(float(heights.min()), 2),
        "arrangement": shape.placed.standing.arrangement,
    }
    for one in (SemanticClass.WINDOW, SemanticClass.DOOR):
        told[f"{one.value}s"] = int((codes == one.code).sum())
    for name, value in shape.content.attributes.items():
        told.setdefault(str(name), value)
    return told
