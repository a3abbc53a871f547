"""Landings between flights: what was found as single flights is one stair.

Two flights side by side are lines across both with a line up their middle; the landing is the free
piece that they end at. A quarter landing lies at the end of a flight, and treads go on at its side.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from shapely.geometry import Polygon

from veduta.plan.drawn import DrawnStairs
from veduta.plan.stairs.course import Course, Leg
from veduta.plan.stairs.probe import INKED, Probe, Spot

SPINE = 0.9
"""So much of the line between two flights is inked; an arrow is shorter than its flight."""
MIDDLE = 0.15
"""How far from the middle that line may be, as a share of both flights' width."""
WIDE = 4.6
"""Two flights are so many treads wide at least."""
DEPTH = (0.5, 1.8)
"""Of a landing, as a share of a flight's width."""
EVEN = (0.82, 1.22)
"""Treads on both sides of a landing are as deep as each other."""
LEAST_BESIDE = 2
MOST_TREADS = 20
MOST_LONGER = 2
CLOSED = 0.85
"""A landing ends at a line or a wall that is inked so far; the arrow that crosses it is shorter."""
CLEAR = 0.45
"""The line between the flights does not go on over a landing."""


@dataclass(frozen=True)
class _Run:
    """A straight flight: its corner, the way along it and across it, and its sizes in pixels."""

    corner: Spot
    along: Spot
    across: Spot
    length: float
    width: float
    treads: int
    score: float

    @property
    def tread(self) -> float:
        return self.length / self.treads

    def at(self, ahead: float, aside: float) -> Spot:
        """A place so far along and across."""
        return np.asarray(self.corner + ahead * self.along + aside * self.across)

    def turned(self) -> _Run:
        """From its other end, and from its other side."""
        return _Run(
            self.at(self.length, self.width), -self.along, -self.across,
            self.length, self.width, self.treads, self.score,
        )  # fmt: skip

    def mirrored(self) -> _Run:
        """From its other side."""
        return _Run(
            self.at(0.0, self.width), self.along, -self.across,
            self.length, self.width, self.treads, self.score,
        )  # fmt: skip


def with_landings(flight: DrawnStairs, probe: Probe) -> Course | None:
    """The stairs that a straight flight is a part of; None where it is all."""
    run = _run_of(flight)
    half = _half(run, probe)
    if half is not None:
        return half
    longer = [_to_landing(end, probe) for end in (run, run.turned())]
    ways = [way for end in longer for way in (end, end.mirrored())]
    found = [one for way in ways if (one := _quarter(way, probe)) is not None]
    return max(found, key=lambda one: len(one.steps), default=None)


def _to_landing(run: _Run, probe: Probe) -> _Run:
    """With the treads at its end whose lines go on beside it, as the side of another flight."""
    wanted = (EVEN[0] * run.tread, EVEN[1] * run.tread)
    ends = (run.at(run.length, 0.0), run.at(run.length, run.width))
    more = probe.lines_beside(ends, run.along, wanted, MOST_LONGER)
    if not more:
        return run
    return replace(run, length=run.length + more[-1], treads=run.treads + len(more))


def _run_of(flight: DrawnStairs) -> _Run:
    left, low, right, high = Polygon(flight.outline_px).bounds
    first, second = np.array([1.0, 0.0]), np.array([0.0, 1.0])
    along, across = (first, second) if flight.across else (second, first)
    sides = (right - left, high - low) if flight.across else (high - low, right - left)
    corner = np.array([left, low])
    return _Run(corner, along, across, *sides, flight.treads, flight.score)


def _half(run: _Run, probe: Probe) -> Course | None:
    """Two flights side by side that end at a landing."""
    if run.width < WIDE * run.tread:
        return None
    tried = np.arange((0.5 - MIDDLE) * run.width, (0.5 + MIDDLE) * run.width, 1.0)
    first = np.array([run.at(0.0, aside) for aside in tried])
    inked = probe.inked(first, first + run.length * run.along)
    if inked.max() < SPINE:
        return None
    spine = float(tried[inked >= inked.max() - 1e-9].mean())
    ends = []
    for end, aside in ((run, spine), (run.turned(), run.width - spine)):
        depth = _depth(end, aside, probe)
        if depth is not None:
            ends.append((_walked(end, depth, probe), -depth, end, aside))
    if not ends:
        return None
    _, minus, end, aside = max(ends, key=lambda one: one[:2])
    return _two_flights(end, aside, -minus, probe)


