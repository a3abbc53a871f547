"""Flights of stairs between storeys: where they run, and the wells that they need.

A flight that is drawn in a storey leads to the next one. Where only the storey above shows it, it
comes up from below. The well above a flight is as long as a head needs it (`headroom`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from shapely.geometry import LineString, Polygon
from shapely.geometry.base import BaseGeometry
from shapely.ops import unary_union

from veduta.plan.document import Stairs, Storey
from veduta.plan.house.headroom import first_in_well
from veduta.plan.house.shown_twice import going_on, shown_twice
from veduta.plan.house.space import Space, solid_region, space_of
from veduta.plan.house.turning import TurningFlight, turning_flight

STEEP_M = 0.22
"""Higher steps are told: the drawing may show a part of the flight only."""
LEAST_RUN_M = 0.6
_SIDE_M = 0.005
"""Between a flight and the walls on its sides."""
_AHEAD_M = 0.4
_BETWEEN_M = 0.15


@dataclass(frozen=True)
class Flight:
    """A straight flight. `foot` (2,) is the left end of its lowest edge for who goes up.

    `along` (2,) is the way up; `rise_m` from floor to floor, of which each of the `treads` and the
    upper floor take a part.
    """

    id: str
    foot: NDArray[np.float64]
    along: NDArray[np.float64]
    run_m: float
    width_m: float
    treads: int
    rise_m: float
    way_known: bool

    @property
    def riser_m(self) -> float:
        """Height of a step."""
        return self.rise_m / (self.treads + 1)

    @property
    def going_m(self) -> float:
        """Depth of a tread."""
        return self.run_m / self.treads

    @property
    def right(self) -> NDArray[np.float64]:
        """(2,) unit vector to the right of who goes up."""
        return np.array([self.along[1], -self.along[0]])

    def piece(self, start_m: float, end_m: float) -> Polygon:
        """What lies between two distances from the foot."""
        side = self.right * self.width_m
        first, last = self.foot + start_m * self.along, self.foot + end_m * self.along
        return Polygon([first, last, last + side, first + side])

    @cached_property
    def outline(self) -> Polygon:
        """All that it stands over."""
        return self.piece(0.0, self.run_m)

    def well(self, slab_m: float) -> Polygon:
        """Where the slab above would be nearer to a tread than a head is high."""
        first = first_in_well(self.rise_m, self.riser_m, self.treads, slab_m)
        return self.piece(first * self.going_m, self.run_m)

    @property
    def arrival(self) -> LineString:
        """The edge at which one steps onto the upper floor."""
        end = self.foot + self.run_m * self.along
        return LineString([end, end + self.right * self.width_m])


AnyFlight = Flight | TurningFlight


@dataclass(frozen=True)
class Stairwell:
    """The flights from a storey up, the opening in the slab above, and what is to be said.

    Rooms of the storey above that are open to below are in the opening, too.
    """

    flights: tuple[AnyFlight, ...] = ()
    opening: BaseGeometry = field(default_factory=Polygon)
    notes: tuple[str, ...] = ()


def storey_spaces(
    storeys: Sequence[Storey], slab_m: float
) -> tuple[tuple[Space, ...], list[Stairwell]]:
    """The storeys' regions from the lowest up, without the floors over their stairs; the stairs."""
    found = [space_of(storey, storey.height_m - slab_m) for storey in storeys]
    wells = stairwells(found, slab_m)
    openings = [Polygon(), *(well.opening for well in wells[:-1])]
    spaces = (replace(space, well=opening) for space, opening in zip(found, openings, strict=True))
    return tuple(spaces), wells


def stairwells(spaces: Sequence[Space], slab_m: float) -> list[Stairwell]:
    """For each storey from the lowest up; nothing leads up from the highest."""
    found = []
    below: Sequence[Stairs] = ()
    for lower, upper in zip(spaces, spaces[1:], strict=False):
        own = going_on(below, lower.storey.stairs, upper.storey.stairs)
        found.append(_stairwell(lower, upper, own, slab_m))
        below = lower.storey.stairs
    return [*found, Stairwell()]


