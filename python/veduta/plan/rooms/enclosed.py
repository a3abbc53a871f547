"""Walls that meet, and the spaces that they enclose."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from shapely.geometry import Polygon

from veduta.plan.rooms.close import closed_spaces, wall_bodies
from veduta.plan.walls.axes import Axis
from veduta.plan.walls.graph import Graph, wall_graph


@dataclass(frozen=True)
class Enclosed:
    """Walls that meet: their graph, bodies of its edges, and the spaces that these enclose."""

    axes: Sequence[Axis]
    graph: Graph
    bodies: list[Polygon]
    rooms: list[Polygon]


def enclosed_by(axes: Sequence[Axis], thin_px: float) -> Enclosed:
    """What these walls enclose; `thin_px` is how thick thin walls are."""
    graph = wall_graph(axes)
    bodies = wall_bodies(graph, axes)
    rooms = [space.polygon() for space in closed_spaces(bodies, thin_px)]
    return Enclosed(axes, graph, bodies, rooms)
