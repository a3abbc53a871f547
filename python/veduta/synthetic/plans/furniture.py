"""Furniture and fixtures as plans draw them: where they stand, and their symbols."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely.geometry import Polygon
from shapely.geometry.base import BaseGeometry

from veduta.synthetic.plans.canvas import Canvas
from veduta.synthetic.plans.house import Storey, Use
from veduta.synthetic.plans.styles import Style

TRIES = 14
OFF_WALL_M = 0.03


@dataclass(frozen=True)
class Thing:
    """Stands with its back against a wall, `wide` along it and `deep` into the room."""

    symbol: str
    wide: float
    deep: float
    fixed: bool = False


@dataclass(frozen=True)
class Stood:
    """A thing in its place: its back's corner, along its back, into the room."""

    thing: Thing
    corner: NDArray[np.float64]
    along: NDArray[np.float64]
    inward: NDArray[np.float64]

    def at(self, u: float, v: float) -> NDArray[np.float64]:
        """A point at shares of its width and depth."""
        return self.corner + u * self.thing.wide * self.along + v * self.thing.deep * self.inward

    @property
    def area(self) -> Polygon:
        """What it covers."""
        return Polygon([self.at(0, 0), self.at(1, 0), self.at(1, 1), self.at(0, 1)])


BED, TWIN = Thing("bed", 1.6, 2.05), Thing("bed", 0.95, 2.05)
CLOSET, DESK = Thing("closet", 1.5, 0.6), Thing("desk", 1.3, 0.65)
SOFA, TABLE, SHELF = Thing("sofa", 2.0, 0.85), Thing("table", 1.5, 1.5), Thing("closet", 1.4, 0.4)
COUNTER, FRIDGE = Thing("counter", 2.1, 0.6, True), Thing("fridge", 0.6, 0.6, True)
TOILET, BASIN = Thing("toilet", 0.4, 0.66, True), Thing("basin", 0.55, 0.45, True)
TUB, SHOWER = Thing("tub", 1.65, 0.72, True), Thing("shower", 0.85, 0.85, True)
WASHER, BENCH, CAR = (
    Thing("washer", 0.6, 0.6, True),
    Thing("bench", 1.6, 0.6, True),
    Thing("car", 1.8, 4.2),
)
WANTED: Mapping[Use, tuple[Thing, ...]] = {
    "living": (SOFA, TABLE, SHELF, Thing("sofa", 0.9, 0.85)), "dining": (TABLE, SHELF),
    "kitchen": (COUNTER, FRIDGE, TABLE), "bedroom": (BED, CLOSET, TWIN, DESK),
    "bathroom": (TUB, TOILET, BASIN, SHOWER, WASHER), "toilet": (TOILET, BASIN),
    "utility": (WASHER, WASHER, BASIN), "study": (DESK, SHELF), "sauna": (BENCH,),
    "garage": (CAR,), "storage": (SHELF,), "wardrobe": (), "hall": (Thing("closet", 1.0, 0.4),),
    "corridor": (), "stairs": (),
}  # fmt: skip


def furnish(
    rng: np.random.Generator, storey: Storey, density: float, busy: BaseGeometry
) -> list[Stood]:
    """Things along the walls, clear of doors and each other; fixtures before furniture."""
    stood: list[Stood] = []
    for room in storey.rooms:
        area = Polygon(room.outline_m)
        free = area.difference(busy)
        for thing in WANTED[room.use]:
            if rng.random() >= density or thing.wide * thing.deep > 0.4 * area.area:
                continue
            found = _place(rng, thing, area, free)
            if found is not None:
                stood.append(found)
                free = free.difference(found.area.buffer(0.05))
    return stood


def _place(
    rng: np.random.Generator, thing: Thing, room: Polygon, free: BaseGeometry
) -> Stood | None:
    corners = np.asarray(room.exterior.coords)
    starts, ends = corners[:-1], corners[1:]
    sizes = np.hypot(*(ends - starts).T)
    sides = np.flatnonzero(sizes > thing.wide + 0.1)
    if sides.size == 0:
        return None
    shapely.prepare(free)
    for _ in range(TRIES):
        side = int(rng.choice(sides))
        along = (ends[side] - starts[side]) / sizes[side]
        inward = np.array([-along[1], along[0]])
        slack = sizes[side] - thing.wide - 2 * OFF_WALL_M
        share = float(rng.choice([0.0, 1.0, rng.random()]))
        corner = starts[side] + (OFF_WALL_M + share * slack) * along + OFF_WALL_M * inward
        stood = Stood(thing, corner, along, inward)
        if free.contains(stood.area):
            return stood
    return None


def draw_things(canvas: Canvas, style: Style, things: list[Stood]) -> None:
    """The symbols in a thin pen."""
    for stood in things:
        SYMBOLS[stood.thing.symbol](_Pen(canvas, style, stood))


