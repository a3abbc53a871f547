"""The treads of stairs that turn, put together: a flight, a fan or a landing, a flight."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from shapely.geometry import Polygon
from shapely.ops import unary_union

from veduta.plan.stairs.fans import GAP, Fan
from veduta.plan.stairs.probe import Probe, Spot

COLUMN = 0.08
"""Radius of a spiral's column, of the spiral's: it is too small on most sheets to be measured."""
WALK = 0.6
"""Where one walks on a spiral, as a share of its radius."""
FIRST = (0.6, 1.75)
"""The first straight tread beside a fan, of the depth of its treads in the middle."""
MOST_TREADS = 24
LEAST_PX2 = 4.0
"""A smaller tread is none."""


@dataclass(frozen=True)
class Course:
    """Treads in the order of the walking line; which of its ends is the foot is not known yet.

    steps: their outlines. path: (n, 2) the walking line. width_px: of a flight.
    """

    steps: tuple[Polygon, ...]
    path: NDArray[np.float64]
    width_px: float
    score: float

    @property
    def outline(self) -> Polygon:
        """Around all treads."""
        whole = unary_union([step.buffer(0.5, join_style="mitre") for step in self.steps])
        whole = whole.buffer(-0.5, join_style="mitre")
        return whole if isinstance(whole, Polygon) else whole.convex_hull

    @property
    def length_px(self) -> float:
        """Of the walking line."""
        return float(np.hypot(*np.diff(self.path, axis=0).T).sum())

    def turned(self) -> Course:
        """From its other end."""
        return Course(self.steps[::-1], self.path[::-1], self.width_px, self.score)


@dataclass(frozen=True)
class Leg:
    """Straight treads beside a turn, from it: the line that both share, and how far others are.

    inner, outer: (2,) ends of that line. way: unit vector away from the turn.
    """

    inner: Spot
    outer: Spot
    way: Spot
    away_px: tuple[float, ...]

    def steps(self) -> list[Polygon]:
        """Treads, that at the turn first."""
        return [
            Polygon(
                [
                    self.inner + near * self.way,
                    self.outer + near * self.way,
                    self.outer + far * self.way,
                    self.inner + far * self.way,
                ]
            )
            for near, far in pairwise((0.0, *self.away_px))
        ]

    def path(self) -> list[Spot]:
        """The end of the walking line on it; nothing where it has no treads."""
        middle = (self.inner + self.outer) / 2.0
        return [middle + self.away_px[-1] * self.way] if self.away_px else []


def course_of(fan: Fan, probe: Probe) -> Course | None:
    """The stairs that a fan belongs to; None where one of its treads would be nothing."""
    if fan.round:
        return _spiral(fan)
    first = _leg(fan, float(fan.angles[0]), -1.0, probe)
    last = _leg(fan, float(fan.angles[-1]), 1.0, probe)
    widths = [float(np.hypot(*(leg.outer - leg.inner))) for leg in (first, last)]
    bounds = _bounds(fan, first, last)
    wedges = [
        wedge
        for low, high in pairwise(fan.angles)
        if (wedge := _wedge(fan.newel, low, high, bounds)) is not None
    ]
    if len(wedges) < len(fan.angles) - 1:
        return None
    steps = [*first.steps()[::-1], *wedges, *last.steps()]
    arc = _arc(fan, fan.newel, widths[0] / 2.0, widths[1] / 2.0)
    path = np.array([*first.path(), *arc, *last.path()])
    return Course(tuple(steps), path, float(np.mean(widths)), fan.score)


def _leg(fan: Fan, angle: float, side: float, probe: Probe) -> Leg:
    """The straight treads behind an end of a fan; it may have none."""
    out, way = _ways(angle)
    away = side * way
    most = 1.4 * fan.radius_px
    width = probe.reach(fan.newel, out, most, GAP * fan.radius_px + 2.0)
    width = width if abs(width - fan.radius_px) < 0.25 * fan.radius_px else fan.radius_px
    outer = fan.newel + width * out
    going = fan.sweep / (len(fan.angles) - 1) * fan.radius_px / 2.0
    found = probe.lines_beside(
        (fan.newel, outer), away, (FIRST[0] * going, FIRST[1] * going), MOST_TREADS
    )
    return Leg(fan.newel, outer, away, tuple(found))


def _bounds(fan: Fan, first: Leg, last: Leg) -> Polygon:
    """The corner, or the end of a room, that the fan fills."""
    across = first.outer - fan.newel
    if fan.sweep < math.radians(135.0):
        other = last.outer - fan.newel
        return Polygon([fan.newel, fan.newel + across, last.outer + across, fan.newel + other])
    deep = -first.way * fan.radius_px
    return Polygon([first.outer, first.outer + deep, last.outer + deep, last.outer])


def _wedge(newel: Spot, low: float, high: float, bounds: Polygon) -> Polygon | None:
    """The tread between two angles; None where the bounds have nothing there."""
    if not bounds.is_valid:
        return None
    far = 10.0 * math.sqrt(bounds.area)
    ends = [newel + far * _ways(angle)[0] for angle in (low, high)]
    cut = Polygon([newel, *ends]).intersection(bounds)
    largest = max(getattr(cut, "geoms", [cut]), key=lambda piece: piece.area)
    return largest if isinstance(largest, Polygon) and largest.area >= LEAST_PX2 else None


def _arc(fan: Fan, middle: Spot, first_px: float, last_px: float) -> list[Spot]:
    count = max(4, math.ceil(fan.sweep / math.radians(7.0)))
    angles = np.linspace(fan.angles[0], fan.angles[-1], count + 1)
    radii = np.linspace(first_px, last_px, count + 1)
    return [
        middle + radius * _ways(float(angle))[0]
        for angle, radius in zip(angles, radii, strict=True)
    ]


def _spiral(fan: Fan) -> Course:
    inner, outer = COLUMN * fan.radius_px, fan.radius_px
    ways = [_ways(float(angle))[0] for angle in fan.angles]
    steps = [
        Polygon(
            [
                fan.newel + inner * here,
                fan.newel + outer * here,
                fan.newel + outer * there,
                fan.newel + inner * there,
            ]
        )
        for here, there in pairwise(ways)
    ]
    walk = WALK * outer
    return Course(
        tuple(steps), np.array(_arc(fan, fan.newel, walk, walk)), outer - inner, fan.score
    )


def _ways(angle: float) -> tuple[Spot, Spot]:
    """Outward, and at a right angle to it towards larger angles."""
    return (
        np.array([math.cos(angle), math.sin(angle)]),
        np.array([-math.sin(angle), math.cos(angle)]),
    )
