"""Panels parallel to the facade with recesses in them, to any depth of nesting.

A panel is a rectangle at some y. Each recess cuts a hole in it, lines the hole with four
reveals and closes it by a panel further in. Edges are shared exactly, so that whatever closes
the outermost rectangle closes the whole.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from veduta.facade.paint import Finish
from veduta.facade.rectangles import Rectangle
from veduta.place.builder import PartBuilder


@dataclass(frozen=True)
class Panel:
    """A rectangle set back by `depth_m` behind the panel that it is cut into."""

    rectangle: Rectangle
    depth_m: float
    face: Finish
    reveal: Finish
    recesses: tuple[Panel, ...] = ()


Point = tuple[float, float, float]


def add_panel(
    builder: PartBuilder,
    outline: Sequence[tuple[float, float]],
    y_m: float,
    face: Finish,
    recesses: Sequence[Panel],
) -> None:
    """Add the panel with this outline (x, z; counter-clockwise seen from the street)."""
    rings: list[list[Point]] = [[(x, y_m, z) for x, z in outline]]
    for recess in recesses:
        rings.append([(x, y_m, z) for x, z in reversed(recess.rectangle.corners())])
    builder.polygon(rings, face.feature, face.material, face.uv)
    for recess in recesses:
        corners = recess.rectangle.corners()
        if recess.depth_m > 0.0:
            _add_reveals(builder, corners, y_m, y_m + recess.depth_m, recess.reveal)
        add_panel(builder, corners, y_m + recess.depth_m, recess.face, recess.recesses)


def _add_reveals(
    builder: PartBuilder,
    corners: Sequence[tuple[float, float]],
    outer_y: float,
    inner_y: float,
    finish: Finish,
) -> None:
    """Four quads around a hole; their normals look into the hole."""
    for here, there in zip(corners, [*corners[1:], corners[0]], strict=True):
        quad = [
            (here[0], outer_y, here[1]),
            (there[0], outer_y, there[1]),
            (there[0], inner_y, there[1]),
            (here[0], inner_y, here[1]),
        ]
        builder.polygon([quad], finish.feature, finish.material, finish.uv)
