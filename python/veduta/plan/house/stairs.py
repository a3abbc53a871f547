"""Flights as solids: steps with a sloping underside, handrails, and a rail around the well.

No plan shows a height: the place of a flight is drawn, its steps follow from the storey's height,
and rails are invented.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from shapely.geometry import LineString, Polygon
from shapely.geometry.base import BaseGeometry
from shapely.ops import unary_union

from veduta.place.semantics import Provenance, SemanticClass
from veduta.plan.house.flights import Flight, Stairwell
from veduta.plan.house.frame import Sculptor, Surface, upright
from veduta.plan.house.rails import (
    RAIL_M,
    RAIL_SIDE_M,
    Edge,
    add_bar,
    is_free,
    rail_surface,
    smooth_runs,
)
from veduta.plan.house.space import Space, pieces_of
from veduta.plan.house.turning import TurningFlight
from veduta.plan.house.turning_solid import add_column, add_turning, add_turning_rails

_POST_M = 0.035
_BARS_M = 0.12
"""No ball of that size passes between two bars."""
_LEAST_GUARD_M = 0.3
_LEAST_M = 1e-3
_AT_HEAD_M = 0.05
_WAIST = 1.2
"""The underside lies so many treads behind the steps."""


def add_stairs(well: Stairwell, lower: Space, upper: Space, sculptor: Sculptor) -> None:
    """All flights from one storey up, and the rail around their well."""
    for flight in well.flights:
        builder = sculptor.builder
        shell = builder.new_shell()
        known = Provenance.INFERRED if flight.way_known else Provenance.INVENTED
        name = f"{lower.storey.name} stairs {flight.id}"
        steps = builder.feature(SemanticClass.FLOOR, known, name, shell=shell)
        body = builder.feature(SemanticClass.OTHER, known, f"{name} body", shell=shell)
        tread, white = Surface(steps, "wood floor"), Surface(body, "skirting")
        if isinstance(flight, TurningFlight):
            add_turning(flight, lower, tread, white, sculptor)
            add_turning_rails(flight, lower, sculptor)
            add_column(flight, lower, sculptor)
        else:
            _add_flight(flight, lower, tread, white, sculptor)
            _add_handrails(flight, lower, sculptor)
    _add_guard(well, upper, sculptor)


def _add_flight(
    flight: Flight, lower: Space, tread: Surface, white: Surface, sculptor: Sculptor
) -> None:
    frame = upright(flight.foot, flight.along, lower.storey.elevation_m)
    ring = _profile(flight)
    for height, turned in ((flight.width_m, ring), (0.0, ring[::-1])):
        sculptor.face([_lifted(turned, height)], frame, white)
    for here, there in zip(ring, np.roll(ring, -1, axis=0), strict=True):
        # Counter-clockwise, what one treads on runs against the first axis, level.
        level = abs(here[1] - there[1]) < 1e-9 and there[0] < here[0]
        ends = np.stack([here, there])
        face = np.concatenate([_lifted(ends, 0.0), _lifted(ends[::-1], flight.width_m)])
        sculptor.face([face], frame, tread if level else white)


def _profile(flight: Flight) -> NDArray[np.float64]:
    """(n, 2): along the flight and up, counter-clockwise."""
    going, riser, count = flight.going_m, flight.riser_m, flight.treads
    back = _WAIST * going
    under = [(0.0, 0.0)]
    if count > _WAIST:
        under += [(back, 0.0), (flight.run_m, (count - _WAIST) * riser)]
    else:
        under += [(flight.run_m, 0.0)]
    steps = [
        point
        for number in range(count, 0, -1)
        for point in ((number * going, number * riser), ((number - 1) * going, number * riser))
    ]
    return np.array([*under, *steps])


def _add_handrails(flight: Flight, lower: Space, sculptor: Sculptor) -> None:
    """On the sides without a wall: a rail along the pitch, on a bar from each tread."""
    frame = upright(flight.foot, flight.along, lower.storey.elevation_m)
    side = flight.right * flight.width_m
    sides = {"left": (flight.foot, 0.0), "right": (flight.foot + side, flight.width_m)}
    for name, (start, offset) in sides.items():
        edge = LineString([start, start + flight.run_m * flight.along])
        if not is_free(edge, lower.walls):
            continue
        surface = rail_surface(sculptor, f"{lower.storey.name} stairs {flight.id} {name} rail")
        near = offset + (0.03 if offset == 0.0 else -0.03 - RAIL_SIDE_M)
        third = (near, near + RAIL_SIDE_M)
        low = RAIL_M + flight.riser_m
        high = low + flight.riser_m / flight.going_m * flight.run_m
        rail = Polygon(
            [(0, low), (flight.run_m, high), (flight.run_m, high + 0.05), (0, low + 0.05)]
        )
        sculptor.prism(rail, *third, frame, surface)
        middle = near + RAIL_SIDE_M / 2
        for number in range(flight.treads):
            at = (number + 0.5) * flight.going_m
            foot, head = (number + 1) * flight.riser_m, low + (number + 0.5) * flight.riser_m
            add_bar(at, (foot, head), middle, frame, surface, sculptor)


def _add_guard(well: Stairwell, upper: Space, sculptor: Sculptor) -> None:
    """A rail around the opening, but where walls stand and where one arrives."""
    number = 0
    arrivals = unary_union([one.arrival.buffer(_AT_HEAD_M) for one in well.flights])
    for piece in pieces_of(well.opening):
        edges: list[Edge] = [
            (_corner(part.coords[0]), _corner(part.coords[-1]))
            for edge in pairwise(piece.exterior.coords)
            for part in _lines(LineString(edge).difference(arrivals))
        ]
        for run in smooth_runs(edges):
            line = LineString([edges[run[0]][0], *(edges[one][1] for one in run)])
            if line.length < _LEAST_GUARD_M or not is_free(line, upper.walls):
                continue
            number += 1
            surface = rail_surface(sculptor, f"{upper.storey.name} stairwell rail {number}")
            for here, there in pairwise(np.array(line.coords)):
                _guard(here, there, upper, surface, sculptor)


def _corner(at: Sequence[float]) -> tuple[float, float]:
    return float(at[0]), float(at[1])


def _lines(shape: BaseGeometry) -> list[LineString]:
    parts = getattr(shape, "geoms", [shape])
    return [part for part in parts if isinstance(part, LineString) and part.length > _LEAST_M]


def _guard(
    here: NDArray[np.float64],
    there: NDArray[np.float64],
    upper: Space,
    surface: Surface,
    sculptor: Sculptor,
) -> None:
    """From one corner of the well to the next, a hand's breadth away from its edge."""
    length = float(np.hypot(*(there - here)))
    along = (there - here) / length
    frame = upright(here, along, upper.storey.elevation_m)
    # The well lies to the right of its exterior, which runs clockwise, or else to the left.
    middle = (here + there) / 2 + 0.05 * np.array([along[1], -along[0]])
    offset = 0.05 if upper.slab.contains(_point(middle)) else -0.05
    half = RAIL_SIDE_M / 2
    sculptor.slab(
        (0.0, length), (RAIL_M, RAIL_M + 0.05), (offset - half, offset + half), frame, surface
    )
    count = max(1, math.ceil(length / _BARS_M))
    inset = min(_POST_M, length / 4.0)
    for at in np.linspace(inset, length - inset, count + 1):
        add_bar(float(at), (0.0, RAIL_M), offset, frame, surface, sculptor)


def _point(at: NDArray[np.float64]) -> BaseGeometry:
    return LineString([at, at + 1e-4])


def _lifted(ring: NDArray[np.float64], height_m: float) -> NDArray[np.float64]:
    return np.concatenate([ring, np.full((len(ring), 1), height_m)], axis=1)
