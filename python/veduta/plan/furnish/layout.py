"""What stands in a room so far, and whether something more may stand somewhere."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from shapely.geometry import Polygon

from veduta.plan.furnish.catalogue.entry import Entry, Size
from veduta.plan.furnish.room import RoomSpace
from veduta.plan.furnish.walk import Ways

FLAT_M = 0.05
"""One walks over things that are no higher."""
OVERHEAD_M = 1.95
"""One walks below things that begin higher."""
DOOR_M = 2.1
_TOUCH_M = 1e-3
_SILL_M, _HEAD_M = 0.03, 0.3
"""So much higher than a sill things before a window may be, and the heads of beds and taps."""
_CEILING_M = 0.03


@dataclass(frozen=True)
class Stood:
    """A thing in its place: `at` is the middle of its base, `turn` that of `Furniture`.

    on: what it stands on. group: things of one group may stand in each other's free space.
    drawn: whether the plan has it there; between: whether it follows from what is drawn beside it.
    """

    entry: Entry
    size_m: Size
    at: tuple[float, float]
    turn: float
    above_m: float = 0.0
    on: Stood | None = None
    group: int = 0
    drawn: bool = False
    between: bool = False

    @cached_property
    def shape(self) -> Polygon:
        """What it covers."""
        width, depth, _ = self.size_m
        return rectangle(self.at, self.turn, (-width / 2, width / 2), (-depth / 2, depth / 2))

    @property
    def inner(self) -> Polygon:
        """What it covers, less what may touch others."""
        x, y = (max(side / 2 - _TOUCH_M, 0.0) for side in self.size_m[:2])
        return rectangle(self.at, self.turn, (-x, x), (-y, y))

    @cached_property
    def front(self) -> Polygon | None:
        """What must stay free before it."""
        width, depth, _ = self.size_m
        if self.entry.front_m <= 0.0 or self.above_m >= OVERHEAD_M:
            return None
        return rectangle(
            self.at, self.turn, (-width / 2, width / 2),
            (-depth / 2 - self.entry.front_m, -depth / 2),
        )  # fmt: skip

    @property
    def top_m(self) -> float:
        """From the floor to its upper end."""
        return self.above_m + self.size_m[2]

    @property
    def is_flat(self) -> bool:
        """Whether one walks over it."""
        return self.top_m <= FLAT_M

    @property
    def is_upon(self) -> bool:
        """Whether it stands on another thing: what stands on a rug stands on the floor."""
        return self.on is not None and not self.on.is_flat

    @property
    def is_in_the_way(self) -> bool:
        """Whether one cannot walk where it is."""
        return not self.is_flat and self.above_m < OVERHEAD_M

    def point(self, x: float, y: float) -> NDArray[np.float64]:
        """A point of its own frame in the plan."""
        c, s = math.cos(self.turn), math.sin(self.turn)
        return np.array([self.at[0] + c * x - s * y, self.at[1] + s * x + c * y])


@dataclass
class Layout:
    """A room as it fills. zones: free spaces with the group that they are of."""

    space: RoomSpace
    ways: Ways
    stood: list[Stood] = field(default_factory=list)
    zones: list[tuple[Polygon, int]] = field(default_factory=list)

    def __post_init__(self) -> None:
        self._shapes: list[Polygon] = [one.shape for one in self.stood]
        self.mask = np.zeros(self.ways.grid.floor.shape, dtype=np.bool_)
        self._fronts = [*map(self._before, self.stood)]
        for one, shape in zip(self.stood, self._shapes, strict=True):
            if one.is_in_the_way:
                self.mask |= self.ways.grid.covered(shape)

    def copy(self) -> Layout:
        """The same room, to try something in."""
        return Layout(self.space, self.ways, list(self.stood), list(self.zones))

    def allows(self, thing: Stood, beside: Sequence[Stood] = ()) -> bool:
        """Whether a thing may stand where it is: nothing overlaps, no window or door is covered."""
        if thing.is_upon:
            return all(not _overlap(thing, other) for other in (*self.stood, *beside))
        shape, space = thing.shape, self.space
        if thing.top_m > space.height_m - _CEILING_M or not space.inside.covers(shape):
            return False
        if not thing.is_flat:
            inner = thing.inner
            if thing.above_m < DOOR_M and space.blocked.intersects(inner):
                return False
            tap = thing.drawn and thing.entry.type == "kitchen-sink"
            over = _HEAD_M if tap or thing.entry.kind == "bed" else _SILL_M
            if thing.entry.type != "curtain" and any(
                thing.top_m > window.low_m + over and window.zone.intersects(inner)
                for window in space.windows
            ):
                return False
            if thing.is_in_the_way and any(
                group != thing.group and zone.intersects(inner) for zone, group in self.zones
            ):
                return False
        return all(not _overlap(thing, other) for other in (*self.stood, *beside)) and (
            self._front_is_free(thing, beside)
        )

    def zone_is_free(self, zone: Polygon, group: int, beside: Sequence[Stood] = ()) -> bool:
        """Whether a space before or beside a thing lies in the room and nothing stands there."""
        inner = zone.buffer(-0.02)
        if not self.space.inside.covers(inner):
            return False
        return not any(
            other.is_in_the_way and other.group != group and inner.intersects(other.shape)
            for other in (*self.stood, *beside)
        )

    def _front_is_free(self, thing: Stood, beside: Sequence[Stood]) -> bool:
        front = thing.front
        return front is None or self.zone_is_free(front, thing.group, beside)

    def can_walk(self, things: Sequence[Stood]) -> bool:
        """Whether, with these things too, all doors and the fronts of all things are reached."""
        mask = self.mask.copy()
        for one in things:
            if one.is_in_the_way:
                mask |= self.ways.grid.covered(one.shape)
        main = self.ways.main_region(mask)
        if main is None:
            return False
        fronts = [*self._fronts, *map(self._before, things)]
        return all(front is None or bool(main[front].any()) for front in fronts)

    def _before(self, thing: Stood) -> tuple[NDArray[np.intp], ...] | None:
        """The cells from which one reaches a thing: its front, and a step away from that."""
        if thing.front is None:
            return None
        return np.nonzero(self.ways.grid.covered(thing.front.buffer(0.3)))

    def add(self, things: Sequence[Stood], zones: Sequence[tuple[Polygon, int]] = ()) -> None:
        """Keep things where they are."""
        for one in things:
            self.stood.append(one)
            self._fronts.append(self._before(one))
            if one.is_in_the_way:
                self.mask |= self.ways.grid.covered(one.shape)
            if one.front is not None:
                self.zones.append((one.front, one.group))
        self.zones.extend(zones)


def _overlap(first: Stood, second: Stood) -> bool:
    if first.above_m >= second.top_m - 1e-6 or second.above_m >= first.top_m - 1e-6:
        return False
    reach = math.hypot(*first.size_m[:2]) + math.hypot(*second.size_m[:2])
    if 2.0 * math.dist(first.at, second.at) >= reach:
        return False
    return bool(first.shape.intersection(second.shape).area > 1e-6)


def rectangle(
    at: tuple[float, float] | NDArray[np.float64], turn: float, x: tuple[float, float],
    y: tuple[float, float],
) -> Polygon:  # fmt: skip
    """A rectangle of a thing's frame in the plan."""
    c, s = math.cos(turn), math.sin(turn)
    return Polygon(
        [
            (at[0] + c * a - s * b, at[1] + s * a + c * b)
            for a, b in ((x[0], y[0]), (x[1], y[0]), (x[1], y[1]), (x[0], y[1]))
        ]
    )
