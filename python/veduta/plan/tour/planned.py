"""Where a tour can go: for a visitor who walks straight, who closes doors, or turns sideways."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from shapely.geometry import Polygon

from veduta.plan.document import RoomUse
from veduta.plan.house.build import House
from veduta.plan.house.flights import stairwells
from veduta.plan.tour.climbs import climbs_of
from veduta.plan.tour.free import BODY_M, HEAD_M, SLIM_M, Ground, ground_of
from veduta.plan.tour.grid import Grid, cells_of
from veduta.plan.tour.leaves import DoorLeaf, leaves_as_toured
from veduta.plan.tour.outside import Outside
from veduta.plan.tour.stops import Stops, squares_in, stops_of

THROUGH: frozenset[RoomUse] = frozenset({"hall", "corridor", "stairs"})
"""Where one passes, and stops only if the way does not lead through."""
MOST_SHUT = 3
"""So many doors are kept closed at most, ..."""
MOST_TRIED = 8
"""... of as many that may bar a way."""
AT_DOOR_M = 0.3
"""A doorway of a room is no farther from it than this: its wall is between."""
IN_WAY_M = 0.6
"""A leaf farther from a doorway than this leaves room before it."""


@dataclass(frozen=True)
class Plan:
    """Where one can walk, where to begin, and which rooms to go to.

    leaves: as they stand. shut: the doors that stay closed.
    """

    grounds: tuple[Ground, ...]
    grid: Grid
    begin: Begin
    found: Stops
    leaves: tuple[DoorLeaf, ...]
    shut: tuple[int, ...]

    @property
    def worth(self) -> tuple[int, bool]:
        """Plans that lead to more rooms are better, then those that begin outdoors."""
        return len(self.found.stops), self.begin.is_outside


def planned(house: House, outside: Outside | None) -> Plan | None:
    """For a visitor who walks straight, or closes doors, or turns sideways as that is needed."""
    best: Plan | None = None
    for body_m in (BODY_M, SLIM_M):
        plan = plan_for(house, outside, body_m)
        if plan is not None:
            plan = _with_doors_shut(house, outside, plan, body_m)
        if plan is not None and (best is None or plan.worth > best.worth):
            best = plan
        if best is not None and not best.found.missed and best.begin.is_outside:
            break
    return best


def _with_doors_shut(house: House, outside: Outside | None, plan: Plan, body_m: float) -> Plan:
    """The plan in which doors stay closed that bar the way where they stand open.

    One door after the other, that by which most rooms are won; none by which as many are lost.
    """
    while len(plan.shut) < MOST_SHUT and plan.found.beyond:
        tries = [
            plan_for(house, outside, body_m, (*plan.shut, door))
            for door in _in_the_way(plan)[:MOST_TRIED]
        ]
        better = [one for one in tries if one is not None and one.worth > plan.worth]
        if not better:
            break
        plan = max(better, key=lambda one: one.worth)
    return plan


def _in_the_way(plan: Plan) -> list[int]:
    """The doors with open leaves at ways into rooms that are not reached, the nearest first."""
    found: dict[int, float] = {}
    for storey, shape in plan.found.beyond:
        ground = plan.grounds[storey]
        ways = [hole.outline for hole in ground.space.holes if hole.opening.kind != "window"]
        near = [way for way in ways if way.distance(shape) < AT_DOOR_M]
        for leaf in plan.leaves:
            at_storey = (
                leaf.low_m < ground.elevation_m + HEAD_M and leaf.high_m > ground.elevation_m
            )
            if not at_storey or leaf.door in plan.shut:
                continue
            away = min((leaf.footprint.distance(way) for way in near), default=math.inf)
            if away < IN_WAY_M:
                found[leaf.door] = min(away, found.get(leaf.door, math.inf))
    return sorted(found, key=lambda door: (found[door], door))


def shut_notes(names: Sequence[str]) -> list[str]:
    """What is said of doors that stay closed."""
    return [
        f"the tour keeps {name} closed: open, its leaf bars the way to a room" for name in names
    ]


def plan_for(
    house: House, outside: Outside | None, body_m: float, shut: tuple[int, ...] = ()
) -> Plan | None:
    """For a visitor with this radius, with these doors closed; None without room to stand."""
    leaves = leaves_as_toured(house.part, shut)
    # How thick the slab is matters for wells alone, and those the house has.
    wells = stairwells(house.spaces, 0.0)
    climbs = climbs_of(house.spaces, wells)
    around = Polygon() if outside is None else outside.region
    grounds = tuple(
        ground_of(
            space,
            leaves,
            around if number == house.ground else Polygon(),
            wells[number].flights,
            body_m,
        )
        for number, space in enumerate(house.spaces)
    )
    grid = Grid([cells_of(ground, len(grounds)) for ground in grounds], climbs)
    begin = _begin(grid, grounds, outside, house.ground)
    if begin is None:
        return None
    return Plan(grounds, grid, begin, stops_of(grounds, grid, begin.node), tuple(leaves), shut)


@dataclass(frozen=True)
class Begin:
    """The square at which the tour begins and ends."""

    node: int
    is_outside: bool


def _begin(
    grid: Grid, grounds: Sequence[Ground], outside: Outside | None, entered: int
) -> Begin | None:
    """Before the house, if most rooms are reached from there, else in the midst of the most."""
    rooms = Counter[int]()
    first: dict[int, int] = {}
    for storey, ground in enumerate(grounds):
        for _, shape in ground.space.rooms:
            pieces = grid.pieces_of(squares_in(shape, grid, storey))
            rooms.update(pieces.keys())
            first = pieces | first
    if not rooms:
        return None
    most, count = rooms.most_common(1)[0]
    front = None if outside is None else grid.nearest(entered, outside.ring_m[0])
    if front is not None and 2 * rooms[next(iter(grid.pieces_of(np.array([front]))))] >= count:
        return Begin(front, is_outside=True)
    stops = stops_of(grounds, grid, first[most]).stops
    inviting = min(
        stops, key=lambda stop: (abs(stop.storey - entered), stop.room.use not in THROUGH)
    )
    return Begin(inviting.node, is_outside=False)
