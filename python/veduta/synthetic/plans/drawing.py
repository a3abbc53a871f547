"""One storey drawn as a sheet: floors, walls, openings, stairs, things and words."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from shapely import unary_union
from shapely.geometry import Point, Polygon
from shapely.geometry.base import BaseGeometry
from shapely.geometry.polygon import orient

from veduta.synthetic.plans.annotations import (
    draw_dimension_lines,
    draw_ratio,
    draw_scale_bar,
    draw_title,
)
from veduta.synthetic.plans.bodies import whole_walls
from veduta.synthetic.plans.canvas import Canvas, Image
from veduta.synthetic.plans.furniture import draw_things, furnish
from veduta.synthetic.plans.house import Storey
from veduta.synthetic.plans.labels import Label, draw_label, labels_of, with_labels
from veduta.synthetic.plans.names import UP
from veduta.synthetic.plans.openings_drawn import draw_door, draw_window
from veduta.synthetic.plans.places import swept
from veduta.synthetic.plans.styles import Style
from veduta.synthetic.plans.terraces import draw_terraces, terraces_of
from veduta.synthetic.plans.walls_drawn import draw_floors, draw_stairs, draw_walls

MARGIN_M = 1.0
ANNOTATED_MARGIN_M = 2.2


def _annotated(style: Style) -> bool:
    return style.dimension_lines or style.title or style.scale_bar or style.ratio


@dataclass(frozen=True)
class Sheet:
    """A drawn storey. `storey` is what was drawn, which in thin walls differs from the house's.

    `px_from_m` (3, 3) takes the plan frame to pixels; `says_scale` whether a size is printed.
    """

    picture: Image
    px_from_m: NDArray[np.float64]
    storey: Storey
    labels: tuple[Label, ...]
    says_scale: bool


def draw_sheet(storey: Storey, style: Style, rng: np.random.Generator) -> Sheet:
    """The storey drawn in a style, undegraded."""
    metres_per_px = 1.0 / rng.uniform(*style.px_per_m)
    if style.walls == "single-line":
        storey = with_thin_walls(storey, style.wall_pen_px * metres_per_px)
    house = whole_walls(storey.walls)
    terraces = [] if style.dimension_lines else terraces_of(rng, style, storey, house)
    left, bottom, right, top = bounds = unary_union([house, *(one.area for one in terraces)]).bounds
    margin = ANNOTATED_MARGIN_M if _annotated(style) else MARGIN_M
    sheet = (left - margin, bottom - margin, right + margin, top + margin)
    canvas = Canvas(sheet, metres_per_px, style.paper)
    draw_floors(canvas, style, storey)
    busy = kept_free(storey)
    draw_walls(canvas, style, storey)
    for opening in storey.openings:
        draw = draw_window if opening.kind == "window" else draw_door
        draw(canvas, style, storey.wall(opening.wall), opening)
    draw_terraces(canvas, style, terraces)
    for stairs in storey.stairs:
        draw_stairs(canvas, style, stairs, UP[style.language])
    labels = labels_of(rng, canvas, style, storey, busy)
    taken = with_labels(busy, labels, 0.04)
    draw_things(canvas, style, furnish(rng, storey, style.furniture, taken))
    for label in labels:
        draw_label(canvas, style, label)
    _annotate(canvas, style, storey, bounds)
    says = any(label.size for label in labels) or style.dimension_lines or style.scale_bar
    return Sheet(canvas.picture(), canvas.px_from_m, storey, tuple(labels), says)


def _annotate(
    canvas: Canvas, style: Style, storey: Storey, bounds: tuple[float, float, float, float]
) -> None:
    """What stands around the house and its terraces, whose bounds are given."""
    left, bottom, right, top = bounds
    if style.dimension_lines:
        draw_dimension_lines(canvas, style, storey, bounds)
    if style.title:
        gross = unary_union(
            [Polygon(ring.coords) for ring in _exteriors(whole_walls(storey.walls))]
        )
        draw_title(canvas, style, storey.number, gross.area, ((left + right) / 2, bottom - 1.2))
    if style.scale_bar:
        draw_scale_bar(canvas, style, (max(left, right - 5.6), top + 0.35))
    if style.ratio:
        draw_ratio(canvas, style, (left + 0.8, top + 0.5))


def kept_free(storey: Storey) -> BaseGeometry:
    """Where doors swing, so that nothing is put there."""
    return unary_union(
        [
            swept(storey.wall(opening.wall), opening)
            for opening in storey.openings
            if opening.kind != "window"
        ]
    )


def with_thin_walls(storey: Storey, thickness_m: float) -> Storey:
    """The storey with all walls of one thickness, and the rooms that lie between those."""
    walls = tuple(replace(wall, thickness_m=thickness_m) for wall in storey.walls)
    bodies = whole_walls(walls)
    inside = unary_union([Polygon(ring.coords) for ring in _exteriors(bodies)])
    free = inside.difference(bodies)
    parts = [orient(part) for part in getattr(free, "geoms", [free])]
    rooms = []
    for room in storey.rooms:
        within: Point = Polygon(room.outline_m).representative_point()
        part = next(part for part in parts if part.contains(within))
        outline = tuple((round(x, 4), round(y, 4)) for x, y in part.exterior.coords[:-1])
        rooms.append(replace(room, outline_m=outline, area_m2=round(part.area, 4)))
    return replace(storey, walls=walls, rooms=tuple(rooms))


def _exteriors(area: BaseGeometry) -> list[BaseGeometry]:
    parts = [area] if isinstance(area, Polygon) else getattr(area, "geoms", [])
    return [part.exterior for part in parts]
