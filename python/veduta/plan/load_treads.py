"""Treads of stairs that turn, in an edited document: whether one can walk them.

Each is an outline of its own; the walking line leads over them from the lowest up.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from shapely import STRtree
from shapely.geometry import LineString, Point, Polygon
from shapely.geometry.base import BaseGeometry

from veduta.plan.document import Stairs

MAX_CORNERS = 64
"""Of a tread: each edge is compared with all corners."""
LEAST_GOING_M = 0.02
_OVERLAP = 0.05
"""Treads cover at most this share of each other: outlines from a sheet are not exact."""
_BESIDE_M = 0.1
"""An end of the walking line is so near to the edge of its tread."""


def walk_faults(flight: Stairs, place: str) -> list[str]:
    """Treads that lie on each other, or that the walking line does not pass in their order.

    Each outline is valid; the line has a length.
    """
    steps = [Polygon(ring) for ring in flight.steps_m]
    path = LineString(flight.path_m)
    found = _overlaps(steps, place)
    on = [path.intersection(step) for step in steps]
    for index, part in enumerate(on):
        if part.length < LEAST_GOING_M:
            return [*found, f"{place}.path_m: does not lead over steps_m[{index}]"]
    middles = [_middle(part, path) for part in on]
    for index, (here, there) in enumerate(pairwise(middles)):
        if there <= here:
            found.append(
                f"{place}.path_m: comes to steps_m[{index + 1}] before steps_m[{index}];"
                " both go from the lowest tread up"
            )
            return found
    for at, index, end in (
        (path.coords[0], 0, "begins"),
        (path.coords[-1], len(steps) - 1, "ends"),
    ):
        away = steps[index].exterior.distance(Point(at))
        if away > _BESIDE_M:
            found.append(
                f"{place}.path_m: {end} {away:.2f} m from the edge of steps_m[{index}],"
                f" not within {_BESIDE_M:g} m of it"
            )
    return found


def _overlaps(steps: list[Polygon], place: str) -> list[str]:
    found = []
    for first, second in sorted(STRtree(steps).query(steps, "intersects").T.tolist()):
        shared = steps[first].intersection(steps[second]).area if first < second else 0.0
        if shared > _OVERLAP * min(steps[first].area, steps[second].area):
            found.append(
                f"{place}.steps_m[{second}]: {shared:.2f} m² of it lie on steps_m[{first}]"
            )
    return found


def _middle(part: BaseGeometry, path: LineString) -> float:
    """How far along a line the middle of a part of it is (m)."""
    pieces = [piece for piece in getattr(part, "geoms", [part]) if piece.length > 0.0]
    places = [path.project(piece.interpolate(0.5, normalized=True)) for piece in pieces]
    return float(np.average(places, weights=[piece.length for piece in pieces]))
