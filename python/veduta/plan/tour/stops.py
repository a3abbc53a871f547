"""Where the tour stops: in each room that can be reached, in an order that makes a short way."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely.geometry import Polygon

from veduta.plan.document import Room, RoomUse
from veduta.plan.tour.free import Ground
from veduta.plan.tour.grid import Grid

WIDE_M = 0.8
"""Clearer than this no place needs to be."""
FAR_COST = 0.15
"""What a metre away from the room's middle counts, in metres of clearance."""


STORES: frozenset[RoomUse] = frozenset({"wardrobe", "storage", "technical"})
CUPBOARD_M2 = {True: 3.0, False: 0.9}
"""Rooms that are smaller, and are for storing (or not), one does not go into."""


@dataclass(frozen=True)
class Stop:
    """A room of a storey, and the square in its midst to which one goes."""

    room: Room
    shape: Polygon
    storey: int
    node: int


@dataclass(frozen=True)
class Stops:
    """Where to go, and why not to the other rooms.

    beyond: storey and shape of rooms in which one could stand, but to which no way leads.
    """

    stops: tuple[Stop, ...]
    missed: tuple[str, ...]
    beyond: tuple[tuple[int, Polygon], ...] = ()


def title_of(room: Room) -> str:
    """What a room is called: as it is written on the plan, or by its use."""
    known = room.use not in {"other", "unknown"}
    return room.name or (room.use.capitalize() if known else f"Room {room.id}")


def is_cupboard(room: Room) -> bool:
    """Whether a room is no place to be shown: a wardrobe, a store, a duct of few square metres."""
    return room.area_m2 < CUPBOARD_M2[room.use in STORES]


def stops_of(grounds: Sequence[Ground], grid: Grid, start: int) -> Stops:
    """A stop in each room to which there is a way from a square."""
    reached = grid.reachable(start)
    stops: list[Stop] = []
    missed: list[str] = []
    beyond: list[tuple[int, Polygon]] = []
    for storey, ground in enumerate(grounds):
        before, notes = len(stops), []
        for room, shape in ground.space.rooms:
            if is_cupboard(room) or room.open_below:
                continue
            within = squares_in(shape, grid, storey)
            there = within[reached[within]]
            if len(there):
                stops.append(Stop(room, shape, storey, _midst(shape, grid, there)))
            else:
                notes.append(_why(room, ground, free=len(within) > 0))
                beyond += [(storey, shape)] if len(within) else []
        if len(stops) == before and len(notes) > 1:
            notes = [f"the tour leaves out {ground.space.storey.name}: no way leads to it"]
        missed += notes
    return Stops(tuple(stops), tuple(missed), tuple(beyond))


def squares_in(shape: Polygon, grid: Grid, storey: int) -> NDArray[np.int64]:
    """The squares of a storey whose middles lie in a polygon."""
    left, bottom, right, top = shape.bounds if not shape.is_empty else (0.0, 0.0, -1.0, -1.0)
    first, last = grid.first[storey], grid.first[storey + 1]
    # A storey's squares are numbered row by row.
    rows = np.searchsorted(grid.places_m[first:last, 1], (bottom, top), "left")
    chosen = np.arange(first + rows[0], max(first + rows[1], first + rows[0]))
    x = grid.places_m[chosen, 0]
    near = chosen[(x >= left) & (x <= right)]
    inside: NDArray[np.bool_] = shapely.contains_xy(shape, *grid.places_m[near].T)
    within: NDArray[np.int64] = near[inside]
    return within


def short_order(costs: NDArray[np.float64]) -> list[int]:
    """Rows 1.. of a matrix (n, n) of costs as a short round trip from row 0 and back to it.

    The nearest next, then pieces are turned round while that makes it shorter (2-opt, Croes 1958).
    """
    order = [0]
    rest = set(range(1, len(costs)))
    while rest:
        order.append(min(rest, key=lambda row: (costs[order[-1], row], row)))
        rest.remove(order[-1])
    order.append(0)
    improved = True
    while improved:
        improved = False
        for first in range(1, len(order) - 2):
            for last in range(first + 1, len(order) - 1):
                before, after = order[first - 1], order[last + 1]
                old = costs[before, order[first]] + costs[order[last], after]
                new = costs[before, order[last]] + costs[order[first], after]
                if new < old - 1e-9:
                    order[first : last + 1] = order[first : last + 1][::-1]
                    improved = True
    return order[1:-1]


def _midst(shape: Polygon, grid: Grid, squares: NDArray[np.int64]) -> int:
    """The square with the most room around it, near the middle."""
    middle = np.array(shape.centroid.coords[0])
    away = np.linalg.norm(grid.places_m[squares] - middle, axis=1)
    return int(squares[np.argmax(np.minimum(grid.clear_m[squares], WIDE_M) - FAR_COST * away)])


def _why(room: Room, ground: Ground, *, free: bool) -> str:
    where = f"{title_of(room)} ({room.id}) of {ground.space.storey.name}"
    if free:
        return f"the tour leaves out {where}: no door that is wide enough leads to it"
    return f"the tour leaves out {where}: nobody can stand in it"
