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
    """A wall with its openings cut: regions, each from one height to another (m).

    Who reads the Reference View subtracts nothing: beside, under and over openings are pieces.
    """
    outlines = unary_union([hole.outline for hole in holes])
    found = [(region.difference(outlines) if holes else region, 0.0, height_m)]
    for place in pieces_of(outlines):
        found += _around(region.intersection(place), holes, height_m)
    return [
        (MultiPolygon(kept), low, high)
        for piece, low, high in found
        if high - low > _THIN_M
        and (kept := [one for one in pieces_of(piece) if one.area > _THIN_M**2])
    ]


def _around(
    region: BaseGeometry, holes: Sequence[Hole], height_m: float
) -> list[tuple[BaseGeometry, float, float]]:
    """What is left of a wall's region where openings are, from one of their ends to the next.

    Openings may lie on each other: a door, and a light over it.
    """
    own = [hole for hole in holes if hole.outline.intersection(region).area > _THIN_M**2]
    ends = {min(max(end, 0.0), height_m) for hole in own for end in (hole.low_m, hole.high_m)}
    levels = sorted({0.0, height_m, *ends})
    found = []
    for low, high in zip(levels, levels[1:], strict=False):
        middle = (low + high) / 2.0
        open_here = [hole.outline for hole in own if hole.low_m < middle < hole.high_m]
        found.append((region.difference(unary_union(open_here)), low, high))
    return found
