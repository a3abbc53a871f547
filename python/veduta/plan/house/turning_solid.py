"""Stairs that turn as solids: one closed body of steps, and rails where no wall stands.

The body is stepped above and below: no plan shows an underside, and under treads that fan a smooth
one would be a warped surface. Heights and rails are invented, as those of straight flights.
"""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from shapely.geometry import LineString, MultiPoint, Point, Polygon

from veduta.plan.house.frame import Sculptor, Surface, level, upright
from veduta.plan.house.rails import (
    RAIL_M,
    RAIL_SIDE_M,
    Edge,
    add_bar,
    is_free,
    rail_surface,
    smooth_runs,
)
from veduta.plan.house.space import Space
from veduta.plan.house.turning import Corner, TurningFlight

WAIST_M = 0.12
"""Between the top of a step and the underside of the next."""
_BARS_M = 0.28
"""Between two bars of a handrail: about one on each tread."""
_INSET_M = 0.03
_JOINT_M = 5e-4
"""Pieces of a rail do not touch: each is closed by itself."""
_LEAST_RAIL_M = 0.5
_COLUMN_M = 0.4
_COLUMN_SIDE_M = 0.15
_COLUMN_CORNERS = 8
_SAME_M = 5e-3


def add_turning(
    flight: TurningFlight, lower: Space, steps: Surface, body: Surface, sculptor: Sculptor
) -> None:
    """The steps as one closed solid: what lies between two of them has no faces."""
    frame = level(lower.storey.elevation_m)
    spans = _spans(flight)
    heights = _heights_at(flight, spans)
    for ring, (low, high) in zip(flight.rings, spans, strict=True):
        sculptor.face([_flat(ring, high)], frame, steps)
        sculptor.face([_flat(ring[::-1], low)], frame, body)
    for (here, there), number in flight.owners.items():
        beside = flight.owners.get((there, here))
        for low, high in _bare(spans[number], None if beside is None else spans[beside]):
            face = [
                (*here, low),
                *((*there, z) for z in _between(heights[there], low, high)),
                *((*here, z) for z in _between(heights[here], low, high)[:0:-1]),
            ]
            sculptor.face([np.array(face)], frame, body)


def add_turning_rails(flight: TurningFlight, lower: Space, sculptor: Sculptor) -> None:
    """Along each side without a wall: a rail at an even pitch, on bars from the treads."""
    sides = [
        (edge, number) for edge, number in flight.owners.items() if _is_side(edge, number, flight)
    ]
    for count, run in enumerate(smooth_runs([edge for edge, _ in sides]), start=1):
        edges = [sides[one] for one in run]
        line = LineString([edges[0][0][0], *(edge[1] for edge, _ in edges)])
        if line.length < _LEAST_RAIL_M or not is_free(line, lower.walls):
            continue
        name = f"{lower.storey.name} stairs {flight.id} side {count} rail"
        surface = rail_surface(sculptor, name)
        for edge, number in edges:
            ends = [_rail_height(at, number, flight) for at in edge]
            tread = (number + 1) * flight.riser_m
            _add_rail(LineString(edge), ends, tread, lower, surface, sculptor)


def add_column(flight: TurningFlight, lower: Space, sculptor: Sculptor) -> None:
    """The column of a spiral: what its treads leave free in the middle."""
    inner = [
        corner
        for edge, number in flight.owners.items()
        if _is_side(edge, number, flight) and math.dist(*edge) < _COLUMN_SIDE_M
        for corner in edge
    ]
    hull = MultiPoint(inner).convex_hull
    if len(inner) < _COLUMN_CORNERS or not isinstance(hull, Polygon):
        return
    if math.sqrt(hull.area) > _COLUMN_M or any(
        hull.buffer(-_SAME_M).intersects(one) for one in flight.steps
    ):
        return
    surface = rail_surface(sculptor, f"{lower.storey.name} stairs {flight.id} column")
    top = flight.rise_m + RAIL_M
    sculptor.prism(hull, 0.0, top, level(lower.storey.elevation_m), surface)


