"""What rails of stairs are made of."""

from __future__ import annotations

from shapely.geometry import LineString, box
from shapely.geometry.base import BaseGeometry

from veduta.place.semantics import Provenance, SemanticClass
from veduta.plan.house.frame import Frame, Sculptor, Surface

RAIL_M = 0.9
RAIL_SIDE_M = 0.045
_BAR_M = 0.014
_FREE = 0.35
"""A side gets a rail if so much of it has no wall beside it."""
_BESIDE_M = 0.15


def rail_surface(sculptor: Sculptor, name: str) -> Surface:
    """A rail of that name, in a shell of its own."""
    feature = sculptor.builder.feature(
        SemanticClass.OTHER, Provenance.INVENTED, name, shell=sculptor.builder.new_shell()
    )
    return Surface(feature, "leaf")


def add_bar(
    at: float,
    span_m: tuple[float, float],
    middle: float,
    frame: Frame,
    surface: Surface,
    sculptor: Sculptor,
) -> None:
    """An upright bar: where along the frame's first axis and its third, from where to where."""
    half = _BAR_M / 2
    shape = box(at - half, span_m[0], at + half, span_m[1] + 0.01)
    sculptor.prism(shape, middle - half, middle + half, frame, surface)


def is_free(edge: LineString, walls: BaseGeometry) -> bool:
    """Whether so much of an edge has no wall beside it that one could fall over it."""
    beside = edge.buffer(_BESIDE_M, cap_style="flat")
    covered = edge.intersection(walls.buffer(_BESIDE_M)).length if beside.intersects(walls) else 0.0
    return bool(edge.length - covered > _FREE * edge.length)
