"""The graph, the openings and the rooms of a sheet as `drawn.Drawn`."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from shapely.geometry import Polygon

from veduta.plan.document import Text
from veduta.plan.drawn import (
    Cleaned,
    Drawn,
    DrawnJunction,
    DrawnOpening,
    DrawnRoom,
    DrawnWall,
)
from veduta.plan.rooms.close import Space, closed_spaces, contains, wall_body
from veduta.plan.walls.axes import Axis, OnAxis
from veduta.plan.walls.find import Found
from veduta.plan.walls.graph import Edge, Graph, openings_on, wall_graph


def drawn_from(
    cleaned: Cleaned, found: Found, axes: Sequence[Axis], texts: Sequence[Text]
) -> Drawn:
    """Number everything and close the rooms."""
    graph = wall_graph(axes)
    bodies = [_body(edge, graph, axes) for edge in graph.edges]
    spaces = closed_spaces(bodies, found.thin_px)
    walls: list[DrawnWall] = []
    openings: list[DrawnOpening] = []
    for index, edge in enumerate(graph.edges):
        start, end = graph.nodes[edge.first], graph.nodes[edge.second]
        name = f"w{index + 1}"
        line = axes[edge.axis].line
        walls.append(
            DrawnWall(
                id=name,
                start=f"j{edge.first + 1}",
                end=f"j{edge.second + 1}",
                thickness_px=line.thickness_px,
                drawing=line.drawing,
                outer=_is_outer(start, end, line.thickness_px, spaces),
                score=0.9,
            )
        )
        for one in openings_on(edge, axes[edge.axis]):
            opening = _opening(one, edge, graph, f"o{len(openings) + 1}", name)
            if opening is not None:
                openings.append(opening)
    return Drawn(
        cleaned=cleaned,
        junctions=tuple(
            DrawnJunction(f"j{index + 1}", (float(at[0]), float(at[1])), kind)
            for index, (at, kind) in enumerate(zip(graph.nodes, graph.types, strict=True))
        ),
        walls=tuple(walls),
        openings=tuple(openings),
        rooms=tuple(_rooms(spaces, walls, bodies, openings, graph)),
        texts=tuple(texts),
        notes=cleaned.notes,
    )


def _body(edge: Edge, graph: Graph, axes: Sequence[Axis]) -> Polygon:
    """Its rectangle, prolonged to the far faces of the walls that it meets."""
    thickness = axes[edge.axis].line.thickness_px
    more = []
    for node in (edge.first, edge.second):
        others = [
            axes[other.axis].line.thickness_px
            for other in graph.edges
            if other is not edge and node in (other.first, other.second)
        ]
        more.append(min(others) / 2 if others else 0.0)
    start, end = graph.nodes[edge.first], graph.nodes[edge.second]
    return wall_body(start, end, thickness, (more[0], more[1]))


def _is_outer(
    start: NDArray[np.float64],
    end: NDArray[np.float64],
    thickness_px: float,
    spaces: Sequence[Space],
) -> bool:
    run = end - start
    normal = np.array([-run[1], run[0]]) / max(float(np.hypot(*run)), 1e-9)
    open_sides = 0
    for side in (1, -1):
        points = [
            start + part * run + side * (thickness_px / 2 + 4) * normal for part in (0.3, 0.7)
        ]
        open_sides += not any(contains(space, point) for space in spaces for point in points)
    return open_sides > 0


def _opening(one: OnAxis, edge: Edge, graph: Graph, name: str, wall: str) -> DrawnOpening | None:
    length = float(np.hypot(*(graph.nodes[edge.second] - graph.nodes[edge.first])))
    low, high = max(one.first, edge.low), min(one.last, edge.high)
    along = low - edge.low
    width = min(high - low, length - along)
    if width <= 1:
        return None
    judged = one.judged
    hinge, swing = judged.hinge, judged.swing
    if not one.along:
        hinge = {"start": "end", "end": "start"}.get(hinge, hinge)  # type: ignore[assignment]
        swing = {"left": "right", "right": "left"}.get(swing, swing)  # type: ignore[assignment]
    return DrawnOpening(
        id=name,
        wall=wall,
        kind=judged.kind,
        type=judged.type,
        along_px=max(0.0, along),
        width_px=width,
        hinge=hinge,
        swing=swing,
        score=round(judged.score, 3),
    )


def _rooms(
    spaces: Sequence[Space],
    walls: Sequence[DrawnWall],
    bodies: Sequence[Polygon],
    openings: Sequence[DrawnOpening],
    graph: Graph,
) -> list[DrawnRoom]:
    rooms = []
    for index, space in enumerate(spaces):
        near = space.polygon().buffer(2.5)
        around = [wall for wall, body in zip(walls, bodies, strict=True) if _along(near, body)]
        names = {wall.id for wall in around}
        rooms.append(
            DrawnRoom(
                id=f"r{index + 1}",
                outline_px=space.outline_px,
                holes_px=space.holes_px,
                walls=tuple(wall.id for wall in around),
                openings=tuple(one.id for one in openings if one.wall in names),
                mended=False,
                score=0.9,
            )
        )
    return rooms


def _along(near: Polygon, body: Polygon) -> bool:
    """Whether a wall runs along a room, and does not only touch its corner."""
    common = near.intersection(body)
    return bool(common.area > 12.0)
