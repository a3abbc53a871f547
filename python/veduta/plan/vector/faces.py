"""What of the lines of a drawing is solid wall: narrow faces between lines on layers of walls."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import STRtree, maximum_inscribed_circle, unary_union
from shapely.geometry import LineString, Polygon
from shapely.geometry.base import BaseGeometry
from shapely.ops import polygonize

from veduta.plan.vector.entities import Entities, Points, Stroke
from veduta.plan.vector.layers import OPENINGS, Role

THICKEST_M = 0.65
"""Faces that hold a larger circle are rooms."""
THINNEST_M = 0.02
COMMON = 0.85
BROADER = 1.4
"""Walls are at most so many times as thick as this part of all their length: closets that lines of
walls enclose are broader."""
WALLED = 0.55
"""So much of the outline of a piece of wall lies on lines of walls: jambs may be of the door."""
REACH_M = 0.02
"""Lines are made longer by this: some corners are not closed."""
NEAR_M = 0.005
LEAF_M = (0.5, 1.35)
LEAF_SWEEP = (60.0, 100.0)
"""Radius of the arcs of door leaves, and their angle (degrees)."""
LEAST_LONG = 1.2
"""A face is a wall, where no layer tells, if it is so many times as long as it is wide."""
PANE = 1.3
"""It is a pane if the band of faces at its middle is so many times as broad."""
MOST_LINES = 60_000
LEAST_NAMED = 1.0
"""Layers of walls are believed if their lines are so many times as long as what they enclose is
wide."""
OF_HOUSE: tuple[Role, ...] = ("wall", *OPENINGS, "stairs", "other")
SINGLE_M = 0.1
"""Thickness of walls that are drawn as one line."""


@dataclass(frozen=True)
class Walls:
    """`solid` in drawing units; `by_name`: whether layers told it; `single`: from single lines."""

    solid: BaseGeometry
    by_name: bool
    single: bool = False


def extent_of(found: Entities) -> float:
    """The longer side of what is drawn as walls, in drawing units; of all, where no layer tells."""
    low, high = bounds_of(found)
    return float((high - low).max())


def shows_house(found: Entities) -> bool:
    """Whether anything is drawn that may be of a house, by its layer."""
    return len(_points(found, OF_HOUSE)) > 0


def bounds_of(found: Entities) -> tuple[Points, Points]:
    """Low and high corner of the walls, without what lies far away by itself."""
    named = _points(found, ("wall",))
    points = named if len(named) >= 4 else _points(found, OF_HOUSE)
    middle = np.median(points, axis=0)
    away = np.abs(points - middle).max(axis=1)
    # Far strays: beyond ten times what nine in ten points need.
    kept = points[away <= 10.0 * max(float(np.quantile(away, 0.9)), 1e-9)]
    return kept.min(axis=0), kept.max(axis=0)


def _points(found: Entities, roles: tuple[str, ...]) -> Points:
    parts = [one.points for one in found.strokes if one.role in roles]
    parts += [ring for role, rings in found.filled if role in roles for ring in rings]
    return np.vstack(parts) if parts else np.empty((0, 2))


def named_walls(found: Entities) -> bool:
    """Whether layers tell what is wall."""
    lines = [one for one in found.strokes if one.role == "wall"]
    total = sum(_length(one.points) for one in lines)
    total += sum(_length(ring) for role, rings in found.filled if role == "wall" for ring in rings)
    return total >= LEAST_NAMED * 2.0 * extent_of(found)


def solid_walls(found: Entities, unit_m: float) -> Walls:
    """The solid of all walls: by layers, or else by which faces are as narrow and long as walls."""
    if not named_walls(found):
        return Walls(unary_union(_unnamed_cells(found, unit_m)), by_name=False)
    walls = [one for one in found.strokes if one.role == "wall"]
    cells = _cells(found, walls, unit_m)
    painted = [_painted(rings) for role, rings in found.filled if role == "wall"]
    painted += [
        LineString(one.points).buffer(one.width / 2, cap_style="flat", join_style="mitre")
        for one in walls
        if THINNEST_M <= one.width * unit_m <= THICKEST_M
    ]
    solid = unary_union([*cells, *[one for one in painted if not one.is_empty]])
    length = sum(_length(one.points) for one in walls)
    if solid.length < 0.3 * length:
        lines = [LineString(one.points) for one in walls]
        half = SINGLE_M / 2 / unit_m
        single = unary_union(lines).buffer(half, cap_style="square", join_style="mitre")
        return Walls(single.union(solid), by_name=True, single=True)
    return Walls(solid, by_name=True)


def _cells(found: Entities, walls: Sequence[Stroke], unit_m: float) -> list[Polygon]:
    """Narrow faces whose outlines lie on lines of walls, for the most part."""
    reach = REACH_M / unit_m
    others = [one for one in found.strokes if one.role in OPENINGS and one.arc is None]
    lines = [_longer(one.points, reach) for one in [*walls, *others][:MOST_LINES]]
    if not lines:
        return []
    near = NEAR_M / unit_m
    meshed = unary_union(shapely.set_precision([LineString(one) for one in lines], near / 50))
    tree = STRtree([LineString(one.points).buffer(near, cap_style="flat") for one in walls])
    bodies = tree.geometries
    kept, widths = [], []
    for face in polygonize(meshed):
        width = _width(face, near) * unit_m
        if not THINNEST_M <= width <= THICKEST_M:
            continue
        around = unary_union(bodies[tree.query(face.exterior, predicate="intersects")])
        if face.exterior.intersection(around).length >= WALLED * face.exterior.length:
            kept.append(face)
            widths.append(width)
    most = BROADER * _common(widths, [face.length for face in kept])
    return [face for face, width in zip(kept, widths, strict=True) if width <= most]


def _common(widths: Sequence[float], lengths: Sequence[float]) -> float:
    """The width that most of all the length has, or less."""
    if not widths:
        return 0.0
    order = np.argsort(widths)
    total = np.cumsum(np.array(lengths)[order])
    return float(np.array(widths)[order][np.searchsorted(total, COMMON * total[-1])])


def _unnamed_cells(found: Entities, unit_m: float) -> list[Polygon]:
    """Long narrow faces between lines of no told layer, but for panes, which lie side by side."""
    shown = [one for one in found.strokes if one.role in ("other", "wall", *OPENINGS)]
    reach, near = REACH_M / unit_m, NEAR_M / unit_m
    lines = [_longer(one.points, reach) for one in shown if one.arc is None][:MOST_LINES]
    if not lines:
        return []
    meshed = unary_union(shapely.set_precision([LineString(one) for one in lines], near / 50))
    faces = [
        (face, width)
        for face in polygonize(meshed)
        if THINNEST_M <= (width := _width(face, near) * unit_m) <= THICKEST_M
        and face.length * unit_m >= (2.0 + 2.0 * LEAST_LONG) * width
    ]
    most = BROADER * _common([width for _, width in faces], [face.length for face, _ in faces])
    band = unary_union([face.buffer(near, join_style="mitre") for face, _ in faces])
    parts = list(getattr(band, "geoms", [band]))
    tree = STRtree(parts)
    leaves = [leaf for one in shown if one.arc is not None for leaf in _closed_leaves(one, unit_m)]
    kept = []
    for face, width in faces:
        if any(_is_closed_by(face, leaf, near) for leaf in leaves):
            continue
        around = unary_union([parts[index] for index in tree.query(face)])
        here = around.intersection(face.buffer(width / unit_m, join_style="mitre"))
        if width <= most and not _is_pane(face, here, width, near, unit_m):
            kept.append(face)
    return kept


def _closed_leaves(stroke: Stroke, unit_m: float) -> list[LineString]:
    """Where a door's leaf may be when it is closed: from its hinge to both ends of its arc."""
    if stroke.arc is None:
        return []
    radius, x, y, sweep = stroke.arc
    if not (LEAF_M[0] <= radius * unit_m <= LEAF_M[1] and LEAF_SWEEP[0] <= sweep <= LEAF_SWEEP[1]):
        return []
    return [LineString([(x, y), tuple(end)]) for end in (stroke.points[0], stroke.points[-1])]


