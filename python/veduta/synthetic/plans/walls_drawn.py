"""Walls, floors and stairs on the sheet."""

from __future__ import annotations

import numpy as np
from shapely.geometry import LineString, Polygon
from shapely.ops import substring

from veduta.synthetic.plans.bodies import solid_walls
from veduta.synthetic.plans.canvas import Canvas
from veduta.synthetic.plans.house import Stairs, Storey
from veduta.synthetic.plans.styles import Style

HATCH_M = 0.09


def draw_floors(canvas: Canvas, style: Style, storey: Storey) -> None:
    """The rooms' floors in colour, in styles that have one; tiles in wet rooms."""
    for room in storey.rooms:
        area = Polygon(room.outline_m)
        if style.floor is not None:
            canvas.fill(area.buffer(0.05, join_style="mitre"), style.floor)
        if style.tiles and room.use in ("bathroom", "toilet", "kitchen", "utility"):
            _tiles(canvas, style, area)


def _tiles(canvas: Canvas, style: Style, area: Polygon) -> None:
    x0, y0, x1, y1 = area.bounds
    pale = tuple(round(0.7 * p + 0.3 * i) for p, i in zip(style.paper, style.ink, strict=True))
    colour = (pale[0], pale[1], pale[2])
    from_edge = 0.3
    for x in np.arange(x0 + from_edge, x1, from_edge):
        _clipped(canvas, area, [(x, y0), (x, y1)], colour)
    for y in np.arange(y0 + from_edge, y1, from_edge):
        _clipped(canvas, area, [(x0, y), (x1, y)], colour)


def _clipped(
    canvas: Canvas, area: Polygon, ends: list[tuple[float, float]], colour: tuple[int, int, int]
) -> None:
    inside = LineString(ends).intersection(area)
    for part in getattr(inside, "geoms", [inside]):
        if isinstance(part, LineString) and not part.is_empty:
            canvas.line(np.array(part.coords), 0.5, colour)


def draw_walls(canvas: Canvas, style: Style, storey: Storey) -> None:
    """The walls' material in the style's way."""
    solid = solid_walls(storey)
    if style.walls in ("filled", "single-line"):
        canvas.fill(solid, style.wall_fill if style.walls == "filled" else style.ink)
    elif style.walls == "hatched":
        canvas.fill(solid, style.paper)
        canvas.hatch(solid, HATCH_M, style.pen_px * 0.7, style.ink, style.crossed)
    else:
        canvas.fill(solid, style.paper)
    if style.walls in ("hollow", "hatched") or style.outlined:
        canvas.outline(solid, style.wall_pen_px, style.ink)


def draw_stairs(canvas: Canvas, style: Style, stairs: Stairs, word: str) -> None:
    """Treads as lines, an arrow up the middle, and the word at its foot."""
    if stairs.steps_m:
        _draw_turning(canvas, style, stairs, word)
        return
    corners = np.array(stairs.outline_m)
    low, high = corners.min(axis=0), corners.max(axis=0)
    along_x = abs(stairs.up[0]) > 0.5
    for index in range(stairs.treads + 1):
        share = index / stairs.treads
        at = low + share * (high - low)
        line = (
            [(at[0], low[1]), (at[0], high[1])] if along_x else [(low[0], at[1]), (high[0], at[1])]
        )
        canvas.line(line, style.pen_px * 0.8, style.ink)
    canvas.line([*stairs.outline_m, stairs.outline_m[0]], style.pen_px * 0.8, style.ink)
    middle, up = (low + high) / 2, np.array(stairs.up)
    reach = (high - low)[0 if along_x else 1] * 0.42
    tip, tail = middle + up * reach, middle - up * reach
    across = np.array([-up[1], up[0]])
    canvas.line([tail, tip], style.pen_px, style.ink)
    canvas.line(
        [tip - 0.18 * up + 0.1 * across, tip, tip - 0.18 * up - 0.1 * across],
        style.pen_px,
        style.ink,
    )
    foot = tail + 0.25 * across
    canvas.text(word, (float(foot[0]), float(foot[1])), 9.0, style.font, style.ink)


def _draw_turning(canvas: Canvas, style: Style, stairs: Stairs, word: str) -> None:
    """As a straight flight; the arrow follows the walking line."""
    for ring in stairs.steps_m:
        canvas.line([*ring, ring[0]], style.pen_px * 0.8, style.ink)
    path = LineString(stairs.path_m)
    inset = 0.5 * path.length / stairs.treads
    shaft = np.array(substring(path, inset, path.length - inset).coords)
    canvas.line(shaft, style.pen_px, style.ink)
    tip, up = shaft[-1], (shaft[-1] - shaft[-2]) / np.hypot(*(shaft[-1] - shaft[-2]))
    across = np.array([-up[1], up[0]])
    canvas.line(
        [tip - 0.18 * up + 0.1 * across, tip, tip - 0.18 * up - 0.1 * across],
        style.pen_px,
        style.ink,
    )
    beside = np.array([-stairs.up[1], stairs.up[0]])
    foot = shaft[0] + 0.25 * beside
    canvas.text(word, (float(foot[0]), float(foot[1])), 9.0, style.font, style.ink)
