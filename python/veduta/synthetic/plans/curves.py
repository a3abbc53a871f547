"""Points along a wall, straight or an arc, and the band that it covers."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from shapely.geometry import Polygon

from veduta.geometry.arcs import Arc
from veduta.synthetic.plans.house import Point, Wall

STEP_RAD = 0.04
_UP = np.array([1.0, -1.0])
Line = NDArray[np.float64]


def length(start: Point, end: Point, bulge: float) -> float:
    """How long the piece is along its centre line, in metres."""
    return _arc(start, end, bulge).length_px


def wall_length(wall: Wall) -> float:
    """How long the wall is along its centre line, in metres."""
    return length(wall.start_m, wall.end_m, wall.bulge)


def at(
    start: Point, end: Point, bulge: float, shares: NDArray[np.float64], offset: float = 0.0
) -> Line:
    """The points (n, 2) at these shares (0 to 1) of the length, `offset` metres to the left.

    The arc's angle is 4 atan(bulge) and its sagitta chord * bulge / 2, to the right of the chord
    where the bulge is positive (y up).
    """
    arc = _arc(start, end, bulge)
    return np.asarray(arc.at(shares * arc.length_px, -offset) * _UP)


def _arc(start: Point, end: Point, bulge: float) -> Arc:
    """The same line with y down, as `Arc` has it; in metres, where it says pixels."""
    return Arc(np.asarray(start, float) * _UP, np.asarray(end, float) * _UP, bulge)


def line(wall: Wall, low: float = 0.0, high: float = 1.0, offset: float = 0.0) -> Line:
    """The wall's centre line between two shares of its length, fine enough to pass for an arc."""
    angle = 4.0 * math.atan(abs(wall.bulge)) * (high - low)
    steps = max(1, math.ceil(angle / STEP_RAD))
    shares = np.linspace(low, high, steps + 1)
    return at(wall.start_m, wall.end_m, wall.bulge, shares, offset)


def band(wall: Wall, low_m: float, high_m: float, thickness_m: float | None = None) -> Polygon:
    """What the wall covers between two places along it, in metres from its start."""
    size = wall_length(wall)
    half = (wall.thickness_m if thickness_m is None else thickness_m) / 2.0
    low, high = low_m / size, high_m / size
    left, right = line(wall, low, high, half), line(wall, low, high, -half)
    return Polygon(np.vstack([left, right[::-1]]))
