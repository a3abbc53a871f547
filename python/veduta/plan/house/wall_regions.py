"""Which part of the walls' footprint belongs to which wall."""

from __future__ import annotations

from shapely import STRtree, unary_union
from shapely.geometry import Polygon
from shapely.geometry.base import BaseGeometry

from veduta.plan.house.lines import WallLine
from veduta.plan.house.space import Space, pieces_of


def wall_regions(space: Space) -> dict[str, BaseGeometry]:
    """What of the walls' footprint each wall has, by their ids: nothing twice, nothing left."""
    regions: dict[str, BaseGeometry] = {}
    strips = [line.strip for line in space.lines.values()]
    tree = STRtree(strips)
    # Each without those before it that it meets: all walls at once are much to cut again for each.
    for place, name in enumerate(space.lines):
        met = [strips[one] for one in tree.query(strips[place]) if one < place]
        regions[name] = strips[place].intersection(space.walls).difference(unary_union(met))
    for wedge in pieces_of(space.walls.difference(unary_union(strips))):
        nearest = min(regions, key=lambda name: _distance(space.lines[name], wedge))
        regions[nearest] = regions[nearest].union(wedge)
    return regions


def _distance(line: WallLine, wedge: Polygon) -> float:
    return float(line.strip.distance(wedge.centroid))