def _depth(run: _Run, spine: float, probe: Probe) -> float | None:
    """Of the landing beyond the end of two flights; None where there is none."""
    depth = _closed_at(run, run.width / 2.0, probe)
    if depth is None:
        return None
    ends = [run.at(run.length + share * depth, spine) for share in (0.2, 0.85)]
    on = probe.inked(ends[0][None], ends[1][None])
    return depth if float(on[0]) < CLEAR else None


def _closed_at(run: _Run, width: float, probe: Probe) -> float | None:
    """How far beyond the end of a run the line or wall is at which a landing ends.

    width: of a flight.
    """
    tried = np.arange(DEPTH[0] * width, DEPTH[1] * width, 1.0)
    first = np.array([run.at(run.length + ahead, 0.0) for ahead in tried])
    closed = probe.inked(first, first + run.width * run.across) >= CLOSED
    return float(tried[int(np.argmax(closed))]) if closed.any() else None


def _walked(run: _Run, depth: float, probe: Probe) -> float:
    """How much of the line from one flight to the other is inked: the arrow turns on a landing."""
    tried = np.arange(0.3 * depth, 0.7 * depth, 1.0)
    first = np.array([run.at(run.length + ahead, 0.3 * run.width) for ahead in tried])
    return float(probe.inked(first, first + 0.4 * run.width * run.across).max(initial=0.0) > INKED)


def _two_flights(run: _Run, spine: float, depth: float, probe: Probe) -> Course:
    """From the end of one flight over the landing to the end of the other."""
    legs = [_leg(run, low, high, probe) for low, high in ((0.0, spine), (spine, run.width))]
    landing = Polygon(
        [
            run.at(run.length, 0.0), run.at(run.length, run.width),
            run.at(run.length + depth, run.width), run.at(run.length + depth, 0.0),
        ]
    )  # fmt: skip
    over = [
        run.at(run.length + depth / 2.0, aside) for aside in (spine / 2, (spine + run.width) / 2)
    ]
    path = np.array([*legs[0].path(), *over, *legs[1].path()])
    steps = (*legs[0].steps()[::-1], landing, *legs[1].steps())
    return Course(steps, path, run.width / 2.0, run.score)


def _leg(run: _Run, low: float, high: float, probe: Probe) -> Leg:
    """One of two flights, from the landing; it may be longer than the other."""
    inner, outer = run.at(run.length, low), run.at(run.length, high)
    common = tuple(run.tread * (number + 1) for number in range(run.treads))
    last = (run.at(0.0, low), run.at(0.0, high))
    wanted = (EVEN[0] * run.tread, EVEN[1] * run.tread)
    more = probe.lines_beside(last, -run.along, wanted, MOST_TREADS)
    return Leg(inner, outer, -run.along, (*common, *(run.length + away for away in more)))


def _quarter(run: _Run, probe: Probe) -> Course | None:
    """A landing at the end of a flight, and treads at the side where `across` begins."""
    corner = run.at(run.length, 0.0)
    deep = _closed_at(run, run.width, probe)
    if deep is None:
        return None
    outer = corner + deep * run.along
    wanted = (EVEN[0] * run.tread, EVEN[1] * run.tread)
    found = probe.lines_beside((corner, outer), -run.across, wanted, MOST_TREADS)
    if len(found) < LEAST_BESIDE:
        return None
    leg = Leg(corner, outer, -run.across, tuple(found))
    first = Leg(
        run.at(run.length, run.width), corner, -run.along,
        tuple(run.tread * (number + 1) for number in range(run.treads)),
    )  # fmt: skip
    far = run.at(run.length, run.width)
    landing = Polygon([corner, far, far + deep * run.along, outer])
    middle = run.at(run.length + deep / 2.0, run.width / 2.0)
    path = np.array([*first.path(), middle, *leg.path()])
    steps = (*first.steps()[::-1], landing, *leg.steps())
    return Course(steps, path, (run.width + deep) / 2.0, run.score)