def _stairwell(lower: Space, upper: Space, own: Sequence[Stairs], slab_m: float) -> Stairwell:
    """own: the stairs of the lower storey that lead up from there."""
    both, notes = shown_twice(own, upper.storey.stairs)
    drawn = both or [*upper.storey.stairs]
    rise = upper.storey.elevation_m - lower.storey.elevation_m
    flights: list[AnyFlight] = []
    for one in drawn:
        flight = turning_flight(one, rise) if one.steps_m else _flight(one, lower, rise)
        if flight is None:
            where = f"stairs {one.id} of {(lower if own else upper).storey.name}"
            notes.append(f"{where} are left out: they are too small to walk on")
            continue
        flights.append(flight)
        notes += _told(flight, lower, upper, bool(own))
    walls = unary_union([lower.walls, upper.walls])
    wells = unary_union([flight.well(slab_m) for flight in flights]) if flights else Polygon()
    # No strip of a slab is left between two flights.
    wells = wells.buffer(_BETWEEN_M, join_style="mitre").buffer(-_BETWEEN_M, join_style="mitre")
    voids = unary_union([shape for room, shape in upper.rooms if room.open_below])
    opening = solid_region(wells.union(voids).intersection(upper.slab).difference(walls))
    return Stairwell(tuple(flights), opening, tuple(notes))


def _told(flight: AnyFlight, lower: Space, upper: Space, own: bool) -> list[str]:
    notes = []
    name = f"stairs {flight.id} from {lower.storey.name} to {upper.storey.name}"
    if not own:
        notes.append(f"{name} are drawn in the upper storey only")
    if not flight.way_known:
        notes.append(f"{name}: nothing tells which way they rise; it is assumed")
    if flight.riser_m > STEEP_M:
        notes.append(
            f"{name} are steep, {flight.treads + 1} steps of {100 * flight.riser_m:.0f} cm: the"
            " drawing may show a part of them"
        )
    if upper.slab.intersection(flight.outline).area < 0.5 * flight.outline.area:
        notes.append(f"{name} end outside the upper storey: look at how the storeys lie")
    return notes


def _flight(one: Stairs, lower: Space, rise_m: float) -> Flight | None:
    """The flight in the least rectangle around what is drawn."""
    box = Polygon(one.outline_m).minimum_rotated_rectangle
    if not isinstance(box, Polygon) or one.treads < 1 or rise_m <= 0.0:
        return None
    corners = np.array(box.exterior.coords)[:4]
    way = np.array(one.up)
    known = float(np.hypot(*way)) > 0.5
    if not known:
        way = _likely_way(corners, lower)
    sides = np.roll(corners, -1, axis=0) - corners
    lengths = np.hypot(*sides.T)
    if lengths.min() < LEAST_RUN_M:
        return None
    along = max(sides / lengths[:, None], key=lambda side: float(side @ way))
    right = np.array([along[1], -along[0]])
    forward, across = corners @ along, corners @ right
    foot = forward.min() * along + (across.min() + _SIDE_M) * right
    return Flight(
        id=one.id,
        foot=foot,
        along=along,
        run_m=float(np.ptp(forward)),
        width_m=float(np.ptp(across)) - 2.0 * _SIDE_M,
        treads=one.treads,
        rise_m=rise_m,
        way_known=known,
    )


def _likely_way(corners: NDArray[np.float64], lower: Space) -> NDArray[np.float64]:
    """Along the longer side, from the end that is free of walls: one walks up to the foot."""
    sides = np.roll(corners, -1, axis=0) - corners
    longer = int(np.argmax(np.hypot(*sides.T)))
    way = sides[longer] / max(float(np.hypot(*sides[longer])), 1e-9)
    ends = [corners[longer], corners[(longer + 1) % 4]]
    across = corners[(longer + 2) % 4] - ends[1]
    before = []
    for end, out in ((ends[0], -way), (ends[1], way)):
        edge = LineString([end + 0.2 * across, end + 0.8 * across]).buffer(0.01)
        ahead = unary_union([edge, _shifted(edge, _AHEAD_M * out)]).convex_hull
        before.append(float(ahead.intersection(lower.walls).area))
    return np.asarray(way if before[0] <= before[1] else -way)


def _shifted(shape: Polygon, by: NDArray[np.float64]) -> Polygon:
    return Polygon(np.array(shape.exterior.coords) + by)
