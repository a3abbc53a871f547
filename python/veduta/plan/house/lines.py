"""Centre lines of walls, straight and curved, and the strips that walls and openings cover.

Plan frame (m). Left and right are those of who goes along the wall.
"""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from shapely.geometry import LineString, Polygon
from shapely.geometry.base import BaseGeometry
from shapely.ops import substring, unary_union

from veduta.geometry.arcs import arc_points
from veduta.plan.document import Storey, Wall

MITRE_LIMIT = 4.0
"""A mitred corner reaches at most this many half thicknesses beyond its junction."""


@dataclass(frozen=True)
class WallLine:
    """A wall with its centre line. points_m: (n, 2)."""

    wall: Wall
    points_m: NDArray[np.float64]

    @property
    def half_m(self) -> float:
        """Half of the thickness."""
        return self.wall.thickness_m / 2.0

    @cached_property
    def line(self) -> LineString:
        """The centre line."""
        return LineString(self.points_m)

    @cached_property
    def strip(self) -> Polygon:
        """What the wall covers between its junctions, ends square."""
        return self.line.buffer(self.half_m, cap_style="flat", join_style="mitre")

    def piece(self, start_m: float, end_m: float, half_m: float) -> Polygon:
        """The strip from one distance along the wall to another, of a half width of its own."""
        part = substring(self.line, start_m, end_m)
        return part.buffer(half_m, cap_style="flat", join_style="mitre")

    def at(self, along_m: float) -> NDArray[np.float64]:
        """(2,) the point at a distance along the wall."""
        return np.array(self.line.interpolate(along_m).coords[0])


def wall_lines(storey: Storey) -> dict[str, WallLine]:
    """The walls of a storey by their ids."""
    at = {junction.id: junction.at_m for junction in storey.junctions}
    return {
        wall.id: WallLine(wall, arc_points(at[wall.start], at[wall.end], wall.bulge))
        for wall in storey.walls
    }


def footprint(lines: Iterable[WallLine]) -> BaseGeometry:
    """What all walls cover together: their strips, mitred where they meet.

    The result may be several polygons (a MultiPolygon).
    """
    lines = list(lines)
    return unary_union([line.strip for line in lines] + _corners(lines))


def _corners(lines: list[WallLine]) -> list[Polygon]:
    """The wedges that square ends leave open on the outside of corners."""
    ends: dict[str, list[tuple[float, NDArray[np.float64], float]]] = defaultdict(list)
    centre: dict[str, NDArray[np.float64]] = {}
    for line in lines:
        points = line.points_m
        for junction, here, there in (
            (line.wall.start, points[0], points[1]),
            (line.wall.end, points[-1], points[-2]),
        ):
            way = (there - here) / np.linalg.norm(there - here)
            ends[junction].append((math.atan2(way[1], way[0]), way, line.half_m))
            centre[junction] = here
    return [wedge for junction, ways in ends.items() for wedge in _wedges(centre[junction], ways)]


def _wedges(
    centre: NDArray[np.float64], ways: list[tuple[float, NDArray[np.float64], float]]
) -> list[Polygon]:
    """Between neighbours more than half a turn apart: there is at most one such gap."""
    ways = sorted(ways, key=lambda way: way[0])
    found = []
    for (angle, way, half), (after, next_way, next_half) in zip(
        ways, [*ways[1:], ways[0]], strict=True
    ):
        gap = (after - angle) % (2.0 * math.pi)
        if len(ways) < 2 or gap <= math.pi + 1e-6:
            continue
        left = centre + half * np.array([-way[1], way[0]])
        right = centre + next_half * np.array([next_way[1], -next_way[0]])
        tip = _meet(left, way, right, next_way)
        limit = MITRE_LIMIT * max(half, next_half)
        corners = [centre, left, right]
        if tip is not None and np.linalg.norm(tip - centre) <= limit:
            corners = [centre, left, tip, right]
        wedge = Polygon(corners)
        if wedge.is_valid and wedge.area > 1e-9:
            found.append(wedge)
    return found


def _meet(
    first: NDArray[np.float64],
    way: NDArray[np.float64],
    second: NDArray[np.float64],
    other: NDArray[np.float64],
) -> NDArray[np.float64] | None:
    """Where two lines cross; None where they are parallel."""
    across = way[0] * other[1] - way[1] * other[0]
    if abs(across) < 1e-6:
        return None
    gap = second - first
    along = (gap[0] * other[1] - gap[1] * other[0]) / across
    crossing: NDArray[np.float64] = first + along * way
    return crossing
