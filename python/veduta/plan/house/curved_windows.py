"""Windows in curved walls: glass, frame and sills that follow the arc.

They are bands along the wall's centre line, a polygonal line (`geometry.arcs.ARC_STEP_RAD`).
"""

from __future__ import annotations

import math

import numpy as np
from shapely import get_coordinates, offset_curve
from shapely.geometry import Polygon
from shapely.ops import substring

from veduta.plan.house.frame import Frame, Sculptor, Surface, level
from veduta.plan.house.hole import Hole
from veduta.plan.house.space import Space
from veduta.plan.house.window_sizes import (
    DEPTH_M,
    FRAME_M,
    GLASS_M,
    SILL_BEYOND_M,
    SILL_FROM_M,
    SILL_M,
)
from veduta.plan.options import FrameKind

WIDEST_PANE_M = 0.8
"""Curved panes are narrower than straight ones."""


def fill_curved(
    hole: Hole, space: Space, sculptor: Sculptor, feature: int, kind: FrameKind
) -> None:
    """Fill the hole of a window in a curved wall, as `windows` fills straight ones."""
    frame = level(space.storey.elevation_m)
    bar, glass = Surface(feature, "frame"), Surface(feature, "glass")
    low = hole.low_m + (FRAME_M if kind != "none" else 0.0)
    high = hole.high_m - (FRAME_M if kind == "surround" else 0.0)
    rail = hole.line.piece(hole.start_m, hole.end_m, DEPTH_M / 2.0)
    if kind != "none":
        sculptor.prism(rail, hole.low_m, low, frame, bar)
    if kind == "surround":
        sculptor.prism(rail, high, hole.high_m, frame, bar)
    for start, end in _panes(hole, kind):
        sculptor.prism(hole.line.piece(start, end, GLASS_M / 2.0), low, high, frame, glass)
    for start, end in _posts(hole, kind):
        sculptor.prism(hole.line.piece(start, end, DEPTH_M / 2.0), low, high, frame, bar)
    if hole.low_m >= SILL_FROM_M:
        _add_sills(hole, frame, sculptor, Surface(feature, "sill"))


def _posts(hole: Hole, kind: FrameKind) -> list[tuple[float, float]]:
    """From where to where along the wall there are posts: at both ends and between panes."""
    if kind != "surround":
        return []
    clear = hole.end_m - hole.start_m - FRAME_M
    count = max(1, math.ceil((clear - FRAME_M) / WIDEST_PANE_M - 1e-9))
    places = [hole.start_m + index * clear / count for index in range(count + 1)]
    return [(place, place + FRAME_M) for place in places]


def _panes(hole: Hole, kind: FrameKind) -> list[tuple[float, float]]:
    """From where to where along the wall there is glass."""
    posts = _posts(hole, kind)
    if not posts:
        return [(hole.start_m, hole.end_m)]
    return [(one[1], other[0]) for one, other in zip(posts, posts[1:], strict=False)]


def _add_sills(hole: Hole, frame: Frame, sculptor: Sculptor, surface: Surface) -> None:
    """A board on each side of the glass, beyond the wall's face."""
    for side, room in ((1.0, hole.left), (-1.0, hole.right)):
        inside = room is not None and not room.outdoors
        reach = hole.line.half_m + SILL_BEYOND_M["inside" if inside else "outside"]
        board = _board(hole, side, DEPTH_M / 2.0, reach)
        sculptor.prism(board, hole.low_m, hole.low_m + SILL_M, frame, surface)


def _board(hole: Hole, side: float, near_m: float, far_m: float) -> Polygon:
    """What lies along the hole from one distance from the centre line to another.

    side: 1 left of it, -1 right.
    """
    part = substring(hole.line.line, hole.start_m, hole.end_m)
    near, far = (
        get_coordinates(offset_curve(part, side * away, join_style="mitre"))
        for away in (near_m, far_m)
    )
    return Polygon(np.concatenate([near, far[::-1]]))
