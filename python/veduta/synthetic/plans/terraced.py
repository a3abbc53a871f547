"""A terraced house: a hall with the stairs, two rooms in depth, and a narrower kitchen behind.

The plan of rows of houses of the nineteenth century, with the street at the bottom of the page:
neighbours share the thick walls left and right, the front and the back are thinner, the kitchen's
back is glazed from side to side. Upstairs the front bedroom reaches over the hall.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from veduta.synthetic.plans import curves
from veduta.synthetic.plans.dissect import Box, Cell, cell
from veduta.synthetic.plans.house import (
    House,
    Opening,
    Point,
    Stairs,
    Storey,
    Wall,
)
from veduta.synthetic.plans.network import Thickness, room_areas, room_of, walls_of
from veduta.synthetic.seeds import stream


@dataclass(frozen=True)
class Terrace:
    """The sizes of a house in metres, between the middles of walls; y is 0 at the street."""

    wide: float
    hall: float
    front: float
    back: float
    yard: float
    kitchen: float
    bath: float
    landing: float
    party: float
    outer: float
    inner: float

    @property
    def deep(self) -> float:
        """From the street to the back of the main house."""
        return self.front + self.back


def terraced_house(seed: int) -> tuple[House, Terrace]:
    """The two storeys of a seed, and the sizes that they were made with."""
    rng = stream(seed, "terraced")

    def some(low: float, high: float) -> float:
        return round(float(rng.uniform(low, high)), 2)

    size = Terrace(
        wide=some(5.0, 6.4), hall=some(1.9, 2.2), front=some(3.7, 4.5), back=some(3.2, 4.0),
        yard=some(1.3, 1.8), kitchen=some(3.2, 4.6), bath=some(2.2, 3.0), landing=some(1.2, 1.5),
        party=some(0.24, 0.34), outer=some(0.14, 0.2), inner=some(0.09, 0.12),
    )  # fmt: skip
    return House(seed, (_ground(size, rng), _first(size, rng))), size


def _ground(size: Terrace, rng: np.random.Generator) -> Storey:
    wide, hall, deep = size.wide, size.hall, size.deep
    cells = [
        cell(Box(0.0, 0.0, hall, deep), "hall"),
        cell(Box(hall, 0.0, wide, size.front), "living"),
        cell(Box(hall, size.front, wide, deep), "dining"),
        cell(Box(0.0, deep, wide - size.yard, deep + size.kitchen), "kitchen"),
    ]
    made = _Made(cells, size)
    made.door(None, 0, at=0.9, width=0.86, into=0, facing=(0.0, -1.0))
    made.door(0, 1, at=float(rng.uniform(0.72, 0.9)), width=0.8, into=1)
    made.door(0, 2, at=float(rng.uniform(0.1, 0.3)), width=0.8, into=2)
    if rng.random() < 0.5:
        made.door(2, 3, at=0.5, width=0.9, into=None)
    made.door(0, 3, at=0.75, width=0.8, into=3)
    made.window(1, facing=(0.0, -1.0), share=0.6)
    made.window(2, facing=(0.0, 1.0), share=0.6)
    made.window(3, facing=(1.0, 0.0), share=0.35)
    made.glazed(3, facing=(0.0, 1.0))
    return made.storey(0, _flight(size, up=True))


def _first(size: Terrace, rng: np.random.Generator) -> Storey:
    wide, hall, deep = size.wide, size.hall, size.deep
    over: tuple[Point, ...] = (
        (0.0, 0.0), (wide, 0.0), (wide, size.front), (hall, size.front),
        (hall, size.landing), (0.0, size.landing),
    )  # fmt: skip
    cells = [
        cell(Box(0.0, size.landing, hall, deep), "corridor"),
        Cell(over, (0.0,) * 6, "bedroom"),
        cell(Box(hall, size.front, wide, deep), "bedroom"),
        cell(Box(0.0, deep, wide - size.yard, deep + size.bath), "bathroom"),
    ]
    made = _Made(cells, size)
    made.door(0, 1, at=0.85, width=0.76, into=1, facing=(1.0, 0.0))
    made.door(0, 2, at=float(rng.uniform(0.4, 0.8)), width=0.76, into=2)
    made.door(0, 3, at=0.5, width=0.7, into=3)
    made.window(1, facing=(0.0, -1.0), share=0.3)
    made.window(2, facing=(0.0, 1.0), share=0.6)
    made.window(3, facing=(0.0, 1.0), share=0.3)
    return made.storey(1, _flight(size, up=False))


def _flight(size: Terrace, up: bool) -> Stairs:
    """Along the left party wall, rising away from the street."""
    left, bottom = size.party / 2.0, size.landing + 0.25
    right, top = left + 0.82, bottom + 2.6
    ring = ((left, bottom), (right, bottom), (right, top), (left, top))
    return Stairs(ring, 12, (0.0, 1.0 if up else -1.0))


class _Made:
    """Walls of cells, and openings that are put into them."""

    def __init__(self, cells: Sequence[Cell], size: Terrace) -> None:
        self.cells = cells
        self.ids = [f"r{index}" for index in range(len(cells))]
        thin = walls_of(cells, self.ids, Thickness(size.outer, size.inner))
        sides = (0.0, size.wide)
        self.walls = tuple(
            replace(wall, thickness_m=size.party)
            if wall.outer and wall.start_m[0] == wall.end_m[0] and wall.start_m[0] in sides
            else wall
            for wall in thin
        )
        self.openings: list[Opening] = []

    def _between(
        self, first: int | None, second: int | None, facing: Point | None
    ) -> tuple[Wall, bool]:
        """The longest wall between two rooms, None outdoors; whether the first lies to its left.

        `facing` is the way out of the first room (of the second where that is None).
        """
        names = {None if one is None else self.ids[one] for one in (first, second)}
        of = self.ids[first if first is not None else second or 0]
        fitting = [
            wall for wall in self.walls
            if {wall.left, wall.right} == names
            and (facing is None or np.dot(_outward(wall, of), facing) > 0.9)
        ]  # fmt: skip
        wall = max(fitting, key=curves.wall_length)
        return wall, wall.left == of

    def door(
        self, first: int | None, second: int, at: float, width: float, into: int | None,
        facing: Point | None = None,
    ) -> None:  # fmt: skip
        """A door between two rooms at a share of the free length; a plain gap with no `into`."""
        wall, _ = self._between(first, second, facing)
        free = curves.wall_length(wall) - 2 * _CORNER - width
        along = round(_CORNER + at * max(free, 0.0), 3)
        number = f"d{len(self.openings)}"
        if into is None:
            self.openings.append(Opening(number, wall.id, "gap", "plain", along, width))
            return
        swing = "left" if wall.left == self.ids[into] else "right"
        hinge = "start" if at < 0.5 else "end"
        opening = Opening(number, wall.id, "door", "swing", along, width, hinge, swing)  # type: ignore[arg-type]
        self.openings.append(opening)

    def window(self, room: int, facing: Point, share: float) -> None:
        """A window in the middle of an outer wall, so much of it wide."""
        wall, _ = self._between(room, None, facing)
        length = curves.wall_length(wall)
        width = round(share * length, 2)
        along = round((length - width) / 2.0, 3)
        number = f"n{len(self.openings)}"
        self.openings.append(Opening(number, wall.id, "window", "double-line", along, width))

    def glazed(self, room: int, facing: Point) -> None:
        """Sliding glass from corner to corner."""
        wall, _ = self._between(room, None, facing)
        width = round(curves.wall_length(wall) - 0.5, 2)
        number = f"d{len(self.openings)}"
        self.openings.append(Opening(number, wall.id, "door", "sliding", 0.25, width))

    def storey(self, number: int, flight: Stairs) -> Storey:
        """The storey with what was put into it."""
        areas = room_areas(self.cells, self.walls)
        rooms = tuple(
            room_of(name, one.use or "storage", area)
            for name, one, area in zip(self.ids, self.cells, areas, strict=True)
        )
        return Storey(number, self.walls, tuple(self.openings), rooms, (flight,))


_CORNER = 0.14
"""What a door keeps from the middle of the wall beside it, in metres."""


def _outward(wall: Wall, room: str) -> np.ndarray:
    """The unit vector across a wall that leads out of a room."""
    way = np.subtract(wall.end_m, wall.start_m) / curves.wall_length(wall)
    left = np.array([-way[1], way[0]])
    return -left if wall.left == room else left
