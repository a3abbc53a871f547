"""The graph, the openings and the rooms of a sheet as `drawn.Drawn`."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from shapely import STRtree, points
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
from veduta.plan.rooms.close import Space, closed_spaces, curved_body, wall_bodies
from veduta.plan.walls.axes import Axis, OnAxis
from veduta.plan.walls.find import Found
from veduta.plan.walls.graph import Edge, Graph, edge_line, openings_on, wall_graph
from veduta.plan.walls.pieces import Piece

MENDED_SCORE = 0.3
"""Of walls that nothing but the room behind them speaks for."""

NEAR_PX = 2.5
ON_OUTLINE = 0.3
"""An opening leads into a room if so much of its width lies on the room's outline."""


def drawn_from(
    cleaned: Cleaned,
    found: Found,
    axes: Sequence[Axis],
    texts: Sequence[Text],
    notes: Sequence[str] = (),
) -> Drawn:
    """Number everything and close the rooms."""
    graph = wall_graph(axes)
    bodies = wall_bodies(graph, axes)
    spaces = closed_spaces(bodies, found.thin_px)
    indoors = STRtree([space.polygon() for space in spaces])
    walls: list[DrawnWall] = []
    openings: list[DrawnOpening] = []
    for index, edge in enumerate(graph.edges):
        name = f"w{index + 1}"
        line = edge_line(edge, graph, axes)
        walls.append(
            DrawnWall(
                id=name,
                start=f"j{edge.first + 1}",
                end=f"j{edge.second + 1}",
                thickness_px=line.thickness_px,
                drawing=line.drawing,
                outer=_is_outer(line, indoors),
                score=0.9 if axes[edge.axis].origin == "measured" else MENDED_SCORE,
                bulge=round(line.bulge, 6),
                origin=axes[edge.axis].origin,
            )
        )
        for one in openings_on(edge, axes[edge.axis]):
            opening = _opening(one, edge, line, f"o{len(openings) + 1}", walls[-1])
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
        notes=(*cleaned.notes, *notes),
    )


def _is_outer(line: Piece, indoors: STRtree) -> bool:
    """Whether at one of its sides no space lies, of those that are `indoors`."""
    places = np.array([0.3, 0.7]) * line.length_px
    sides = [line.arc.at(places, side * (line.thickness_px / 2 + 4)) for side in (1, -1)]
    return not all(indoors.query(points(side), predicate="within").size for side in sides)


def _opening(
    one: OnAxis, edge: Edge, line: Piece, name: str, wall: DrawnWall
) -> DrawnOpening | None:
    length = line.length_px
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
        wall=wall.id,
        kind=judged.kind,
        type=judged.type,
        along_px=max(0.0, along),
        width_px=width,
        hinge=hinge,
        swing=swing,
        score=round(judged.score, 3),
        origin=wall.origin,
    )


def _rooms(
    spaces: Sequence[Space],
    walls: Sequence[DrawnWall],
    bodies: Sequence[Polygon],
    openings: Sequence[DrawnOpening],
    graph: Graph,
) -> list[DrawnRoom]:
    holes = _holes(walls, openings, graph)
    rooms = []
    for index, space in enumerate(spaces):
        near = space.polygon().buffer(NEAR_PX)
        around = [wall for wall, body in zip(walls, bodies, strict=True) if _along(near, body)]
        names = {wall.id for wall in around}
        mended = any(wall.origin != "measured" for wall in around)
        rooms.append(
            DrawnRoom(
                id=f"r{index + 1}",
                outline_px=space.outline_px,
                holes_px=space.holes_px,
                walls=tuple(wall.id for wall in around),
                openings=tuple(
                    one.id
                    for one, hole in zip(openings, holes, strict=True)
                    if one.wall in names and _leads_in(near, hole, one.width_px)
                ),
                mended=mended,
                score=0.6 if mended else 0.9,
            )
        )
    return rooms


def _holes(
    walls: Sequence[DrawnWall], openings: Sequence[DrawnOpening], graph: Graph
) -> list[Polygon]:
    """The rectangles of openings in their walls."""
    of = {wall.id: wall for wall in walls}
    found = []
    for one in openings:
        wall = of[one.wall]
        start, end = (graph.nodes[int(name[1:]) - 1] for name in (wall.start, wall.end))
        line = Piece(start, end, wall.thickness_px, bulge=wall.bulge)
        found.append(curved_body(line.part(one.along_px, one.along_px + one.width_px)))
    return found


def _along(near: Polygon, body: Polygon) -> bool:
    """Whether a wall runs along a room, and does not only touch its corner."""
    common = near.intersection(body)
    return bool(common.area > 12.0)


def _leads_in(near: Polygon, hole: Polygon, width_px: float) -> bool:
    """Whether a good part of an opening lies on a room's outline, grown by NEAR_PX."""
    return bool(near.intersection(hole).area > ON_OUTLINE * NEAR_PX * width_px)
