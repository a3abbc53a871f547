"""Frames, glass and sills of windows, by the paper's three kinds of frame.

AV3D, "3D generation": doors and windows have a surrounding frame, one at the bottom, or none.
"""

from __future__ import annotations

import math

from shapely.geometry import Polygon, box

from veduta.place.semantics import Provenance, SemanticClass
from veduta.plan.house.curved_windows import fill_curved
from veduta.plan.house.frame import Frame, Sculptor, Surface, ring_of, upright
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

WIDEST_PANE_M = 1.1


def add_window(hole: Hole, space: Space, sculptor: Sculptor, kind: FrameKind) -> None:
    """Fill one window."""
    frame = upright(hole.start, hole.along, space.storey.elevation_m)
    name = f"{space.storey.name} window {hole.opening.id}"
    origin = hole.opening.origin
    feature = sculptor.builder.feature(
        SemanticClass.WINDOW,
        Provenance.INVENTED if origin == "invented" else Provenance.INFERRED,
        name,
        shell=sculptor.builder.new_shell(),
        size_m=(hole.width_m, hole.high_m - hole.low_m),
    )
    if hole.line.wall.bulge:
        fill_curved(hole, space, sculptor, feature, kind)
        return
    opening = box(0.0, hole.low_m, hole.width_m, hole.high_m)
    panes = _panes(hole, kind)
    half = DEPTH_M / 2.0
    bars = opening if kind == "none" else _bars(opening, panes, kind)
    if kind != "none":
        sculptor.prism(bars, -half, half, frame, Surface(feature, "frame"))
    for pane in panes:
        sculptor.prism(pane, -GLASS_M / 2, GLASS_M / 2, frame, Surface(feature, "glass"))
    if hole.low_m >= SILL_FROM_M:
        _add_sills(hole, frame, sculptor, feature)


def _panes(hole: Hole, kind: FrameKind) -> list[Polygon]:
    """The rectangles of glass, in the plane of the window (along the wall, up)."""
    side = FRAME_M if kind == "surround" else 0.0
    foot = FRAME_M if kind != "none" else 0.0
    bar = FRAME_M if kind == "surround" else 0.0
    clear = hole.width_m - 2.0 * side
    count = max(1, math.ceil(clear / WIDEST_PANE_M - 1e-9)) if bar else 1
    width = (clear - (count - 1) * bar) / count
    bottom, top = hole.low_m + foot, hole.high_m - side
    return [
        box(side + k * (width + bar), bottom, side + k * (width + bar) + width, top)
        for k in range(count)
    ]


def _bars(opening: Polygon, panes: list[Polygon], kind: FrameKind) -> Polygon:
    if kind == "surround":
        return ring_of(opening, panes)
    left, bottom, right, _ = opening.bounds
    return box(left, bottom, right, bottom + FRAME_M)


def _add_sills(hole: Hole, frame: Frame, sculptor: Sculptor, feature: int) -> None:
    """A board on each side: outside beyond the wall's face, inside a little further."""
    surface = Surface(feature, "sill")
    half = hole.line.half_m
    for side, room in ((-1.0, hole.left), (1.0, hole.right)):
        is_inside = room is not None and not room.outdoors
        beyond = SILL_BEYOND_M["inside" if is_inside else "outside"]
        ends = sorted((side * DEPTH_M / 2.0, side * (half + beyond)))
        wider = 0.04 if is_inside else 0.02
        sculptor.slab(
            (-wider, hole.width_m + wider),
            (hole.low_m, hole.low_m + SILL_M),
            (ends[0], ends[1]),
            frame,
            surface,
        )
