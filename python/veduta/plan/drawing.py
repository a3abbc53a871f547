"""The plan as a drawing in metres: shapes with layers, for SVG, DXF and the overlay.

Plan frame: x right, y up, metres. What is drawn follows from the document alone.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np
from numpy.typing import NDArray
from shapely import get_coordinates, offset_curve
from shapely.geometry import LineString, Polygon
from shapely.ops import substring

from veduta.plan.document import Furniture, Stairs, Storey
from veduta.plan.house.hole import Hole
from veduta.plan.house.space import Space, pieces_of

Layer = Literal["rooms", "furniture", "walls", "windows", "doors", "stairs", "names"]
LAYERS: tuple[Layer, ...] = get_args(Layer)
_ARC_STEPS = 12
_BARB_M = 0.1


@dataclass(frozen=True)
class Shape:
    """Rings or open lines of a layer; rings: the outline first, then holes. (n, 2) each."""

    layer: Layer
    rings: tuple[NDArray[np.float64], ...] = ()
    lines: tuple[NDArray[np.float64], ...] = ()
    name: str = ""
    kind: str = ""
    """Use of a room, type of an opening."""


@dataclass(frozen=True)
class Label:
    """Text in the middle of a room."""

    text: str
    detail: str
    at_m: tuple[float, float]


@dataclass(frozen=True)
class Drawing:
    """All shapes of a storey, lowest first."""

    storey: Storey
    shapes: tuple[Shape, ...]
    labels: tuple[Label, ...]
    outlines_m: tuple[NDArray[np.float64], ...] = ()
    """(n, 2) each: around all walls at their outer faces, past doors and windows."""

    @property
    def bounds_m(self) -> tuple[float, float, float, float]:
        """Left, bottom, right, top of all shapes; a metre where there are none."""
        points = [
            point for shape in self.shapes for part in (*shape.rings, *shape.lines)
            for point in (part.min(axis=0), part.max(axis=0))
        ]  # fmt: skip
        if not points:
            return (0.0, 0.0, 1.0, 1.0)
        low, high = np.min(points, axis=0), np.max(points, axis=0)
        return (float(low[0]), float(low[1]), float(high[0]), float(high[1]))


def draw(space: Space) -> Drawing:
    """The drawing of a storey."""
    shapes = [
        Shape("rooms", _rings(shape), name=room.id, kind=room.use)
        for room, region in space.rooms
        for shape in pieces_of(region)
    ]
    things = sorted(space.storey.furniture or (), key=lambda thing: thing.above_m)
    shapes += [_thing(thing) for thing in things]
    solid = space.walls
    for hole in space.holes:
        solid = solid.difference(hole.outline)
    shapes += [Shape("walls", _rings(piece)) for piece in pieces_of(solid)]
    shapes += [_opening(hole) for hole in space.holes]
    for stairs in space.storey.stairs:
        shapes.append(_stairs(stairs))
    labels = [
        Label(room.name or room.use, f"{room.area_m2:.1f} m²", _middle(region))
        for room, region in space.rooms
        if not region.is_empty
    ]
    outlines = tuple(_rings(piece)[0] for piece in pieces_of(space.walls))
    return Drawing(space.storey, tuple(shapes), tuple(labels), outlines)


def _rings(shape: Polygon) -> tuple[NDArray[np.float64], ...]:
    rings = (shape.exterior, *shape.interiors)
    return tuple(np.array(ring.coords)[:-1] for ring in rings)


def _stairs(stairs: Stairs) -> Shape:
    """A flight with its treads, and an arrow up where it is known."""
    if stairs.steps_m:
        return _turning(stairs)
    ring = np.array(stairs.outline_m)
    way = np.array(stairs.up)
    sides = np.roll(ring, -1, axis=0) - ring
    if not np.hypot(*way) > 0.5:
        way = max(sides, key=lambda side: float(np.hypot(*side)))
    along = way / np.hypot(*way)
    across = np.array([-along[1], along[0]])
    forward, beside = ring @ along, ring @ across
    low, high = forward.min(), forward.max()
    left, right, middle = beside.min(), beside.max(), (beside.min() + beside.max()) / 2

    def point(ahead: float, aside: float) -> NDArray[np.float64]:
        return np.asarray(ahead * along + aside * across)

    lines = [
        np.array([point(at, left), point(at, right)])
        for at in np.linspace(low, high, stairs.treads + 1)[1:-1]
    ]
    if np.hypot(*stairs.up) > 0.5:
        tip, barb = high - 0.1 * (high - low), 0.12 * (right - left)
        lines.append(np.array([point(low + 0.05 * (high - low), middle), point(tip, middle)]))
        heads = [point(tip - 1.5 * barb, middle + side * barb) for side in (-1.0, 1.0)]
        lines.append(np.array([heads[0], point(tip, middle), heads[1]]))
    return Shape("stairs", (ring,), tuple(lines), name=stairs.id)


def _turning(stairs: Stairs) -> Shape:
    """As a straight flight; the arrow follows the walking line."""
    lines = [np.array([*ring, ring[0]]) for ring in stairs.steps_m]
    if np.hypot(*stairs.up) > 0.5:
        path = LineString(stairs.path_m)
        inset = 0.5 * path.length / stairs.treads
        shaft = np.array(substring(path, inset, path.length - inset).coords)
        tip, along = shaft[-1], (shaft[-1] - shaft[-2]) / np.hypot(*(shaft[-1] - shaft[-2]))
        across = np.array([-along[1], along[0]])
        heads = [tip - _BARB_M * (1.5 * along + side * across) for side in (-1.0, 1.0)]
        lines += [shaft, np.array([heads[0], tip, heads[1]])]
    return Shape("stairs", (np.array(stairs.outline_m),), tuple(lines), name=stairs.id)


def _middle(region: Polygon) -> tuple[float, float]:
    """A point well inside."""
    point = region.centroid
    if not region.contains(point):
        point = region.representative_point()
    return (float(point.x), float(point.y))


def _opening(hole: Hole) -> Shape:
    """An opening as plans draw it: a window as lines along the wall, a leaf with its arc."""
    start, way, width = hole.start, hole.along, hole.width_m
    left = np.array([-way[1], way[0]])
    half = hole.line.half_m
    edges = [
        np.array([start + offset * left, start + width * way + offset * left])
        for offset in (-half, half)
    ]
    ends = [
        np.array([start + along * way - half * left, start + along * way + half * left])
        for along in (0.0, width)
    ]
    opening = hole.opening
    if opening.kind == "window":
        if hole.line.wall.bulge:
            edges = [_beside(hole, offset) for offset in (-half, half)]
            ends = [np.array(pair) for pair in zip(*(edge[[0, -1]] for edge in edges), strict=True)]
            return Shape(
                "windows", (), (*edges, *ends, _beside(hole, 0.0)), opening.id, opening.type
            )
        middle = np.array([start, start + width * way])
        return Shape("windows", (), (*edges, *ends, middle), opening.id, opening.type)
    lines = [*ends, *_leaves(hole)]
    return Shape("doors", (), tuple(lines), opening.id, opening.type)


def _beside(hole: Hole, offset_m: float) -> NDArray[np.float64]:
    """(n, 2) points along an opening in a curved wall, to the left of its centre line."""
    part = substring(hole.line.line, hole.start_m, hole.end_m)
    line = offset_curve(part, offset_m, join_style="mitre") if offset_m else part
    return np.asarray(get_coordinates(line))


def _thing(thing: Furniture) -> Shape:
    """What a thing covers, and a line along its front."""
    c, s = np.cos(thing.turn_rad), np.sin(thing.turn_rad)
    turn = np.array([[c, s], [-s, c]])
    width, depth, _ = thing.size_m
    corners = np.array([(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]) / 2.0 * (width, depth)
    inset = min(0.06, 0.25 * depth)
    front = np.array([(-width / 2.0, inset - depth / 2.0), (width / 2.0, inset - depth / 2.0)])
    ring, line = corners @ turn + thing.at_m, front @ turn + thing.at_m
    return Shape("furniture", (ring,), (line,), thing.id, thing.object)


def _leaves(hole: Hole) -> list[NDArray[np.float64]]:
    """Open leaves and the arcs of their ends."""
    opening, start, way, width = hole.opening, hole.start, hole.along, hole.width_m
    if opening.hinge == "none" or opening.swing == "none":
        return []
    side = -1.0 if opening.swing == "right" else 1.0
    left = side * np.array([-way[1], way[0]])
    start = start + hole.line.half_m * left
    if opening.hinge == "both":
        hung = [(start, way, width / 2.0), (start + width * way, -way, width / 2.0)]
    elif opening.hinge == "end":
        hung = [(start + width * way, -way, width)]
    else:
        hung = [(start, way, width)]
    lines = []
    turn = np.linspace(0.0, np.pi / 2.0, _ARC_STEPS + 1)[:, None]
    for hinge, closed, length in hung:
        lines.append(np.array([hinge, hinge + length * left]))
        lines.append(hinge + length * (np.cos(turn) * closed + np.sin(turn) * left))
    return lines
