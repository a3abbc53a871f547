"""The ground around a house: which area is of what, and how high it lies.

AV3D, Surrounding Environment Creation: polygons of land with a material each, and a slope of all of
them. The house and a strip around it stand level; in front of it the ground falls, behind it rises.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely.geometry import Point, Polygon, box
from shapely.geometry.base import BaseGeometry
from shapely.ops import unary_union

from veduta.plan.house.hole import Hole
from veduta.plan.house.party import Party, own_side, parties_of
from veduta.plan.house.space import Space, pieces_of, solid_region

Ground = Literal["lawn", "path", "drive", "gravel"]
MARGIN_M = 11.5
"""From the house to the end of its plot."""
LEVEL_M = 6.2
"""So far around the house the ground is level: the tour goes around it there."""
GRAVEL_M = 0.5
"""A strip of gravel along the walls, where it drips from the eaves."""
PATH_M, DRIVE_M = 1.4, 3.0
_UNDER_M = 0.1
"""The ground reaches under the house by so much."""
_FAR_M = 200.0
_GRID_M = 1e-3
"""Corners of areas lie on a grid: what is finer crosses itself in single precision."""


@dataclass(frozen=True, eq=False)
class Terrain:
    """The plot of a house (frame of the place, m).

    areas: regions that cover the plot but for the house, each once. taken: all that is no lawn,
    and the house. downhill: (2,) unit vector. slope: metres of fall in a metre. ends_m: where along
    that vector the level strip begins and ends.
    """

    areas: tuple[tuple[Ground, BaseGeometry], ...]
    plot: Polygon
    house: BaseGeometry
    taken: BaseGeometry
    downhill: NDArray[np.float64]
    slope: float
    ends_m: tuple[float, float]

    def height(self, points_m: NDArray[np.float64]) -> NDArray[np.float64]:
        """(n,) how high the ground lies at (n, 2) points: 0 beside the house."""
        along = points_m @ self.downhill
        first, last = self.ends_m
        beyond = np.maximum(along - last, 0.0) - np.maximum(first - along, 0.0)
        height: NDArray[np.float64] = -self.slope * beyond
        return height

    def flat_pieces(self, region: BaseGeometry) -> list[Polygon]:
        """A region cut where the slope begins and ends: each piece lies in one plane."""
        if self.slope == 0.0:
            return pieces_of(region)
        way, side = self.downhill, np.array([-self.downhill[1], self.downhill[0]])
        first, last = self.ends_m
        found = []
        if region.is_empty:
            return []
        left, bottom, right, top = region.bounds
        corners_m = np.array([(left, bottom), (right, bottom), (right, top), (left, top)])
        low, high = (corners_m @ way).min() - 1.0, (corners_m @ way).max() + 1.0
        near, far = (corners_m @ side).min() - 1.0, (corners_m @ side).max() + 1.0
        for start, end in ((min(low, first), first), (first, last), (last, max(high, last))):
            corners = [a * way + b * side for a, b in (
                (start, near), (end, near), (end, far), (start, far)
            )]  # fmt: skip
            found += pieces_of(region.intersection(Polygon(corners)))
        return found


def terrain_of(space: Space, slope_deg: float) -> Terrain:
    """The plot around a storey; paths lead to its doors, a drive to its garage."""
    house = space.slab
    plot = own_plot(house, parties_of(space))
    ways = ways_in(space)
    inner = house.buffer(-_UNDER_M, join_style="mitre")
    gravel = house.buffer(GRAVEL_M, join_style="mitre")
    front = ways[0][1] if ways else np.array([0.0, -1.0])
    paths = [_strip(hole, out, house, plot) for hole, out in ways]
    drives = [shape for shape, (hole, _) in zip(paths, ways, strict=True) if _is_garage(hole)]
    walks = [shape for shape, (hole, _) in zip(paths, ways, strict=True) if not _is_garage(hole)]
    areas: list[tuple[Ground, BaseGeometry]] = []
    free: BaseGeometry = plot.difference(inner)
    layers: Sequence[tuple[Ground, BaseGeometry]] = (
        ("drive", unary_union(drives)), ("path", unary_union(walks)), ("gravel", gravel),
        ("lawn", plot),
    )  # fmt: skip
    for kind, shape in layers:
        own = solid_region(shapely.set_precision(free.intersection(shape), _GRID_M))
        free = free.difference(shape)
        if not own.is_empty:
            areas.append((kind, own))
    corners = np.array(house.convex_hull.boundary.coords) @ front
    return Terrain(
        areas=tuple(areas),
        plot=plot,
        house=house,
        taken=unary_union([gravel, *paths]),
        downhill=front,
        slope=math.tan(math.radians(slope_deg)),
        ends_m=(float(corners.min()) - LEVEL_M, float(corners.max()) + LEVEL_M),
    )


def own_plot(house: BaseGeometry, parties: Sequence[Party]) -> Polygon:
    """The ground around a house, up to its neighbours'; all around where they leave none, as those
    at two party walls that face each other over a court.
    """
    left, bottom, right, top = house.bounds
    whole = box(left - MARGIN_M, bottom - MARGIN_M, right + MARGIN_M, top + MARGIN_M)
    pieces = pieces_of(own_side(whole, parties))
    return max(pieces, key=lambda piece: piece.area, default=whole)


def ways_in(space: Space) -> list[tuple[Hole, NDArray[np.float64]]]:
    """Doors to the outside with the way out of each, (2,); the surest house door first."""
    found = []
    for hole in space.holes:
        out = outwards(hole, space)
        if hole.opening.kind == "door" and hole.reaches_floor and out is not None:
            found.append((hole, out))
    return sorted(found, key=lambda way: (_is_garage(way[0]), -way[0].opening.score))


def outwards(hole: Hole, space: Space) -> NDArray[np.float64] | None:
    """(2,) the way out through an opening; None where both sides are in the house, or none is."""
    middle, left = hole.middle, hole.leftward
    step = hole.line.half_m + 0.1
    inside = [space.slab.covers(Point(middle + side * step * left)) for side in (1.0, -1.0)]
    if inside[0] == inside[1]:
        return None
    return -left if inside[0] else left


def _strip(
    hole: Hole, out: NDArray[np.float64], house: BaseGeometry, plot: Polygon
) -> BaseGeometry:
    """A way from a door straight out to the end of the plot; up to a wing that is in its way."""
    width = DRIVE_M if _is_garage(hole) else PATH_M
    half = max(width, hole.width_m + 0.3) / 2.0
    middle = hole.middle
    corners = [
        middle - half * hole.along, middle + half * hole.along,
        middle + half * hole.along + _FAR_M * out, middle - half * hole.along + _FAR_M * out,
    ]  # fmt: skip
    free = Polygon(corners).intersection(plot).difference(house)
    near = [piece for piece in pieces_of(free) if piece.distance(Point(middle)) < 1.0]
    return unary_union(near)


def _is_garage(hole: Hole) -> bool:
    return hole.opening.type == "garage"
