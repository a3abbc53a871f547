"""Stairs that turn: treads that fan, quarter and half turns, spirals, flights that share landings.

Each tread is an outline of its own, a landing is one; each rises by the same height over the last.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from shapely.geometry import LineString, Point, Polygon
from shapely.geometry.base import BaseGeometry
from shapely.geometry.polygon import orient
from shapely.ops import unary_union

from veduta.plan.document import Stairs
from veduta.plan.house.headroom import first_in_well

LANDING = 1.7
"""A tread that is so many times as deep as the usual one is a landing: one walks on level."""
_TOUCH_M = 2e-3
_DIGITS = 4

Corner = tuple[float, float]


@dataclass(frozen=True)
class TurningFlight:
    """Stairs as their treads, from the lowest up.

    rings: the treads' outlines, counter-clockwise, with the corners of others that lie on them.
    path_m: (n, 2) the walking line, from the first riser to the last. rise_m: from floor to floor,
    of which each tread and the upper floor take a part.
    """

    id: str
    rings: tuple[tuple[Corner, ...], ...]
    path_m: NDArray[np.float64]
    rise_m: float
    way_known: bool

    @property
    def treads(self) -> int:
        """How many there are, landings with them."""
        return len(self.rings)

    @property
    def riser_m(self) -> float:
        """Height of a step."""
        return self.rise_m / (self.treads + 1)

    @cached_property
    def steps(self) -> tuple[Polygon, ...]:
        """The treads' outlines."""
        return tuple(Polygon(ring) for ring in self.rings)

    @cached_property
    def outline(self) -> BaseGeometry:
        """All that it stands over."""
        return unary_union(self.steps).buffer(_TOUCH_M, join_style="mitre").buffer(
            -_TOUCH_M, join_style="mitre"
        )  # fmt: skip

    @cached_property
    def owners(self) -> dict[tuple[Corner, Corner], int]:
        """Of each directed edge the tread on whose left it lies."""
        return {
            (here, there): number
            for number, ring in enumerate(self.rings)
            for here, there in zip(ring, (*ring[1:], ring[0]), strict=True)
        }

    @cached_property
    def starts_m(self) -> NDArray[np.float64]:
        """(treads + 1,) where the walking line enters each tread, and the upper floor."""
        path = LineString(self.path_m)
        entered = [0.0]
        for here in self.steps[:-1]:
            on = path.intersection(here.buffer(_TOUCH_M))
            ends = [path.project(Point(*at)) for at in _corners(on)]
            entered.append(max([*ends, entered[-1]]))
        return np.array([*entered, path.length])

    @cached_property
    def line_m(self) -> NDArray[np.float64]:
        """(n, 3) the way of the feet above the lower floor: at its tread's height in its middle.

        It starts and ends at the middle of the first and the last tread, and is level on landings.
        """
        path = LineString(self.path_m)
        goings = np.diff(self.starts_m)
        usual = float(np.median(goings))
        knots: list[tuple[float, float]] = []
        for number, (start, going) in enumerate(zip(self.starts_m, goings, strict=False)):
            height = (number + 1) * self.riser_m
            inset = min(going, usual if going > LANDING * usual else going) / 2.0
            knots += [(start + inset, height), (start + going - inset, height)]
        places, heights = np.array(knots).T
        corners = [path.project(Point(*at)) for at in self.path_m]
        between = [at for at in corners if places[0] < at < places[-1]]
        along = np.unique(np.round([*places, *between], 6))
        feet = np.array([path.interpolate(at).coords[0] for at in along])
        return np.column_stack([feet, np.interp(along, places, heights)])

    @cached_property
    def foot(self) -> LineString:
        """The edge of the lowest tread where one steps onto it."""
        return self._edge(0, self.path_m[0])

    @cached_property
    def arrival(self) -> LineString:
        """The edge of the highest tread where one steps off."""
        return self._edge(self.treads - 1, self.path_m[-1])

    def _edge(self, number: int, at: NDArray[np.float64]) -> LineString:
        """The side of a tread at a place; corners of other treads may lie on it."""
        ring = self.rings[number]
        edges = [np.array(pair) for pair in zip(ring, (*ring[1:], ring[0]), strict=True)]
        best = min(edges, key=lambda edge: LineString(edge).distance(Point(*at)))
        way = (best[1] - best[0]) / np.hypot(*(best[1] - best[0]))
        aside = np.array([way[1], -way[0]])
        level = [edge for edge in edges if np.abs((edge - best[0]) @ aside).max() < _TOUCH_M]
        along = (np.concatenate(level) - best[0]) @ way
        return LineString([best[0] + along.min() * way, best[0] + along.max() * way])

    def well(self, slab_m: float) -> BaseGeometry:
        """Where the slab above would be nearer to a tread than a head is high."""
        first = first_in_well(self.rise_m, self.riser_m, self.treads, slab_m)
        return unary_union(self.steps[first:])


def turning_flight(one: Stairs, rise_m: float) -> TurningFlight | None:
    """The stairs of a document that has their treads; None where there is no height to climb."""
    if rise_m <= 0.0 or not one.steps_m:
        return None
    shapes = [orient(Polygon(ring)) for ring in one.steps_m]
    return TurningFlight(
        id=one.id,
        rings=noded(shapes),
        path_m=np.array(one.path_m),
        rise_m=rise_m,
        way_known=float(np.hypot(*one.up)) > 0.5,
    )


def noded(shapes: Sequence[Polygon]) -> tuple[tuple[Corner, ...], ...]:
    """Rings whose common edges are the same: corners that lie on edges of others are put in."""
    rings = [np.array(shape.exterior.coords)[:-1] for shape in shapes]
    places = _merged(np.concatenate(rings))
    found = []
    for ring in rings:
        corners: list[Corner] = []
        for here, there in zip(ring, np.roll(ring, -1, axis=0), strict=True):
            way = there - here
            length = float(np.hypot(*way))
            ahead = (places - here) @ way / max(length, 1e-9)
            aside = np.abs((places - here) @ np.array([way[1], -way[0]])) / max(length, 1e-9)
            on = (aside < _TOUCH_M) & (ahead > -_TOUCH_M) & (ahead < length - _TOUCH_M)
            corners += [
                (float(x), float(y)) for x, y in places[np.flatnonzero(on)[np.argsort(ahead[on])]]
            ]
        found.append(tuple(dict.fromkeys(corners)))
    return tuple(found)


def _merged(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Points without those that lie on another."""
    left = np.round(points, _DIGITS)
    kept: list[NDArray[np.float64]] = []
    while len(left):
        kept.append(left[0])
        left = left[np.hypot(*(left - left[0]).T) > _TOUCH_M]
    return np.array(kept)


def _corners(shape: BaseGeometry) -> list[Corner]:
    parts = getattr(shape, "geoms", [shape])
    return [(float(x), float(y)) for part in parts for x, y in part.coords]