def _spans(flight: TurningFlight) -> list[tuple[float, float]]:
    """The underside and the top of each tread above the lower floor."""
    tops = [(number + 1) * flight.riser_m for number in range(flight.treads)]
    return [(max(0.0, top - flight.riser_m - WAIST_M), top) for top in tops]


def _heights_at(
    flight: TurningFlight, spans: list[tuple[float, float]]
) -> dict[Corner, list[float]]:
    """Where faces end on the upright line through each corner."""
    found: dict[Corner, set[float]] = {}
    for ring, span in zip(flight.rings, spans, strict=True):
        for corner in ring:
            found.setdefault(corner, set()).update(span)
    return {corner: sorted(heights) for corner, heights in found.items()}


def _bare(
    own: tuple[float, float], beside: tuple[float, float] | None
) -> list[tuple[float, float]]:
    """The parts of a span that the tread beside it does not cover."""
    if beside is None or beside[0] >= own[1] or beside[1] <= own[0]:
        return [own]
    parts = [(own[0], min(own[1], beside[0])), (max(own[0], beside[1]), own[1])]
    return [(low, high) for low, high in parts if high > low]


def _between(heights: list[float], low: float, high: float) -> list[float]:
    return [one for one in heights if low <= one <= high]


def _flat(ring: tuple[Corner, ...], height_m: float) -> NDArray[np.float64]:
    return np.array([(*corner, height_m) for corner in ring])


def _is_side(edge: Edge, number: int, flight: TurningFlight) -> bool:
    """Whether one could fall over it: no tread follows there, and it is neither foot nor head."""
    beside = flight.owners.get((edge[1], edge[0]))
    if beside is not None and (abs(beside - number) == 1 or beside > number):
        return False
    line = LineString(edge)
    ends = [flight.foot] if number == 0 else []
    ends += [flight.arrival] if number == flight.treads - 1 else []
    return not any(one.buffer(_SAME_M).covers(line) for one in ends)


def _rail_height(corner: Corner, number: int, flight: TurningFlight) -> float:
    """Over the lower floor: a rail's height over the nosing where a tread begins, and so on."""
    first, last = flight.starts_m[number : number + 2]
    along = LineString(flight.path_m).project(Point(*corner))
    share = float(np.clip((along - first) / max(last - first, 1e-9), 0.0, 1.0))
    before = flight.rings[number - 1] if number > 0 else flight.foot.coords
    after = flight.rings[number + 1] if number + 1 < flight.treads else flight.arrival.coords
    if _is_corner(corner, after):
        share = 1.0
    elif _is_corner(corner, before):
        share = 0.0
    return RAIL_M + (number + 1 + share) * flight.riser_m


def _is_corner(corner: Corner, ring: object) -> bool:
    places = np.asarray(ring, dtype=float)
    return bool((np.hypot(*(places - np.array(corner)).T) < _SAME_M).any())


def _add_rail(
    edge: LineString,
    ends: list[float],
    tread_m: float,
    lower: Space,
    surface: Surface,
    sculptor: Sculptor,
) -> None:
    here, there = np.array(edge.coords)
    frame = upright(here, (there - here) / edge.length, lower.storey.elevation_m)
    # Treads lie on the left of their edges, the frame's third axis is to the right.
    first, last = _JOINT_M, edge.length - _JOINT_M
    rail = Polygon(
        [(first, ends[0]), (last, ends[1]), (last, ends[1] + 0.05), (first, ends[0] + 0.05)]
    )
    sculptor.prism(rail, -_INSET_M - RAIL_SIDE_M, -_INSET_M, frame, surface)
    count = max(1, round(edge.length / _BARS_M))
    places = np.linspace(0.0, edge.length, count + 1)
    for first, last in pairwise(places):
        at = float(first + last) / 2.0
        head = float(np.interp(at, [0.0, edge.length], ends))
        add_bar(at, (tread_m, head), -_INSET_M - RAIL_SIDE_M / 2.0, frame, surface, sculptor)
