"""Rooms: what the bodies of walls, openings included, enclose."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from shapely import buffer, set_precision, unary_union
from shapely.geometry import LineString, Polygon
from shapely.geometry.base import BaseGeometry
from shapely.geometry.polygon import LinearRing, orient

from veduta.plan.walls.axes import Axis
from veduta.plan.walls.graph import Graph, edge_line
from veduta.plan.walls.pieces import Piece

ARC_STEP_RAD = np.radians(6.0)
"""Outlines follow curved walls in pieces that turn by this, or less."""

LEAST_WIDTH = 2.2
"""A room is at least so many (thin) wall thicknesses wide: shafts and slots are none."""


@dataclass(frozen=True)
class Space:
    """A closed space: outline and holes, (n, 2) pixels; the outline counter-clockwise as seen."""

    outline_px: NDArray[np.float64]
    holes_px: tuple[NDArray[np.float64], ...]

    def polygon(self) -> Polygon:
        """As a polygon in pixels."""
        return Polygon(self.outline_px, self.holes_px)


def wall_body(
    start: NDArray[np.float64],
    end: NDArray[np.float64],
    thickness_px: float,
    more_px: tuple[float, float],
) -> Polygon:
    """The rectangle of a wall, prolonged by `more_px` at its start and end."""
    run = end - start
    length = float(np.hypot(*run))
    way = run / length if length else np.array([1.0, 0.0])
    first, last = start - more_px[0] * way, end + more_px[1] * way
    across = thickness_px / 2 * np.array([-way[1], way[0]])
    return Polygon([last - across, last + across, first + across, first - across])


def curved_body(line: Piece, more_px: tuple[float, float] = (0.0, 0.0)) -> Polygon:
    """What a straight or curved wall covers, prolonged straight on at its start and end."""
    points = line.arc.points(ARC_STEP_RAD)
    first, last = line.arc.way(np.array([0.0, line.length_px]))
    ends = [points[0] - more_px[0] * first, points[-1] + more_px[1] * last]
    inner = points[1:-1] if len(points) > 2 else points
    centre = LineString(
        [
            ends[0],
            *([points[0]] if more_px[0] else []),
            *inner,
            *([points[-1]] if more_px[1] else []),
            ends[1],
        ]
    )
    return centre.buffer(line.thickness_px / 2, cap_style="flat", join_style="mitre")


def wall_bodies(graph: Graph, axes: Sequence[Axis]) -> list[Polygon]:
    """Each edge's rectangle, prolonged to the far faces of the walls that it meets."""
    thick = [axes[edge.axis].line.thickness_px for edge in graph.edges]
    at: dict[int, list[int]] = {}
    for index, edge in enumerate(graph.edges):
        at.setdefault(edge.first, []).append(index)
        at.setdefault(edge.second, []).append(index)
    bodies = []
    for index, edge in enumerate(graph.edges):
        more = []
        for node in (edge.first, edge.second):
            others = [thick[other] for other in at[node] if other != index]
            more.append(min(others) / 2 if others else 0.0)
        line = edge_line(edge, graph, axes)
        if line.bulge:
            bodies.append(curved_body(line, (more[0], more[1])))
        else:
            bodies.append(wall_body(line.start, line.end, thick[index], (more[0], more[1])))
    return bodies


def closed_spaces(bodies: list[Polygon], thin_px: float) -> list[Space]:
    """The spaces that the bodies enclose, large ones first; walls that stand free are holes."""
    # Bodies that touch by rounding only are one wall.
    grown = buffer(np.array(bodies, dtype=object), 0.6, join_style="mitre")
    whole = unary_union(set_precision(grown, 1e-3))
    found = []
    parts = [part for part in getattr(whole, "geoms", [whole]) if isinstance(part, Polygon)]
    for part in parts:
        for ring in part.interiors:
            inside = Polygon(ring)
            islands = [other for other in parts if other is not part and inside.contains(other)]
            free = inside.difference(unary_union([Polygon(one.exterior) for one in islands]))
            found += _rooms_of(free, thin_px)
    return sorted(found, key=lambda one: -one.polygon().area)


def _rooms_of(free: BaseGeometry, thin_px: float) -> list[Space]:
    rooms = []
    for polygon in getattr(free, "geoms", [free]):
        if not isinstance(polygon, Polygon) or polygon.is_empty:
            continue
        grown = polygon.buffer(0.6, join_style="mitre").simplify(0.4)
        if not isinstance(grown, Polygon) or grown.buffer(-LEAST_WIDTH / 2 * thin_px).is_empty:
            continue
        # With y down, what goes clockwise by its sign goes counter-clockwise as one sees it.
        seen = orient(grown, -1.0)
        rooms.append(Space(_ring(seen.exterior), tuple(map(_ring, seen.interiors))))
    return rooms


def _ring(ring: LinearRing) -> NDArray[np.float64]:
    """Open."""
    return np.array(ring.coords)[:-1]
