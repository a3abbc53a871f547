"""Lamps on the walls of a room.

AV3D (Placement of Light Sources): of all walls, those parts can have a lamp that no door, window or
high object takes; the number of lamps is the length of all walls by the longest piece that a lamp
lights. From the door on, lamps are placed at equal distances; where one would lie on a part that
cannot have it, it goes to the beginning of the next part that can. Added: what they leave dark gets
further lamps on the same walls.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import line_merge
from shapely.geometry import LineString, MultiLineString, Point, Polygon
from shapely.geometry.base import BaseGeometry
from shapely.geometry.polygon import orient

from veduta.plan.lights.sight import Field, filled_up

FROM_WALL_M = 0.08
"""From the wall to where the lamp shines from."""
_HALF_M = 0.12
"""Half of what a lamp takes of a wall."""
_SITE_M = 0.25


@dataclass(frozen=True)
class Stretch:
    """A part of a room's outline on which a lamp can hang, by distances along it (m)."""

    start_m: float
    end_m: float


@dataclass(frozen=True, eq=False)
class Outline:
    """The walls of a room, counter-clockwise from its door on, and where lamps can hang on them."""

    line: LineString
    stretches: tuple[Stretch, ...]

    def lamp(self, along_m: float) -> NDArray[np.float64]:
        """(2,) where a lamp shines from, a little before the wall (which is to the right)."""
        here = self.line.interpolate(along_m)
        step = 1e-3
        before = self.line.interpolate(max(along_m - step, 0.0))
        after = self.line.interpolate(min(along_m + step, self.line.length))
        way = np.array([after.x - before.x, after.y - before.y])
        way = way / max(float(np.hypot(*way)), 1e-12)
        inwards = np.array([-way[1], way[0]])
        return np.array([here.x, here.y]) + FROM_WALL_M * inwards


def wall_lamps(
    region: Polygon, outline: Outline, spacing_m: float, reach_m: float, least: int = 1
) -> NDArray[np.float64]:
    """(k, 2) where lamps hang; none where no wall can have one."""
    if not outline.stretches:
        return np.zeros((0, 2))
    count = max(least, math.ceil(outline.line.length / spacing_m - 1e-9))
    placed = [outline.lamp(along) for along in spread(outline, count)]
    field = Field(region)
    sites = np.array([outline.lamp(along) for along in _sites(outline)])
    kept = sites[shapely.covers(region, shapely.points(sites))]
    return filled_up(field, np.array(placed), kept if len(kept) else sites, reach_m)


def outline_of(region: Polygon, usable: BaseGeometry, door: Point | None) -> Outline:
    """The outline of a room from its door on. usable: a region with all that a lamp can hang on."""
    ring = LineString(orient(region).exterior.coords)
    if door is not None:
        ring = _from(ring, ring.project(door))
    free = ring.intersection(usable)
    free = line_merge(free) if isinstance(free, MultiLineString) else free
    ends = []
    for piece in getattr(free, "geoms", [free]):
        if isinstance(piece, LineString) and not piece.is_empty:
            first, last = (ring.project(Point(piece.coords[end])) for end in (0, -1))
            ends.append((first, last))
    return Outline(ring, tuple(_usable(ends, ring)))


def _from(ring: LineString, start_m: float) -> LineString:
    """A closed line that begins elsewhere."""
    corners = np.array(ring.coords)[:-1]
    along = np.array([ring.project(Point(at)) for at in corners])
    first = int(np.searchsorted(along, start_m))
    begin = np.array(ring.interpolate(start_m).coords)
    return LineString(np.concatenate([begin, corners[first:], corners[:first], begin]))


def _usable(ends: list[tuple[float, float]], ring: LineString) -> list[Stretch]:
    """The straight walls of the free parts, less what a lamp takes at their ends."""
    corners = sorted({ring.project(Point(at)) for at in ring.coords[:-1]} | {ring.length})
    found = []
    for start, end in sorted(ends):
        stop = ring.length if end <= start else end
        cuts = [start, *(corner for corner in corners if start < corner < stop), stop]
        for first, last in zip(cuts[:-1], cuts[1:], strict=True):
            if last - first > 2.0 * _HALF_M:
                found.append(Stretch(first + _HALF_M, last - _HALF_M))
    return found


def spread(outline: Outline, count: int) -> list[float]:
    """Where lamps hang, by distances along the outline: at equal distances, jumping on."""
    spacing = outline.line.length / count
    along: list[float] = []
    wanted = spacing / 2.0
    while len(along) < count and wanted < outline.line.length:
        here = _next(outline, wanted)
        if here is None:
            break
        along.append(here)
        wanted = max(here, wanted) + spacing
    if not along:  # all that can have a lamp lies before the first place that was asked for
        along.append(outline.stretches[-1].end_m)
    return along


def _next(outline: Outline, wanted_m: float) -> float | None:
    """The first place from there on at which a lamp can hang."""
    for stretch in outline.stretches:
        if wanted_m <= stretch.end_m:
            return max(wanted_m, stretch.start_m)
    return None


def _sites(outline: Outline) -> list[float]:
    return [
        along
        for stretch in outline.stretches
        for along in np.arange(stretch.start_m, stretch.end_m + 1e-9, _SITE_M)
    ]
