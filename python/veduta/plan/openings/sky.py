"""What is outdoors once walls are closed: under the open sky, terraces and balconies too."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from shapely import unary_union
from shapely.geometry import Point, Polygon, box
from shapely.geometry.base import BaseGeometry

from veduta.plan.document import Text
from veduta.plan.names.vocabulary import names_open_air
from veduta.plan.rooms.close import closed_spaces, wall_bodies
from veduta.plan.walls.axes import Axis
from veduta.plan.walls.graph import wall_graph
from veduta.plan.walls.pieces import Piece

WIDEST_LEAK = 12.0
"""Rooms leak through breaks of so many (thin) wall thicknesses at most."""

LEAST_HOUSE = 0.1
"""Groups of walls that enclose less than this part of the largest are no houses."""


def open_sky(axes: Sequence[Axis], thin_px: float, texts: Sequence[Text]) -> BaseGeometry:
    """What a disc as broad as WIDEST_LEAK reaches from around the sheet, and terraces.

    A room whose wall was not found everywhere is indoors all the same.
    """
    graph = wall_graph(axes)
    bodies = wall_bodies(graph, axes)
    walls = _houses(bodies)
    reach = WIDEST_LEAK / 2 * thin_px
    around = box(*walls.bounds).buffer(3 * reach, join_style="mitre")
    free = around.difference(walls.buffer(reach))
    parts = [one for one in getattr(free, "geoms", [free]) if isinstance(one, Polygon)]
    border = around.exterior
    open_sky = unary_union([one for one in parts if one.distance(border) < 1]).buffer(reach + 0.5)
    named = [Point(*np.mean(text.box_px, axis=0)) for text in texts if names_open_air(text.text)]
    spaces = [one.polygon() for one in closed_spaces(bodies, thin_px)]
    terraces = [one for one in spaces if any(one.contains(point) for point in named)]
    return unary_union([open_sky, *terraces])


def _houses(bodies: Sequence[Polygon]) -> BaseGeometry:
    """Walls that hang together and enclose much: no scale bar, beside which it is outdoors."""
    whole = unary_union([body.buffer(0.6) for body in bodies])
    parts = list(getattr(whole, "geoms", [whole]))
    largest = max((one.convex_hull.area for one in parts), default=0.0)
    return unary_union([one for one in parts if one.convex_hull.area >= LEAST_HOUSE * largest])


def leads_out(line: Piece, span: tuple[float, float], sky: BaseGeometry) -> bool:
    """Whether one side of a wall is outdoors in the middle of a span (pixels from its start)."""
    away = line.thickness_px / 2 + 5
    beside = line.arc.at(sum(span) / 2, np.array([away, -away]))
    return any(sky.contains(Point(*point)) for point in beside)
