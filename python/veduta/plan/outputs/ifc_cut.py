"""Walls of `house.ifc` without their openings, in pieces that are drawn out upwards."""

from __future__ import annotations

from collections.abc import Sequence

from shapely.geometry import MultiPolygon
from shapely.geometry.base import BaseGeometry
from shapely.ops import unary_union

from veduta.plan.house.hole import Hole
from veduta.plan.house.space import pieces_of

_THIN_M = 1e-3


def cut_pieces(
    region: BaseGeometry, holes: Sequence[Hole], height_m: float
) -> list[tuple[BaseGeometry, float, float]]:
    """A wall with its openings cut: regions, each from one height to another.

    Who reads the Reference View subtracts nothing: beside, under and over openings are pieces.
    """
    whole = region.difference(unary_union([hole.outline for hole in holes])) if holes else region
    found = [(whole, 0.0, height_m)]
    for hole in holes:
        own = region.intersection(hole.outline)
        found += [(own, 0.0, hole.low_m), (own, hole.high_m, height_m)]
    return [
        (MultiPolygon(kept), low, high)
        for piece, low, high in found
        if high - low > _THIN_M
        and (kept := [one for one in pieces_of(piece) if one.area > _THIN_M**2])
    ]