class _Pen:
    """Draws in shares of a thing's width and depth."""

    def __init__(self, canvas: Canvas, style: Style, stood: Stood) -> None:
        self.canvas, self.style, self.stood = canvas, style, stood

    def path(self, points: list[tuple[float, float]], closed: bool = False) -> None:
        lines = [self.stood.at(u, v) for u, v in points]
        self.canvas.line(lines, 0.75 * self.style.pen_px, self.style.ink, closed)

    def box(self, u0: float, v0: float, u1: float, v1: float) -> None:
        self.path([(u0, v0), (u1, v0), (u1, v1), (u0, v1)], True)

    def oval(self, u: float, v: float, ru: float, rv: float, power: float = 1.0) -> None:
        """An ellipse, or with a power below 1 a rounded box."""
        turns = np.linspace(0, 2 * math.pi, 40, endpoint=False)
        cos, sin = np.cos(turns), np.sin(turns)
        x = u + ru * np.sign(cos) * np.abs(cos) ** power
        y = v + rv * np.sign(sin) * np.abs(sin) ** power
        self.path(list(zip(x.tolist(), y.tolist(), strict=True)), True)


def _bed(pen: _Pen) -> None:
    pen.box(0, 0, 1, 1)
    pen.path([(0, 0.32), (1, 0.32)])
    if pen.stood.thing.wide > 1.2:
        pen.box(0.08, 0.04, 0.45, 0.22)
        pen.box(0.55, 0.04, 0.92, 0.22)
    else:
        pen.box(0.15, 0.04, 0.85, 0.22)


def _closet(pen: _Pen) -> None:
    pen.box(0, 0, 1, 1)
    pen.path([(0, 0), (1, 1)])
    pen.path([(0, 1), (1, 0)])


def _desk(pen: _Pen) -> None:
    pen.box(0, 0, 1, 0.8)
    pen.oval(0.5, 1.0, 0.17, 0.25, 0.5)


def _sofa(pen: _Pen) -> None:
    pen.box(0, 0, 1, 1)
    pen.path([(0.1, 1), (0.1, 0.28), (0.9, 0.28), (0.9, 1)])
    if pen.stood.thing.wide > 1.5:
        pen.path([(0.5, 0.28), (0.5, 1)])


def _table(pen: _Pen) -> None:
    pen.box(0.12, 0.25, 0.88, 0.75)
    for u in (0.3, 0.7):
        pen.box(u - 0.1, 0.06, u + 0.1, 0.22)
        pen.box(u - 0.1, 0.78, u + 0.1, 0.94)


def _counter(pen: _Pen) -> None:
    pen.box(0, 0, 1, 1)
    pen.oval(0.22, 0.5, 0.12, 0.32, 0.4)
    pen.box(0.6, 0.1, 0.9, 0.9)
    for u in (0.68, 0.82):
        for v in (0.3, 0.7):
            pen.oval(u, v, 0.05, 0.16)


def _fridge(pen: _Pen) -> None:
    pen.box(0, 0, 1, 1)
    pen.path([(0, 0), (1, 1)])


def _toilet(pen: _Pen) -> None:
    pen.box(0.05, 0, 0.95, 0.28)
    pen.oval(0.5, 0.64, 0.42, 0.36)


def _basin(pen: _Pen) -> None:
    pen.box(0, 0, 1, 1)
    pen.oval(0.5, 0.55, 0.38, 0.32)


def _tub(pen: _Pen) -> None:
    pen.box(0, 0, 1, 1)
    pen.oval(0.5, 0.5, 0.45, 0.38, 0.4)
    pen.oval(0.12, 0.5, 0.02, 0.05)


def _shower(pen: _Pen) -> None:
    pen.box(0, 0, 1, 1)
    pen.path([(0, 0), (1, 1)])
    pen.path([(0, 1), (1, 0)])
    pen.oval(0.5, 0.5, 0.07, 0.07)


def _washer(pen: _Pen) -> None:
    pen.box(0, 0, 1, 1)
    pen.oval(0.5, 0.55, 0.33, 0.33)


def _bench(pen: _Pen) -> None:
    pen.box(0, 0, 1, 1)
    for v in (0.25, 0.5, 0.75):
        pen.path([(0, v), (1, v)])


def _car(pen: _Pen) -> None:
    pen.oval(0.5, 0.5, 0.46, 0.48, 0.35)
    pen.path([(0.12, 0.3), (0.88, 0.3)])
    pen.path([(0.16, 0.72), (0.84, 0.72)])


SYMBOLS: Mapping[str, Callable[[_Pen], None]] = {
    "bed": _bed, "closet": _closet, "desk": _desk, "sofa": _sofa, "table": _table,
    "counter": _counter, "fridge": _fridge, "toilet": _toilet, "basin": _basin, "tub": _tub,
    "shower": _shower, "washer": _washer, "bench": _bench, "car": _car,
}  # fmt: skip