def _is_closed_by(face: Polygon, leaf: LineString, near: float) -> bool:
    """Whether a leaf lies along nearly all of a face."""
    inside = leaf.intersection(face.buffer(8.0 * near)).length
    return bool(inside > 0.7 * leaf.length and face.length < 3.2 * leaf.length)


def _is_pane(face: Polygon, here: BaseGeometry, width: float, near: float, unit_m: float) -> bool:
    """Whether a face is only a part of the breadth of the band that it lies in.

    Seen where most of it is: at its ends all walls are broad.
    """
    middle = face.centroid
    part = next(
        (one for one in getattr(here, "geoms", [here]) if one.distance(middle) < near), None
    )
    if part is None:
        return False
    box = face.minimum_rotated_rectangle
    corners = shapely.get_coordinates(box)[:3]
    sides = np.diff(corners, axis=0)
    lengths = np.hypot(*sides.T)
    along = sides[int(np.argmax(lengths))] / max(float(lengths.max()), 1e-9)
    across = np.array([-along[1], along[0]]) * 2.0 * width / unit_m
    at = np.array([middle.x, middle.y])
    cut = LineString([at - across, at + across]).intersection(part)
    breadth = max((one.length for one in getattr(cut, "geoms", [cut])), default=0.0) * unit_m
    return breadth > PANE * (width + 2.0 * NEAR_M)


def _width(face: Polygon, near: float) -> float:
    return float(2.0 * maximum_inscribed_circle(face, tolerance=near).length)


def _painted(rings: list[Points]) -> BaseGeometry:
    """A hatch: its largest ring without those inside it."""
    shapes = [Polygon(ring).buffer(0.0) for ring in rings if len(ring) >= 4]
    shapes = sorted((one for one in shapes if one.area > 0.0), key=lambda one: -one.area)
    whole: BaseGeometry = Polygon()
    for shape in shapes:
        whole = whole.symmetric_difference(shape)
    return whole


def _longer(points: Points, reach: float) -> NDArray[np.float64]:
    """An open line with both ends longer."""
    if np.allclose(points[0], points[-1]):
        return points
    first, last = points[0] - points[1], points[-1] - points[-2]
    start = points[0] + reach * first / np.hypot(*first)
    end = points[-1] + reach * last / np.hypot(*last)
    return np.vstack([start, points[1:-1], end])


def _length(points: Points) -> float:
    return float(np.hypot(*np.diff(points, axis=0).T).sum())
